#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "certified/model_residuals.hpp"
#include "flexspline/estimators/certified.hpp"

namespace flexspline::estimators::certified {

inline constexpr std::string_view kMgh =
    "More, Garbow, Hillstrom, ACM TOMS 7 (1981) 17-41; bounds: Gay (1984)";

/// Without bounds, and with Gay's where he gives any: <id> and <id>-bounded.
struct MghFacts {
  std::string id;
  std::vector<double> start;
  double sum_of_squares = 0.0;
  std::vector<double> other_minima{};  ///< as the paper lists them
  std::vector<double> lower{};
  std::vector<double> upper{};
  double bounded_sum_of_squares = kNotComputed;
};

template <class Model>
std::vector<CertifiedProblem> mgh_problems(const MghFacts& facts) {
  CertifiedProblem free{.id = facts.id,
                        .collection = "mgh",
                        .starts = {facts.start},
                        .sum_of_squares = facts.sum_of_squares,
                        .other_minima = facts.other_minima,
                        .residuals = std::make_shared<ModelResiduals<Model>>(Model{})};
  if (facts.lower.empty()) return {free};
  CertifiedProblem bounded = free;
  bounded.id += "-bounded";
  bounded.lower = facts.lower;
  bounded.upper = facts.upper;
  bounded.sum_of_squares = facts.bounded_sum_of_squares;
  bounded.other_minima.clear();
  return {free, bounded};
}

}  // namespace flexspline::estimators::certified
