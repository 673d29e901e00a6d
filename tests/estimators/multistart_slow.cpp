// 200 random gears from one generic start: how many fits end at the global minimum, and whether the
// rest say that they did not.
#include <cmath>

#include <gtest/gtest.h>

#include "flexspline/estimators/multistart.hpp"
#include "polynomial_gear.hpp"

namespace flexspline::estimators {
namespace {

constexpr unsigned kTruths = 200;
constexpr double kNoise = 0.005;  // of the range of the torsion
constexpr double kSame = 1e-6;    // relative difference of costs at one minimum

// The lowest cost known: from the truth, or from anywhere.
double lowest(OdeFitProblem problem, const std::vector<double>& truth, double found) {
  for (std::size_t k = 0; k < truth.size(); ++k) problem.parameters[k].start = truth[k];
  const auto fit = fit_ode(problem, OdeFitMethod::single_shooting);
  return fit && fit->cost < found ? fit->cost : found;
}

struct Count {
  int home = 0;
  int said = 0;    // not home, and not called converged
  int silent = 0;  // not home, but called converged
};

void count(const Result<OdeFit>& fit, double least, Count& tally) {
  const bool converged = fit && fit->termination == Termination::converged;
  const bool home = fit && fit->cost <= least * (1.0 + kSame);
  tally.home += converged && home;
  tally.silent += converged && !home;
  tally.said += !converged;
}

TEST(MultistartStudy, BringsRandomGearsHome) {
  int first = 0;  // home from the generic start alone
  Count many;
  double agreement = 0.0;
  for (unsigned seed = 1; seed <= kTruths; ++seed) {
    const auto truth = random_truth(seed);
    const auto problem = gear_recordings(truth, kNoise, 1000 + seed, 30);
    const auto found = fit_ode_from_many(problem, OdeFitMethod::collocation, {},
                                         {.starts = 8, .enough = 2, .seed = seed, .spread = 2.0});
    const double best = found ? found->best.cost : std::numeric_limits<double>::infinity();
    const double least = lowest(problem, truth, best);
    first += found && found->failed == 0 && found->costs.front() <= least * (1.0 + kSame);
    count(found ? Result<OdeFit>(found->best) : tl::unexpected(found.error()), least, many);
    agreement += found ? found->rate / kTruths : 0.0;
  }
  std::printf(
      "home: %d from one start, %d from up to eight; not converged: %d; elsewhere: %d; %.3f of "
      "the starts end at the best\n",
      first, many.home, many.said, many.silent, agreement);
  EXPECT_GE(many.home, static_cast<int>(kTruths) * 98 / 100);
  EXPECT_EQ(many.silent, 0) << "called converged away from the global minimum";
}

}  // namespace
}  // namespace flexspline::estimators
