#include <algorithm>
#include <chrono>
#include <map>

#include "comparison/middle_of.hpp"
#include "flexspline/studies/pilot.hpp"
#include "run/study_cases.hpp"

namespace flexspline::studies {
namespace {

constexpr std::size_t kMostMeasured = 48;

/// What cases of one estimator took.
struct Measured {
  std::vector<double> seconds;
  std::vector<double> bytes;
};

/// Where to look: the first case of every cell, then evenly through the plan. At the first point
/// and replicate every cell has its case, in their order.
std::vector<std::size_t> numbers_of(const StudyPlan& plan) {
  std::vector<std::size_t> numbers;
  const std::size_t cells = std::min(plan.cells.size(), kMostMeasured);
  for (std::size_t c = 0; c < cells; ++c) numbers.push_back(c);
  for (std::size_t k = 1; k < kMostMeasured; ++k) {
    const std::size_t number = k * plan.size() / kMostMeasured;
    if (number >= cells) numbers.push_back(number);
  }
  return numbers;
}

}  // namespace

Pilot measure_pilot(const StudyPlan& plan, double seconds) {
  using Clock = std::chrono::steady_clock;
  const auto spent = [](Clock::time_point since) {
    return std::chrono::duration<double>(Clock::now() - since).count();
  };
  StudyCases cases(plan);
  std::map<std::string, Measured> by_estimator;
  Measured all;
  const auto start = Clock::now();
  for (const std::size_t number : numbers_of(plan)) {
    if (!all.seconds.empty() && spent(start) > seconds) break;
    const auto begun = Clock::now();
    const CaseResult one = cases.compute(number);
    Measured& own = by_estimator[plan.at(number).estimator->id];
    for (Measured* to : {&own, &all}) {
      to->seconds.push_back(spent(begun));
      to->bytes.push_back(static_cast<double>(one.artefact.size() + one.row.size()));
    }
  }
  Pilot pilot;
  pilot.measured = all.seconds.size();
  for (const Cell& cell : plan.cells) {
    const auto own = by_estimator.find(plan.study->estimators[cell.estimator].id);
    const Measured& one = own != by_estimator.end() ? own->second : all;
    const auto count = static_cast<double>(plan.cases_of(cell));
    pilot.seconds += middle_of(one.seconds) * count;
    pilot.bytes += middle_of(one.bytes) * count;
  }
  return pilot;
}

Pilot measure_cases(CaseSource& cases, double seconds) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  Pilot pilot;
  double bytes = 0.0;
  double spent = 0.0;
  for (std::size_t k = 0; k < kMostMeasured && k < cases.size() && spent < seconds; ++k) {
    const CaseResult one = cases.compute(k * cases.size() / std::min(kMostMeasured, cases.size()));
    spent = std::chrono::duration<double>(Clock::now() - start).count();
    bytes += static_cast<double>(one.artefact.size() + one.row.size());
    ++pilot.measured;
  }
  const double share = static_cast<double>(cases.size()) /
                       static_cast<double>(std::max<std::size_t>(1, pilot.measured));
  pilot.seconds = spent * share;
  pilot.bytes = bytes * share;
  return pilot;
}

}  // namespace flexspline::studies
