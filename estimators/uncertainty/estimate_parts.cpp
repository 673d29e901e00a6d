#include "uncertainty/estimate_parts.hpp"

#include <algorithm>
#include <cmath>

namespace flexspline::estimators {
namespace {

constexpr double kNormal95 = 1.959963984540054;

}  // namespace

ParameterEstimate parameter_estimate(std::string name, std::string unit, double value,
                                     double variance, bool bound_active) {
  ParameterEstimate one;
  one.name = std::move(name);
  one.unit = std::move(unit);
  one.value = value;
  one.bound_active = bound_active;
  if (bound_active) return one;
  one.std = std::sqrt(std::max(0.0, variance));
  one.ci95_lower = value - kNormal95 * one.std;
  one.ci95_upper = value + kNormal95 * one.std;
  return one;
}

std::vector<RecordingFit> recording_fits(const std::vector<PreparedRecord>& records,
                                         const Eigen::VectorXd& residual) {
  std::vector<RecordingFit> list;
  Eigen::Index row = 0;
  for (const auto& one : records) {
    const auto height = static_cast<Eigen::Index>(one.rows.size());
    const double norm = residual.segment(row, height).norm();
    list.push_back({one.record.id, Split::train, norm / std::sqrt(static_cast<double>(height))});
    row += height;
  }
  return list;
}

}  // namespace flexspline::estimators
