#include "diagnosis/frame/running.hpp"

namespace flexspline::studies {

using Eigen::ArrayXd;
using Eigen::Index;

ArrayXd running_sum(const ArrayXd& x) {
  ArrayXd sum(x.size() + 1);
  sum[0] = 0.0;
  for (Index i = 0; i < x.size(); ++i) sum[i + 1] = sum[i] + x[i];
  return sum;
}

ArrayXd parabola_weights(Index half) {
  const double m = static_cast<double>(half);
  ArrayXd weights(2 * half + 1);
  for (Index j = -half; j <= half; ++j) {
    const double x = static_cast<double>(j);
    weights[j + half] = 3.0 * (3.0 * m * m + 3.0 * m - 1.0 - 5.0 * x * x) /
                        ((2.0 * m - 1.0) * (2.0 * m + 1.0) * (2.0 * m + 3.0));
  }
  return weights;
}

ArrayXd about_parabola(const Eigen::Ref<const ArrayXd>& samples, const ArrayXd& weights) {
  const Index half = weights.size() / 2;
  const Index count = samples.size() - 2 * half;
  if (count <= 0) return {};
  ArrayXd result(count);
  for (Index i = 0; i < count; ++i) {
    result[i] = samples[i + half] - (weights * samples.segment(i, weights.size())).sum();
  }
  return result;
}

}  // namespace flexspline::studies
