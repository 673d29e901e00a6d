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
constexpr Eigen::Index kSmallTriangle = 32;
constexpr double kSettled = 0.02;  // relative change of a precision

template <class Each>
void for_each_pair(const PriorGroup& group, const Each& each) {
  if (group.rows.empty()) {
    for (Eigen::Index k = group.first; k < group.first + group.count; ++k) each(k, k, 1.0);
    return;
  }
  for (Eigen::Index k = 0; k < group.count; ++k) {
    const auto& weights = group.rows[static_cast<std::size_t>(k)];
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        each(group.first + k + i, group.first + k + j,
             weights[static_cast<std::size_t>(i)] * weights[static_cast<std::size_t>(j)]);
      }
    }
  }
}

// D M, with the rows of the group's D.
Eigen::MatrixXd bends_of(const PriorGroup& group, const Eigen::MatrixXd& right) {
  if (group.rows.empty()) return right.middleRows(group.first, group.count);
  Eigen::MatrixXd result(group.count, right.cols());
  for (Eigen::Index k = 0; k < group.count; ++k) {
    const auto& w = group.rows[static_cast<std::size_t>(k)];
    const Eigen::Index i = group.first + k;
    result.row(k) = w[0] * right.row(i) + w[1] * right.row(i + 1) + w[2] * right.row(i + 2);
  }
  return result;
}

// Inverts a lower triangle in place by halves.
void invert_lower(Eigen::Ref<Eigen::MatrixXd> lower) {
  const Eigen::Index size = lower.rows();
  if (size <= kSmallTriangle) {
    lower = Eigen::MatrixXd(lower.triangularView<Eigen::Lower>())
                .triangularView<Eigen::Lower>()
                .solve(Eigen::MatrixXd::Identity(size, size));
    return;
  }
  const Eigen::Index half = size / 2;
  const Eigen::Index rest = size - half;
  invert_lower(lower.topLeftCorner(half, half));
  invert_lower(lower.bottomRightCorner(rest, rest));
  auto below = lower.bottomLeftCorner(rest, half);
  below = -(below * lower.topLeftCorner(half, half).triangularView<Eigen::Lower>()).eval();
  below = (lower.bottomRightCorner(rest, rest).triangularView<Eigen::Lower>() * below).eval();
}

// The posterior by the inverse of its precision's Cholesky factor, W'W = V.
struct Factored {
  Eigen::VectorXd mean;
  Eigen::MatrixXd root;  // W, lower
};

Factored factored(const Eigen::MatrixXd& information, const Eigen::VectorXd& gradient,
                  const std::vector<PriorGroup>& groups) {
  Eigen::MatrixXd precision = information;
  precision.diagonal().array() += kRidge * information.diagonal().maxCoeff();
  for (const auto& group : groups) {
    for_each_pair(group, [&](Eigen::Index i, Eigen::Index j, double w) {
      precision(i, j) += group.precision * w;
    });
  }
  const Eigen::VectorXd scale = precision.diagonal().cwiseSqrt().cwiseInverse();
  precision = scale.asDiagonal() * precision * scale.asDiagonal();
  const Eigen::LLT<Eigen::MatrixXd> factor(precision);
  Factored result{{}, factor.matrixL()};
  invert_lower(result.root);
  result.root = result.root * scale.asDiagonal();
  const Eigen::VectorXd half = result.root.triangularView<Eigen::Lower>() * gradient;
  result.mean = result.root.triangularView<Eigen::Lower>().transpose() * half;
  return result;
}

MixedPosterior whole(Factored factored) {
  const Eigen::MatrixXd covariance =
      factored.root.triangularView<Eigen::Lower>().transpose() * factored.root;
  return {std::move(factored.mean), covariance};
}

// Degrees of freedom that a group takes, and the sum of squares of what its prior is of.
struct Share {
  double taken = 0.0;
  double squares = 0.0;
};

Share share_of(const PriorGroup& group, const Factored& posterior) {
  double trace = 0.0;  // of D V D'
  double squares = 0.0;
  const Eigen::MatrixXd& w = posterior.root;
  const Eigen::VectorXd& c = posterior.mean;
  for (Eigen::Index k = 0; k < group.count; ++k) {
    const Eigen::Index i = group.first + k;
    const Eigen::Index below = w.rows() - i;
    if (group.rows.empty()) {
      trace += w.col(i).tail(below).squaredNorm();
      squares += c[i] * c[i];
      continue;
    }
    const auto& row = group.rows[static_cast<std::size_t>(k)];
    trace += (row[0] * w.col(i) + row[1] * w.col(i + 1) + row[2] * w.col(i + 2))
                 .tail(below)
                 .squaredNorm();
    squares += std::pow(row[0] * c[i] + row[1] * c[i + 1] + row[2] * c[i + 2], 2);
  }
  const auto count = static_cast<double>(group.count);
  return {std::max(count - group.precision * trace, kLeastTaken * count), squares};
}

}  // namespace

MixedPosterior posterior_of(const Eigen::MatrixXd& information, const Eigen::VectorXd& gradient,
                            const std::vector<PriorGroup>& groups) {
  return whole(factored(information, gradient, groups));
}

MixedPosterior restricted_likelihood(const Eigen::MatrixXd& information,
                                     const Eigen::VectorXd& gradient,
                                     std::vector<PriorGroup>& groups, int rounds) {
  const double largest = kLargestPrecision * information.diagonal().maxCoeff();
  Factored posterior = factored(information, gradient, groups);
  for (int round = 0; round < rounds; ++round) {
    double change = 0.0;
    std::vector<Share> own;
    std::map<int, Share> spline;
    for (const auto& group : groups) {
      own.push_back(group.held ? Share{} : share_of(group, posterior));
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
    posterior = factored(information, gradient, groups);
    if (change < kSettled) break;
  }
  return whole(std::move(posterior));
}

namespace {

// Expected information of the restricted likelihood on the logarithms of the precisions, with that
// of their prior.
Eigen::MatrixXd information_on_precisions(const std::vector<Eigen::MatrixXd>& bends,
                                          const std::vector<PriorGroup>& groups) {
  const auto size = static_cast<Eigen::Index>(groups.size());
  Eigen::MatrixXd information(size, size);
  for (Eigen::Index j = 0; j < size; ++j) {
    const auto& one = groups[static_cast<std::size_t>(j)];
    for (Eigen::Index k = 0; k <= j; ++k) {
      const auto& other = groups[static_cast<std::size_t>(k)];
      const Eigen::MatrixXd both = bends_of(other, bends[static_cast<std::size_t>(j)].transpose()) *
                                   std::sqrt(one.precision * other.precision);
      double squares = both.squaredNorm();
      if (j == k) squares += static_cast<double>(one.count) - 2.0 * both.trace();
      information(j, k) = information(k, j) = 0.5 * squares;
    }
    information(j, j) += 0.5 * kPriorFreedom;
  }
  return information;
}

}  // namespace

Eigen::MatrixXd unconditional_covariance(const MixedPosterior& posterior,
                                         const std::vector<PriorGroup>& groups) {
  std::vector<PriorGroup> free;
  for (const auto& group : groups) {
    if (!group.held) free.push_back(group);
  }
  std::vector<Eigen::MatrixXd> bends;  // D V
  Eigen::MatrixXd moves(posterior.mean.size(), static_cast<Eigen::Index>(free.size()));
  for (std::size_t k = 0; k < free.size(); ++k) {
    bends.push_back(bends_of(free[k], posterior.covariance));
    moves.col(static_cast<Eigen::Index>(k)) =
        free[k].precision * bends.back().transpose() * bends_of(free[k], posterior.mean);
  }
  const Eigen::LLT<Eigen::MatrixXd> factor(information_on_precisions(bends, free));
  return posterior.covariance + moves * factor.solve(moves.transpose());
}

}  // namespace flexspline::estimators
