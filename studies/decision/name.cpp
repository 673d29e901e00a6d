#include <algorithm>
#include <cmath>

#include "decision/decide.hpp"

namespace flexspline::studies::decision {
namespace {

using Eigen::VectorXd;

constexpr double kReach = 1.001;
constexpr double kRivalShare = 0.5;  // of the gain: a rival with less is none
constexpr std::size_t kRivals = 3;   // fitted whole
constexpr double kClassOdds = 0.05;  // of the best of a class: less is no part of it
constexpr std::size_t kAlternatives = 2;

double size_of(const Bench& bench, const Fit& fit, std::size_t i) {
  const Taken& cause = fit.state.causes[i];
  DriveState rest = fit.state;
  rest.causes.erase(rest.causes.begin() + static_cast<std::ptrdiff_t>(i));
  const bool changes = cause.form->transform != nullptr;
  const ByEquation columns =
      changes ? change_by(bench, rest, cause) : columns_of(bench, fit.system, fit.state, cause);
  // f is known as far as it was fitted, which a gap makes less.
  const Frame before = seen_by(*bench.frame, rest);
  const double reach = (fit.system.seen.torsion.abs() * bench.usable).maxCoeff() * kReach;
  double size = 0.0;
  for (std::size_t e = 0; e < bench.equations.size(); ++e) {
    if (columns[e].cols() == 0) continue;
    const VectorXd adds =
        changes ? VectorXd(columns[e].col(0)) : VectorXd(columns[e] * cause.coefficients);
    const auto& rows = bench.equations[e].rows.row;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      if (std::abs(before.torsion[rows[r]]) > reach) continue;
      const double share = std::abs(adds[static_cast<Eigen::Index>(r)]);
      size = std::max(size, share / (100.0 * bench.equations[e].unit));
    }
  }
  return size;
}

// Posterior shares of the cause, its rivals and nothing in its place.
Named named_of(const Bench& bench, const Fit& fit, std::size_t i, const Calibration& calibration) {
  Named one;
  one.cause = i;
  const Fit rest = without(bench, fit, i);
  one.gain = fit.score - rest.score;
  one.size = size_of(bench, fit, i);
  const double prior = std::log(static_cast<double>(causes().size()));
  std::vector<std::pair<double, std::string>> rivals;
  for (const Candidate& c : screen(bench, rest)) {
    if (c.cause.row == fit.state.causes[i].row || rivals.size() == kRivals) continue;
    if (c.gain < kRivalShare * one.gain) continue;
    const double gain = extended(bench, rest, c.cause).score - rest.score;
    rivals.emplace_back(std::max(gain, c.gain), std::string(c.cause.row->id));
  }
  std::ranges::stable_sort(rivals, std::ranges::greater{}, &std::pair<double, std::string>::first);
  double whole = 1.0 + std::exp(prior - calibration.power * one.gain);
  double of_class = 1.0;
  for (const auto& [gain, id] : rivals) {
    const double odds = std::exp(calibration.power * (gain - one.gain));
    whole += odds;
    if (odds < kClassOdds || one.alternatives.size() == kAlternatives) continue;
    of_class += odds;
    one.alternatives.push_back(id);
  }
  one.probability = of_class / whole;
  return one;
}

}  // namespace

std::vector<Named> name_causes(const Bench& bench, const Fit& fit, const Calibration& calibration) {
  std::vector<Named> list;
  for (std::size_t i = 0; i < fit.state.causes.size(); ++i) {
    list.push_back(named_of(bench, fit, i, calibration));
  }
  std::ranges::stable_sort(list, std::ranges::greater{}, &Named::gain);
  return list;
}

}  // namespace flexspline::studies::decision
