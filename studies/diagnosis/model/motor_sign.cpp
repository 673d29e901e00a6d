#include "diagnosis/model/motor_sign.hpp"
#include "diagnosis/frame/coordinates.hpp"

#include "diagnosis/model/law_fit.hpp"
#include "diagnosis/model/model_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr auto kMotor = static_cast<std::size_t>(Equation::motor);

bool has_motor(const DriveModel& model) {
  return model.own.size() > kMotor && model.own[kMotor].size() > 0;
}

/// Signs of every width, and how much of each the baseline has.
struct DryFriction {
  MatrixXd signs;
  VectorXd own;
};

DryFriction dry_friction(const Frame& frame, const DriveModel& model) {
  const auto c = shared_baseline(frame, Equation::motor, {});
  return {c->columns.middleCols(c->elastic, c->dissipative),
          model.own[kMotor].segment(c->elastic, c->dissipative)};
}

// Of the motor's equation alone.
DriveModel motor_part(DriveModel model) {
  for (std::size_t e = 0; e < model.own.size(); ++e) {
    if (e != kMotor) model.own[e].resize(0);
  }
  return model;
}

}  // namespace

ArrayXd motor_sign(const Frame& frame, const DriveModel& model) {
  if (has_motor(model)) {
    const DryFriction dry = dry_friction(frame, model);
    const VectorXd& shares = model.sign_shares.size() > 0 ? model.sign_shares : dry.own;
    if (shares.sum() > 0.0) return (dry.signs * shares).array() / shares.sum();
  }
  return rounded_sign(frame.motor_speed, 0.01 * std::max(frame.speed_range, 1e-300));
}

VectorXd fitted_sign(const Frame& frame, const ModelFit& fit, const Reference& reference,
                     const ArrayXd& weight) {
  if (!has_motor(fit.model) || fit.model.causes.empty()) return {};
  const DriveModel model = motor_part(fit.model);
  auto with_sign = [&, turned = reference](const ArrayXd& sign) mutable -> ArrayXd {
    turned.motor_sign = sign;
    return evaluate(frame, model, turned).prediction[kMotor];
  };
  const ArrayXd without = with_sign(ArrayXd::Zero(frame.rows()));
  const DryFriction dry = dry_friction(frame, model);
  MatrixXd columns(frame.rows(), dry.signs.cols());
  for (Index k = 0; k < columns.cols(); ++k) {
    const ArrayXd of_causes = with_sign(dry.signs.col(k)) - without;
    if (k == 0 && (of_causes == 0.0).all()) return {};
    columns.col(k) = of_causes.matrix() + dry.own.sum() * dry.signs.col(k);
  }
  const ArrayXd measured = fit.residual[kMotor] + fit.prediction[kMotor];
  const VectorXd rest = (measured - without).matrix() + dry.signs * dry.own;
  const auto weighed = weight.matrix().asDiagonal();
  return nonnegative_fit(weighed * columns, weighed * rest);
}

}  // namespace flexspline::studies
