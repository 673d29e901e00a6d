#include "decision/decide.hpp"
#include "diagnosis/middle.hpp"

namespace flexspline::studies::decision {

using Eigen::VectorXd;

Left what_is_left(const Bench& bench, const Fit& fit, const Calibration& calibration) {
  Left left;
  for (std::size_t e = 0; e < bench.equations.size(); ++e) {
    const VectorXd part = remainder(bench, fit, e);
    std::vector<double> sizes(part.data(), part.data() + part.size());
    for (double& v : sizes) v = std::abs(v);
    left.size =
        std::max(left.size, percentile(std::move(sizes), 0.99) / (100.0 * bench.equations[e].unit));
  }
  left.real = fit.components > 0 && left.size >= calibration.interest;
  return left;
}

}  // namespace flexspline::studies::decision
