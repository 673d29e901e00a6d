#include "ode_fit/verdict.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/Dense>

#include "ode_fit/helpful_recording.hpp"
#include "uncertainty/covariance.hpp"
#include "uncertainty/identifiability.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kFlat = 1e-7;       // relative singular value below which nothing is told
constexpr double kUnknown = 1.0;     // standard deviation, of an unknown's size
constexpr double kWeak = 0.1;        // the same
constexpr double kImitated = 0.999;  // cosine from which the rest can stand in
constexpr double kNamed = 0.1;       // least share of a combination that is named
constexpr std::size_t kMostNamed = 4;

std::vector<double> sizes_of(const OdeLayout& layout, std::span<const double> q) {
  std::vector<double> sizes;
  for (std::size_t k = 0; k < q.size(); ++k) {
    sizes.push_back(q[k] != 0.0 ? std::abs(q[k]) : layout.unknowns[k].scale);
  }
  return sizes;
}

std::vector<Eigen::Index> unknowns_in(const Eigen::MatrixXd& free) {
  std::vector<Eigen::Index> list;
  for (Eigen::Index k = 0; k < free.rows(); ++k) {
    if (free.row(k).norm() > 1e-9) list.push_back(k);
  }
  return list;
}

// The other unknown whose column is nearest once the rest is projected out of both: the largest
// correlation of the estimates.
Eigen::Index nearest(const Eigen::MatrixXd& covariance, const std::vector<Eigen::Index>& among,
                     Eigen::Index k) {
  Eigen::Index best = -1;
  double largest = -1.0;
  for (const Eigen::Index other : among) {
    if (other == k) continue;
    const double correlation =
        std::abs(covariance(k, other)) / std::sqrt(covariance(k, k) * covariance(other, other));
    if (correlation > largest) {
      largest = correlation;
      best = other;
    }
  }
  return best;
}

std::vector<Absorbed> absorbed_of(const OdeLayout& layout, const Eigen::MatrixXd& jacobian,
                                  const Eigen::MatrixXd& covariance,
                                  const std::vector<Eigen::Index>& among) {
  std::vector<Absorbed> list;
  for (const Eigen::Index k : among) {
    std::vector<Eigen::Index> rest;
    std::ranges::copy_if(among, std::back_inserter(rest), [&](auto other) { return other != k; });
    if (rest.empty()) continue;
    const Eigen::Index by = nearest(covariance, among, k);
    const auto name = [&](Eigen::Index i) { return layout.unknowns[std::size_t(i)].name; };
    list.push_back({name(k), by < 0 ? "" : name(by),
                    largest_cosine(jacobian.col(k), jacobian(Eigen::all, rest))});
  }
  std::ranges::stable_sort(list, std::ranges::greater{}, &Absorbed::cosine);
  return list;
}

// "+1 % of a with -0.8 % of b", the largest share first.
std::string words_of(const OdeLayout& layout, const Eigen::VectorXd& relative) {
  std::vector<Eigen::Index> order;
  const double largest = relative.cwiseAbs().maxCoeff();
  for (Eigen::Index k = 0; k < relative.size(); ++k) {
    if (std::abs(relative[k]) >= kNamed * largest) order.push_back(k);
  }
  std::ranges::stable_sort(order, std::ranges::greater{},
                           [&](Eigen::Index k) { return std::abs(relative[k]); });
  const double sign = std::copysign(largest, relative[order.front()]);
  const bool more = order.size() > kMostNamed;
  if (more) order.resize(kMostNamed);
  std::string text;
  for (const Eigen::Index k : order) {
    text += fmt::format("{}{:+.2g} % of {}", text.empty() ? "" : " with ", relative[k] / sign,
                        layout.unknowns[static_cast<std::size_t>(k)].name);
  }
  return text + (more ? " and others" : "");
}

struct Flattest {
  Eigen::VectorXd relative;  ///< change of each unknown over its size
  double singular = 0.0;     ///< relative to the largest
  double effect = 0.0;       ///< on the residuals, of 1 % in the unknown that moves most
};

Flattest flattest(const Eigen::MatrixXd& jacobian, const Eigen::MatrixXd& free,
                  const std::vector<double>& sizes, double noise) {
  const Eigen::Map<const Eigen::VectorXd> size(sizes.data(),
                                               static_cast<Eigen::Index>(sizes.size()));
  // Among directions of the same relative size, over those that are left free.
  const Eigen::MatrixXd relative_free = size.cwiseInverse().asDiagonal() * free;
  const Eigen::MatrixXd basis =
      Eigen::HouseholderQR<Eigen::MatrixXd>(relative_free).householderQ() *
      Eigen::MatrixXd::Identity(free.rows(), free.cols());
  const Eigen::MatrixXd scaled = jacobian * size.asDiagonal() * basis;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scaled.transpose() * scaled);
  const Eigen::VectorXd direction = basis * eigen.eigenvectors().col(0);
  const double largest = eigen.eigenvalues().maxCoeff();
  const double least = std::sqrt(std::max(0.0, eigen.eigenvalues()[0]));
  return {direction, largest > 0.0 ? least / std::sqrt(largest) : 0.0,
          0.01 * least / direction.cwiseAbs().maxCoeff() / noise};
}

}  // namespace

Identifiability verdict(const OdeLayout& layout, std::span<const double> q,
                        const Eigen::MatrixXd& free, const Eigen::MatrixXd& jacobian, double noise,
                        bool propose_recording) {
  Identifiability result;
  if (free.cols() == 0 || !(noise > 0.0)) return result;
  const auto among = unknowns_in(free);
  const auto sizes = sizes_of(layout, q);
  const Eigen::MatrixXd j = jacobian * free;
  const Eigen::MatrixXd covariance =
      free *
      sandwich(j, noise * noise * j.transpose() * j,
               std::vector<bool>(static_cast<std::size_t>(j.cols()), false)) *
      free.transpose();
  result.condition = scaled_condition(jacobian(Eigen::all, among));
  result.absorbed = absorbed_of(layout, jacobian, covariance, among);
  const Flattest flat = flattest(jacobian, free, sizes, noise);
  double worst = 0.0;
  std::size_t loosest = 0;
  for (const Eigen::Index k : among) {
    const auto index = static_cast<std::size_t>(k);
    const double relative = std::sqrt(covariance(k, k)) / sizes[index];
    if (relative > worst) loosest = index;
    worst = std::max(worst, relative);
  }
  const bool nothing = flat.singular < kFlat;
  const bool imitated = !result.absorbed.empty() && result.absorbed.front().cosine > kImitated;
  const bool lost = nothing || worst > kUnknown;
  result.verdict = lost ? "not_identifiable" : worst > kWeak || imitated ? "weak" : "identifiable";
  const std::string combination = words_of(layout, flat.relative);
  if (nothing) {
    result.says =
        fmt::format("the combination {} is not identifiable from the recordings", combination);
  } else {
    result.says = fmt::format(
        "{} is known worst, to {:.2g} % (one standard deviation); the flattest combination, {}, "
        "moves the residuals by {:.2g} standard deviations of the noise in all",
        layout.unknowns[loosest].name, 100.0 * worst, combination, flat.effect);
  }
  if (imitated) {
    const auto& first = result.absorbed.front();
    result.says += fmt::format("; the rest, {} foremost, imitates {} with cosine {:.6f}", first.by,
                               first.parameter, first.cosine);
  }
  if (propose_recording && result.verdict != "identifiable") {
    result.says += "; " + helpful_recording(layout, q, free, jacobian, flat.relative, sizes);
  }
  return result;
}

}  // namespace flexspline::estimators
