#include <algorithm>
#include <chrono>

#include "flexspline/estimators/method.hpp"
#include "midpoint/polynomial_estimate.hpp"

namespace flexspline::estimators {

MethodRow describe_midpoint_polynomial();

namespace {

double range(const TorsionRecord& record) {
  const auto [low, high] = std::ranges::minmax(record.motion);
  return high - low;
}

// The paper has one loop; of several, the widest.
Result<Estimate> fit(const FitProblem& problem) {
  const auto started = std::chrono::steady_clock::now();
  if (problem.records.empty()) {
    return failure(ErrorCode::bad_data, "there is no recording to train on",
                   "mark one with split = \"train\"");
  }
  const auto widest = std::ranges::max_element(problem.records, {}, range);
  const auto locus = midpoint_locus(*widest, locus_speed(problem, describe_midpoint_polynomial()));
  if (!locus) return tl::unexpected(locus.error());
  Estimate estimate = polynomial_estimate("midpoint_polynomial", {*locus}, {*widest});
  if (problem.records.size() > 1) {
    estimate.notes.push_back("fitted to the widest loop, " + widest->id + ", alone");
  }
  estimate.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return estimate;
}

}  // namespace

MethodRow describe_midpoint_polynomial() {
  return {
      .id = "midpoint_polynomial",
      .summary = "the paper's fit: midpoint locus of one loop, odd five-term polynomials, h = 1",
      .source = "Dhaouadi and Ghorbel (2003), eqs. (15)-(25)",
      .options = {locus_speed_option()},
      .fit = fit};
}

}  // namespace flexspline::estimators
