#include "solvers/evolution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include <Eigen/Eigenvalues>

namespace flexspline::estimators {
namespace {

/// The strategy's constants for n numbers.
struct Rates {
  explicit Rates(double n)
      : offspring(4 + static_cast<Eigen::Index>(3.0 * std::log(n))), weight(offspring / 2) {
    const auto parents = static_cast<double>(weight.size());
    for (Eigen::Index k = 0; k < weight.size(); ++k)
      weight[k] = std::log(parents + 0.5) - std::log(static_cast<double>(k) + 1.0);
    weight /= weight.sum();
    selected = 1.0 / weight.squaredNorm();
    path = (4.0 + selected / n) / (n + 4.0 + 2.0 * selected / n);
    step_path = (selected + 2.0) / (n + selected + 5.0);
    rank_one = 2.0 / ((n + 1.3) * (n + 1.3) + selected);
    rank_many = std::min(1.0 - rank_one, 2.0 * (selected - 2.0 + 1.0 / selected) /
                                             ((n + 2.0) * (n + 2.0) + selected));
    damping = 1.0 + 2.0 * std::max(0.0, std::sqrt((selected - 1.0) / (n + 1.0)) - 1.0) + step_path;
    usual_length = std::sqrt(n) * (1.0 - 0.25 / n + 1.0 / (21.0 * n * n));
  }

  Eigen::Index offspring;
  Eigen::VectorXd weight;
  double selected = 0.0;
  double path = 0.0;
  double step_path = 0.0;
  double rank_one = 0.0;
  double rank_many = 0.0;
  double damping = 0.0;
  double usual_length = 0.0;
};

/// The distribution that candidates are drawn from, in first steps about the start.
class Strategy {
 public:
  Strategy(Eigen::Index n, std::uint64_t seed)
      : rates_(static_cast<double>(n)),
        mean_(Eigen::VectorXd::Zero(n)),
        covariance_(Eigen::MatrixXd::Identity(n, n)),
        path_(Eigen::VectorXd::Zero(n)),
        step_path_(Eigen::VectorXd::Zero(n)) {
    std::seed_seq seeds{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)};
    engine_.seed(seeds);
  }

  Eigen::MatrixXd drawn() {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(covariance_);
    axes_ = axes.eigenvectors();
    lengths_ = axes.eigenvalues().cwiseMax(1e-30).cwiseSqrt();
    Eigen::MatrixXd list(mean_.size(), rates_.offspring);
    std::normal_distribution<double> normal;
    for (Eigen::Index k = 0; k < list.size(); ++k) list.data()[k] = normal(engine_);
    return (step_ * (axes_ * lengths_.asDiagonal() * list)).colwise() + mean_;
  }

  void learn(const Eigen::MatrixXd& candidates, const std::vector<double>& costs) {
    std::vector<Eigen::Index> order(costs.size());
    std::iota(order.begin(), order.end(), Eigen::Index{0});
    std::ranges::stable_sort(order, {}, [&](auto k) { return costs[static_cast<std::size_t>(k)]; });
    Eigen::MatrixXd parents(mean_.size(), rates_.weight.size());
    for (Eigen::Index k = 0; k < parents.cols(); ++k)
      parents.col(k) = (candidates.col(order[static_cast<std::size_t>(k)]) - mean_) / step_;
    adapt(parents, parents * rates_.weight);
  }

  double widest() const { return step_ * lengths_.maxCoeff(); }

 private:
  void adapt(const Eigen::MatrixXd& parents, const Eigen::VectorXd& moved) {
    mean_ += step_ * moved;
    const Eigen::VectorXd white = axes_ * (axes_.transpose() * moved).cwiseQuotient(lengths_);
    const double s = rates_.step_path;
    step_path_ = (1.0 - s) * step_path_ + std::sqrt(s * (2.0 - s) * rates_.selected) * white;
    const double settled = 1.0 - std::pow(1.0 - s, 2.0 * ++generation_);
    const double length = step_path_.norm() / rates_.usual_length;
    const double most = 1.4 + 2.0 / (static_cast<double>(mean_.size()) + 1.0);
    const bool stalls = length > most * std::sqrt(settled);
    const double c = rates_.path;
    path_ *= 1.0 - c;
    if (!stalls) path_ += std::sqrt(c * (2.0 - c) * rates_.selected) * moved;
    covariance_ = (1.0 - rates_.rank_one - rates_.rank_many) * covariance_ +
                  rates_.rank_one * path_ * path_.transpose() +
                  rates_.rank_many * parents * rates_.weight.asDiagonal() * parents.transpose();
    step_ *= std::exp(std::min(1.0, s / rates_.damping * (length - 1.0)));
  }

  Rates rates_;
  std::mt19937_64 engine_;
  Eigen::VectorXd mean_;
  Eigen::MatrixXd covariance_;
  Eigen::VectorXd path_;
  Eigen::VectorXd step_path_;
  Eigen::MatrixXd axes_;
  Eigen::VectorXd lengths_;
  double step_ = 1.0;
  int generation_ = 0;
};

Eigen::VectorXd each(const std::vector<SearchedNumber>& numbers, double SearchedNumber::*member) {
  Eigen::VectorXd list(static_cast<Eigen::Index>(numbers.size()));
  for (Eigen::Index k = 0; k < list.size(); ++k)
    list[k] = numbers[static_cast<std::size_t>(k)].*member;
  return list;
}

}  // namespace

Evolved evolve(const CostsOf& costs, const std::vector<SearchedNumber>& numbers,
               const EvolutionSettings& settings) {
  const Eigen::VectorXd start = each(numbers, &SearchedNumber::start);
  const Eigen::VectorXd size = each(numbers, &SearchedNumber::step);
  const Eigen::VectorXd lower = each(numbers, &SearchedNumber::lower);
  const Eigen::VectorXd upper = each(numbers, &SearchedNumber::upper);
  Strategy strategy(start.size(), settings.seed);
  Evolved found{start, std::numeric_limits<double>::infinity()};
  do {
    Eigen::MatrixXd steps = strategy.drawn();
    if (found.evaluations == 0) steps.col(0).setZero();
    Eigen::MatrixXd candidates = (size.asDiagonal() * steps).colwise() + start;
    candidates = candidates.cwiseMax(lower.replicate(1, steps.cols()))
                     .cwiseMin(upper.replicate(1, steps.cols()));
    const std::vector<double> worth = costs(candidates);
    const auto least = std::ranges::min_element(worth);
    if (*least < found.cost)
      found = {candidates.col(least - worth.begin()), *least, found.evaluations};
    found.evaluations += candidates.cols();
    strategy.learn(size.cwiseInverse().asDiagonal() * (candidates.colwise() - start), worth);
  } while (found.evaluations < settings.evaluations && strategy.widest() > settings.smallest_step);
  return found;
}

}  // namespace flexspline::estimators
