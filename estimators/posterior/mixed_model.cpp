#include "posterior/mixed_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <Eigen/Dense>

namespace flexspline::estimators {
namespace {

constexpr double kRidge = 1e-11;  // of the largest information: a gauge stays where it is
// Of the largest information: as good as known. More would drown in rounding.
constexpr double kLargestPrecision = 100.0;
constexpr double kLargestChange = 100.0;  // of a precision in one round
constexpr double kPriorFreedom = 0.3;     // of a group's precision about that of its spline
constexpr double kLeastTaken = 1e-6;
constexpr double kSettled = 0.02;  // relative change of a precision

// What a group's prior is of: weights of `width` neighbours.
std::array<double, 3> weights_of(const PriorGroup& group) {
  return group.width == 3 ? std::array<double, 3>{1.0, -2.0, 1.0}
                          : std::array<double, 3>{1.0, 0.0, 0.0};
}

template <class Each>
void for_each_pair(const PriorGroup& group, const Each& each) {
  const auto weights = weights_of(group);
  for (Eigen::Index k = group.first; k < group.first + group.count; ++k) {
    for (int i = 0; i < group.width; ++i) {
      for (int j = 0; j < group.width; ++j) {
        each(k + i, k + j,
             weights[static_cast<std::size_t>(i)] * weights[static_cast<std::size_t>(j)]);
      }
    }
  }
}

// tr(M D'D) over a group.
double trace_with(const PriorGroup& group, const Eigen::MatrixXd& matrix) {
  double sum = 0.0;
  for_each_pair(group, [&](Eigen::Index i, Eigen::Index j, double w) { sum += w * matrix(i, j); });
  return sum;
}

double squares_of(const PriorGroup& group, const Eigen::VectorXd& c) {
  double sum = 0.0;
  for_each_pair(group, [&](Eigen::Index i, Eigen::Index j, double w) { sum += w * c[i] * c[j]; });
  return sum;
}

// Degrees of freedom that a group takes, and the sum of squares of what its prior is of.
struct Share {
  double taken = 0.0;
  double squares = 0.0;
};

Share share_of(const PriorGroup& group, const MixedPosterior& posterior) {
  const auto count = static_cast<double>(group.count);
  const double taken = count - group.precision * trace_with(group, posterior.covariance);
  return {std::max(taken, kLeastTaken * count), squares_of(group, posterior.mean)};
}

}  // namespace

MixedPosterior posterior_of(const Eigen::MatrixXd& information, const Eigen::VectorXd& gradient,
                            const std::vector<PriorGroup>& groups) {
  Eigen::MatrixXd precision = information;
  precision.diagonal().array() += kRidge * information.diagonal().maxCoeff();
  for (const auto& group : groups) {
    for_each_pair(group, [&](Eigen::Index i, Eigen::Index j, double w) {
      precision(i, j) += group.precision * w;
    });
  }
  const Eigen::VectorXd scale = precision.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::LLT<Eigen::MatrixXd> factor(scale.asDiagonal() * precision * scale.asDiagonal());
  MixedPosterior posterior;
  posterior.covariance =
      factor.solve(Eigen::MatrixXd::Identity(precision.rows(), precision.cols()));
  posterior.covariance = scale.asDiagonal() * posterior.covariance * scale.asDiagonal();
  posterior.mean = posterior.covariance * gradient;
  return posterior;
}

MixedPosterior restricted_likelihood(const Eigen::MatrixXd& information,
                                     const Eigen::VectorXd& gradient,
                                     std::vector<PriorGroup>& groups, int rounds) {
  const double largest = kLargestPrecision * information.diagonal().maxCoeff();
  MixedPosterior posterior = posterior_of(information, gradient, groups);
  for (int round = 0; round < rounds; ++round) {
    double change = 0.0;
    std::vector<Share> own;
    std::map<int, Share> spline;
    for (const auto& group : groups) {
      own.push_back(share_of(group, posterior));
      spline[group.family].taken += own.back().taken;
      spline[group.family].squares += own.back().squares;
    }
    for (std::size_t k = 0; k < groups.size(); ++k) {
      auto& group = groups[k];
      if (group.held) continue;
      Share share = own[k];
      if (group.family > 0) {
        const Share& whole = spline[group.family];
        share.taken += kPriorFreedom;
        share.squares += kPriorFreedom * whole.squares / whole.taken;
      }
      const double next =
          std::clamp(share.squares > 0.0 ? std::min(share.taken / share.squares, largest) : largest,
                     group.precision / kLargestChange, group.precision * kLargestChange);
      change = std::max(change, std::abs(std::log(next / group.precision)));
      group.precision = next;
    }
    posterior = posterior_of(information, gradient, groups);
    if (change < kSettled) break;
  }
  return posterior;
}

}  // namespace flexspline::estimators
