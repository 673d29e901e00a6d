#include "ode_fit/helpful_recording.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/Dense>

#include "ode_fit/weighted_shooting.hpp"
#include "uncertainty/covariance.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kTolerance = 1e-7;
constexpr std::size_t kMostTried = 6;        // experiments that are varied
constexpr double kHelps = 2.0;               // beyond what a mere repetition gives
constexpr double kNoiseOfUnseen = 0.01;      // of a state's size, where nothing tells it
constexpr double kLeastInformation = 1e-10;  // relative: keeps what nothing tells finite

struct Proposal {
  std::string says;
  LaidOutExperiment experiment;
  double initial_factor = 1.0;
};

LaidOutExperiment without_mask(LaidOutExperiment experiment) {
  experiment.source.mask.clear();
  experiment.whitening.clear();
  return experiment;
}

// At the same instants, the span of time stretched and the instants thinned or doubled.
LaidOutExperiment retimed(LaidOutExperiment experiment, double stretch, std::size_t density) {
  auto& source = experiment.source;
  std::vector<double> times;
  double last = source.start_time;
  for (const double t : source.times) {
    const double here = source.start_time + stretch * (t - source.start_time);
    for (std::size_t k = 1; k < density && here > last; ++k) {
      times.push_back(last + (here - last) * static_cast<double>(k) / static_cast<double>(density));
    }
    times.push_back(here);
    last = here;
  }
  source.times = std::move(times);
  source.measured.assign(source.times.size() * source.sigma.size(), 0.0);
  return experiment;
}

bool is_seen(const LaidOutExperiment& experiment, Eigen::Index state) {
  return experiment.source.observation.col(state).norm() > 0.0;
}

LaidOutExperiment seeing(LaidOutExperiment experiment, Eigen::Index state, double sigma) {
  auto& source = experiment.source;
  source.observation.conservativeResize(source.observation.rows() + 1, Eigen::NoChange);
  source.observation.bottomRows(1).setZero();
  source.observation(source.observation.rows() - 1, state) = 1.0;
  source.sigma.push_back(sigma);
  source.measured.assign(source.times.size() * source.sigma.size(), 0.0);
  return experiment;
}

std::vector<Proposal> proposals(const OdeLayout& layout) {
  std::vector<Proposal> list;
  const std::size_t stride = 1 + (layout.experiments.size() - 1) / kMostTried;
  for (std::size_t e = 0; e < layout.experiments.size(); e += stride) {
    const auto& original = layout.experiments[e];
    const auto plain = without_mask(original);
    const std::string like = fmt::format("a recording like '{}'", original.source.id);
    list.push_back({like + " from twice the initial state", plain, 2.0});
    list.push_back({like + " from half the initial state", plain, 0.5});
    list.push_back({like + " over twice the time", retimed(plain, 2.0, 2)});
    list.push_back(
        {like + " over a quarter of the time, as many samples", retimed(plain, 0.25, 1)});
    list.push_back({like + " with four times the samples", retimed(plain, 1.0, 4)});
    for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(layout.states()); ++i) {
      if (is_seen(plain, i)) continue;
      const double sigma = kNoiseOfUnseen * layout.state_scale[static_cast<std::size_t>(i)];
      list.push_back({fmt::format("{} with state {} measured to {:.2g}", like, i + 1, sigma),
                      seeing(plain, i, sigma)});
    }
  }
  return list;
}

// The Jacobian of the proposal alone, over the unknowns that there are and its own initial values.
Result<Eigen::MatrixXd> jacobian_of(const OdeLayout& layout, std::span<const double> q,
                                    const Proposal& proposal) {
  OdeLayout alone = layout;
  alone.experiments = {proposal.experiment};
  std::vector<double> extended(q.begin(), q.end());
  for (auto& source : alone.experiments[0].initial) {
    if (source.known()) {
      source.value *= proposal.initial_factor;
      continue;
    }
    const std::size_t own = alone.unknowns.size();
    extended.push_back(proposal.initial_factor * q[source.unknown]);
    alone.unknowns.push_back(alone.unknowns[source.unknown]);
    source.unknown = own;
  }
  alone.loss = {};
  const ShootingProblem shots(alone, kTolerance, 1);
  auto linear = linearise(WeightedShooting(alone, shots), extended);
  if (!linear) return tl::unexpected(std::move(linear).error());
  return std::move(linear->jacobian);
}

// Lengths of columns: one measure for all proposals, so that none seems to tell what it does not.
Eigen::VectorXd lengths_of(const Eigen::MatrixXd& jacobian) {
  const Eigen::VectorXd length = jacobian.colwise().norm();
  return length.array().max(kLeastInformation * length.maxCoeff());
}

// Standard deviation of the combination, with what nothing tells held back just enough to be
// finite.
double deviation(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& combination,
                 const Eigen::VectorXd& length) {
  const Eigen::MatrixXd scaled = jacobian * length.cwiseInverse().asDiagonal();
  Eigen::MatrixXd normal = scaled.transpose() * scaled;
  normal.diagonal().array() += kLeastInformation;
  const Eigen::VectorXd c = combination.cwiseQuotient(length);
  return std::sqrt(std::max(0.0, c.dot(normal.ldlt().solve(c))));
}

Eigen::MatrixXd below(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  Eigen::MatrixXd both = Eigen::MatrixXd::Zero(a.rows() + b.rows(), std::max(a.cols(), b.cols()));
  both.topLeftCorner(a.rows(), a.cols()) = a;
  both.bottomLeftCorner(b.rows(), b.cols()) = b;
  return both;
}

}  // namespace

std::string helpful_recording(const OdeLayout& layout, std::span<const double> q,
                              const Eigen::MatrixXd& free, const Eigen::MatrixXd& jacobian,
                              const Eigen::VectorXd& combination,
                              const std::vector<double>& sizes) {
  const auto count = static_cast<Eigen::Index>(q.size());
  const Eigen::Map<const Eigen::VectorXd> size(sizes.data(), count);
  const Eigen::VectorXd inside = free.transpose() * combination.cwiseQuotient(size);
  const Eigen::VectorXd length = lengths_of(jacobian * free);
  const double now = deviation(jacobian * free, inside, length);
  double best = 0.0;
  std::string says;
  for (const auto& proposal : proposals(layout)) {
    const auto added = jacobian_of(layout, q, proposal);
    if (!added) continue;
    const Eigen::Index own = added->cols() - count;
    Eigen::MatrixXd reduced(added->rows(), free.cols() + own);
    reduced << added->leftCols(count) * free, added->rightCols(own);
    Eigen::VectorXd wanted = Eigen::VectorXd::Zero(reduced.cols());
    wanted.head(inside.size()) = inside;
    Eigen::VectorXd lengths = lengths_of(reduced);
    lengths.head(length.size()) = length;
    const double gain = now / deviation(below(jacobian * free, reduced), wanted, lengths);
    if (!(gain > best)) continue;
    best = gain;
    says = proposal.says;
  }
  if (!(best > kHelps)) {
    return "no further recording that was tried (other initial states, times, outputs) would help "
           "much more than a repetition";
  }
  return fmt::format("{} would help most: the standard deviation of that combination falls {}",
                     says, best > 100.0 ? "over 100-fold" : fmt::format("{:.1f}-fold", best));
}

}  // namespace flexspline::estimators
