#include <algorithm>
#include <cmath>
#include <map>

#include "flexspline/studies/trial.hpp"
#include "trial/median.hpp"

namespace flexspline::studies {
namespace {

struct Counts {
  int good = 0;
  int of = 0;

  void add(bool is_good) {
    good += is_good ? 1 : 0;
    ++of;
  }
};

}  // namespace

std::vector<ReliabilityBin> reliability_of(const std::vector<ScoredCase>& cases) {
  constexpr double kEdges[] = {0.0, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.99, 1.0};
  std::vector<ReliabilityBin> bins;
  for (std::size_t k = 0; k + 1 < std::size(kEdges); ++k) {
    ReliabilityBin bin{kEdges[k], kEdges[k + 1], kNotComputed, {}};
    const bool last = k + 2 == std::size(kEdges);
    Counts counts;
    double sum = 0.0;
    for (const ScoredCase& one : cases) {
      for (const GivenName& name : one.score.names) {
        const double p = name.probability;
        if (!(p >= bin.from && (p < bin.to || (last && p <= bin.to)))) continue;
        counts.add(name.right);
        sum += p;
      }
    }
    if (counts.of == 0) continue;
    bin.mean_probability = sum / counts.of;
    bin.right = proportion(counts.good, counts.of);
    bins.push_back(bin);
  }
  return bins;
}

std::vector<std::pair<std::string, Proportion>> coverage_of(const std::vector<ScoredCase>& cases) {
  Counts all;
  std::map<std::string, Counts> by_parameter;
  for (const ScoredCase& one : cases) {
    for (const GivenInterval& interval : one.score.intervals) {
      all.add(interval.covers());
      by_parameter[interval.parameter].add(interval.covers());
    }
  }
  std::vector<std::pair<std::string, Proportion>> rows;
  if (all.of > 0) rows.emplace_back("all", proportion(all.good, all.of));
  for (const auto& [name, counts] : by_parameter) {
    rows.emplace_back(name, proportion(counts.good, counts.of));
  }
  return rows;
}

std::vector<VerdictError> errors_by_verdict(const std::vector<ScoredCase>& cases) {
  std::map<std::string, std::vector<double>> errors;
  for (const ScoredCase& one : cases) {
    if (std::isfinite(one.score.over_noise)) errors[one.verdict].push_back(one.score.over_noise);
  }
  std::vector<VerdictError> rows;
  for (auto& [verdict, values] : errors) {
    const int count = static_cast<int>(values.size());
    rows.push_back({verdict, count, median_of(std::move(values))});
  }
  return rows;
}

}  // namespace flexspline::studies
