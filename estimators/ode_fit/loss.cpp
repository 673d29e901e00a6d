#include "ode_fit/loss.hpp"

#include <cmath>

namespace flexspline::estimators {
namespace {

constexpr double kNearZero = 1e-6;  // of the scale, below which a loss is a square to rounding

}  // namespace

std::string_view name_of(Loss loss) {
  switch (loss) {
    case Loss::huber:
      return "huber";
    case Loss::soft_l1:
      return "soft_l1";
    case Loss::cauchy:
      return "cauchy";
    default:
      return "squared";
  }
}

double RobustLoss::value(double r) const {
  const double z = r / scale;
  switch (kind) {
    case Loss::huber:
      return std::abs(z) <= 1.0 ? 0.5 * r * r : scale * scale * (std::abs(z) - 0.5);
    case Loss::soft_l1:
      return scale * scale * z * z / (std::sqrt(1.0 + z * z) + 1.0);
    case Loss::cauchy:
      return 0.5 * scale * scale * std::log1p(z * z);
    default:
      return 0.5 * r * r;
  }
}

double RobustLoss::influence(double r) const {
  const double z = r / scale;
  switch (kind) {
    case Loss::huber:
      return std::abs(z) <= 1.0 ? r : std::copysign(scale, r);
    case Loss::soft_l1:
      return r / std::sqrt(1.0 + z * z);
    case Loss::cauchy:
      return r / (1.0 + z * z);
    default:
      return r;
  }
}

double RobustLoss::curvature(double r) const {
  const double z = r / scale;
  switch (kind) {
    case Loss::huber:
      return std::abs(z) <= 1.0 ? 1.0 : 0.0;
    case Loss::soft_l1:
      return std::pow(1.0 + z * z, -1.5);
    case Loss::cauchy:
      return (1.0 - z * z) / std::pow(1.0 + z * z, 2);
    default:
      return 1.0;
  }
}

LossResidual as_residual(const RobustLoss& loss, double r) {
  if (loss.squared() || std::abs(r) < kNearZero * loss.scale) return {r, 1.0};
  const double residual = std::copysign(std::sqrt(2.0 * loss.value(r)), r);
  return {residual, loss.influence(r) / residual};
}

}  // namespace flexspline::estimators
