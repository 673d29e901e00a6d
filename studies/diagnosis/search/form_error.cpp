#include "diagnosis/search/form_error.hpp"

#include <algorithm>

#include <Eigen/QR>

#include "diagnosis/model/cause_columns.hpp"
#include "diagnosis/model/model_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

bool acts_on(const ActiveCause& cause, Equation equation) {
  return std::ranges::count(cause.form->at, equation) > 0;
}

ArrayXd scaled(const ArrayXd& x) {
  const double most = x.abs().maxCoeff();
  return most > 0.0 ? ArrayXd(x / most) : x;
}

/// What an error in the form of a contribution may look like; a constant has no form to err in. The
/// same for both directions and both sides: what differs between them is a cause of its own.
Columns form_errors(const Frame& frame, const ArrayXd& c) {
  constexpr double kConstant = 1e-3;
  if (c.maxCoeff() - c.minCoeff() < kConstant * c.abs().maxCoeff()) return {};
  const ArrayXd clock = scaled(frame.clock);
  return {c * scaled(frame.torsion).square(),
          c * scaled(frame.torsion_rate).abs(),
          c * scaled(frame.torque).square(),
          c * scaled(c).square(),
          c * clock,
          c * clock.square(),
          rate_of(frame, c)};
}

class WeightedColumns {
 public:
  explicit WeightedColumns(const ArrayXd& weight) : weight_(weight) {
    for (Index r = 0; r < weight.size(); ++r) {
      if (weight[r] > 0.0) rows_.push_back(r);
    }
  }

  void add(const ArrayXd& column) {
    columns_.conservativeResize(static_cast<Index>(rows_.size()), columns_.cols() + 1);
    columns_.col(columns_.cols() - 1) = taken(column);
  }
  void add(const Columns& columns) {
    for (const ArrayXd& column : columns) add(column);
  }

  double sum_of_squares_left(const ArrayXd& target) const {
    const Eigen::VectorXd y = taken(target);
    return (y - columns_ * columns_.colPivHouseholderQr().solve(y)).squaredNorm();
  }

 private:
  Eigen::VectorXd taken(const ArrayXd& column) const { return (column * weight_)(rows_); }

  ArrayXd weight_;
  std::vector<Index> rows_;
  Eigen::MatrixXd columns_;
};

/// The rise of one equation's sum of squares without the cause.
double rise(WeightedColumns others, const ArrayXd& cause, const ArrayXd& target) {
  const double without = others.sum_of_squares_left(target);
  others.add(cause);
  return without - others.sum_of_squares_left(target);
}

}  // namespace

double share_beyond_form(const Frame& frame, const Findings& findings, std::size_t cause,
                         std::size_t other) {
  const DriveModel& model = findings.fit.model;
  ModelColumns columns(frame, findings.reference);
  double plain = 0.0;
  double freed = 0.0;
  for (Equation equation : frame.equations) {
    if (!acts_on(model.causes[cause], equation)) continue;
    const std::size_t e = index_of(equation);
    const auto part = [&](std::size_t i) {
      return contribution(frame, model, findings.reference, i, equation);
    };
    const EquationColumns built = columns.at(model, equation);
    WeightedColumns others(findings.weight[e]);
    for (Index k = 0; k < built.own->columns.cols(); ++k)
      others.add(built.own->columns.col(k).array());
    for (std::size_t i = 0; i < model.causes.size(); ++i) {
      if (i != cause && acts_on(model.causes[i], equation)) others.add(part(i));
    }
    const ArrayXd target = findings.fit.residual[e] + part(cause);
    const double colour = findings.noise[e].colour;
    plain += rise(others, part(cause), target) / colour;
    if (acts_on(model.causes[other], equation)) others.add(form_errors(frame, part(other)));
    freed += rise(others, part(cause), target) / colour;
  }
  return plain > 0.0 ? std::clamp(freed / plain, 0.0, 1.0) : 0.0;
}

}  // namespace flexspline::studies
