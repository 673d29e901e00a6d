#include <chrono>

#include "flexspline/estimators/method.hpp"
#include "midpoint/polynomial_estimate.hpp"

namespace flexspline::estimators {

MethodRow describe_midpoint_pooled();

namespace {

Result<Estimate> fit(const FitProblem& problem) {
  const auto started = std::chrono::steady_clock::now();
  if (problem.records.empty()) {
    return failure(ErrorCode::bad_data, "there is no recording to train on",
                   "mark one with split = \"train\"");
  }
  const LocusSpeed speed = locus_speed(problem, describe_midpoint_pooled());
  std::vector<MidpointLocus> loci;
  std::vector<TorsionRecord> used;
  std::string left_out;
  for (const auto& record : problem.records) {
    auto locus = midpoint_locus(record, speed);
    if (!locus) {
      left_out += (left_out.empty() ? "not used: " : "; ") + locus.error().message();
      continue;
    }
    loci.push_back(std::move(*locus));
    used.push_back(record);
  }
  if (loci.empty()) {
    return failure(ErrorCode::numerics, "no recording has a midpoint locus", left_out);
  }
  Estimate estimate = polynomial_estimate("midpoint_pooled", loci, used);
  if (!left_out.empty()) estimate.notes.push_back(left_out);
  estimate.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return estimate;
}

}  // namespace

MethodRow describe_midpoint_pooled() {
  return {.id = "midpoint_pooled",
          .summary = "the paper's fit to the midpoint loci of all training loops at once",
          .source = "Dhaouadi and Ghorbel (2003), eqs. (15)-(25), pooled",
          .options = {locus_speed_option()},
          .fit = fit};
}

}  // namespace flexspline::estimators
