// The solvers against solutions certified to 11 digits, and the pieces that do the counting.
#include <cmath>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "certified/nist_data.hpp"
#include "claims/claims.hpp"
#include "flexspline/estimators/certified.hpp"
#include "solvers/least_squares.hpp"

namespace flexspline::estimators {
namespace {

std::vector<const CertifiedProblem*> collection(std::string_view name) {
  std::vector<const CertifiedProblem*> list;
  for (const auto* problem : certified_problems()) {
    if (problem->collection == name) list.push_back(problem);
  }
  return list;
}

const CertifiedProblem& problem_named(std::string_view id) {
  for (const auto* problem : certified_problems()) {
    if (problem->id == id) return *problem;
  }
  throw std::invalid_argument(std::string(id));
}

double sum_of_squares(const CertifiedProblem& problem, const std::vector<double>& p) {
  return 2.0 * half_sum_of_squares(*problem.residuals, p).value();
}

TEST(CorrectDigits, AreTheLogarithmOfTheRelativeError) {
  EXPECT_NEAR(correct_digits(1.001, 1.0), 3.0, 1e-9);
  EXPECT_NEAR(correct_digits(-2000.2, -2000.0), 4.0, 1e-9);
  EXPECT_EQ(correct_digits(5.0, 5.0), kMostDigits);
  EXPECT_EQ(correct_digits(-1.0, 1.0), 0.0);
  EXPECT_NEAR(correct_digits(1e-7, 0.0), 7.0, 1e-9);
  EXPECT_TRUE(std::isnan(correct_digits(NAN, 1.0)));
}

TEST(Nist, FilesAreReadAsNistWritesThem) {
  const auto data = certified::nist_data("Nelson");
  EXPECT_EQ(data.y.size(), 128u);
  EXPECT_THAT(data.x.back(), testing::ElementsAre(64.0, 275.0));
  EXPECT_THAT(data.starts[1], testing::ElementsAre(2.5, 0.000000005, -0.05));
  EXPECT_EQ(data.parameters[1], 5.6177717026e-9);
  EXPECT_EQ(data.sum_of_squares, 3.7976833176);
}

// The models are those of the certificates: at the certified parameters they have its sum of
// squares, to what 11 digits of the parameters allow.
TEST(Nist, ModelsHaveTheCertifiedSumOfSquares) {
  EXPECT_EQ(collection("nist").size(), 27u);
  for (const auto* problem : collection("nist")) {
    if (problem->id == "Lanczos1") continue;
    const double value = sum_of_squares(*problem, problem->parameters);
    EXPECT_NEAR(value / problem->sum_of_squares, 1.0, 1e-9) << problem->id;
  }
  const CertifiedProblem& lanczos = problem_named("Lanczos1");
  const double sum = sum_of_squares(lanczos, lanczos.parameters);
  EXPECT_LT(sum, 1e-20);
  claims::expect("docs/certified.md", "lanczos1",
                 {{"certified", certified::nist_data("Lanczos1").sum_of_squares},
                  {"digits", kMostDigits},
                  {"by the parameters", sum}});
}

TEST(CertifiedPage, CountsTheProblems) {
  const auto mgh = collection("mgh");
  const auto bounded = std::ranges::count_if(
      mgh, [](const CertifiedProblem* problem) { return !problem->lower.empty(); });
  const auto all = static_cast<std::ptrdiff_t>(mgh.size());
  const auto count = [](const char* name, std::ptrdiff_t value) {
    claims::expect("docs/certified.md", name, {{name, static_cast<double>(value)}});
  };
  count("nist-count", static_cast<std::ptrdiff_t>(collection("nist").size()));
  count("mgh-count", all - bounded);
  count("mgh-bounded-count", bounded);
}

TEST(CertifiedPage, HasThePublishedLocalMinima) {
  const std::pair<const char*, const char*> minima[] = {{"freudenstein-roth", "Freudenstein-Roth"},
                                                        {"bard", "Bard"},
                                                        {"kowalik-osborne", "Kowalik-Osborne"},
                                                        {"biggs-exp6", "Biggs EXP6"}};
  for (const auto& [name, problem] : minima) {
    claims::expect("docs/certified.md", name, {{problem, problem_named(problem).other_minima[0]}});
  }
}

// Derivatives against central differences, away from the solutions.
TEST(Certified, DerivativesAreThoseOfTheResiduals) {
  for (const auto* problem : certified_problems()) {
    auto p = problem->starts.front();
    const auto at = linearise(*problem->residuals, p);
    ASSERT_TRUE(at) << problem->id;
    for (std::size_t k = 0; k < p.size(); ++k) {
      const double value = p[k];
      const double step = 1e-6 * std::max(std::abs(value), 1e-3);
      p[k] = value + step;
      const auto above = linearise(*problem->residuals, p);
      p[k] = value - step;
      const auto below = linearise(*problem->residuals, p);
      p[k] = value;
      if (!above || !below) continue;
      const Eigen::VectorXd difference = (above->residual - below->residual) / (2.0 * step);
      const Eigen::VectorXd exact = at->jacobian.col(static_cast<Eigen::Index>(k));
      const double rounding = 1e-9 * at->residual.cwiseAbs().maxCoeff() / step * 1e-3;
      EXPECT_LT((difference - exact).cwiseAbs().maxCoeff(),
                1e-4 * exact.cwiseAbs().maxCoeff() + rounding)
          << problem->id << " parameter " << k + 1;
    }
  }
}

void expect_passed(const CertifiedRun& run) {
  EXPECT_TRUE(run.passed()) << run.problem->id << " from start " << run.start + 1 << " by "
                            << name_of(run.backend) << ": " << run.judged_digits << " of "
                            << run.required_digits << " digits, " << name_of(run.termination) << " "
                            << run.failure;
}

TEST(Certified, CeresFindsEverySolutionOfNistToSixDigits) {
  for (const auto* problem : collection("nist")) {
    for (std::size_t start = 0; start < 2; ++start) {
      const auto run = run_certified(*problem, start, Backend::ceres);
      EXPECT_EQ(run.required_digits, 6.0);
      expect_passed(run);
    }
  }
}

TEST(Certified, CeresFindsTheMinimaOfMoreGarbowAndHillstrom) {
  EXPECT_GE(collection("mgh").size(), 19u);
  for (const auto* problem : collection("mgh")) {
    expect_passed(run_certified(*problem, 0, Backend::ceres));
  }
}

TEST(Certified, IpoptFindsTheQuickOnesToFourDigits) {
  for (const char* id :
       {"Misra1a", "BoxBOD", "Eckerle4", "Gauss1", "Nelson", "Rat43", "Roszman1"}) {
    for (std::size_t start = 0; start < 2; ++start) {
      expect_passed(run_certified(problem_named(id), start, Backend::ipopt));
    }
  }
}

// MUMPS is not thread-safe; the mutex of the adapter has to hold.
TEST(Certified, IpoptSolvesFromManyThreads) {
  const auto& problem = problem_named("Rat42");
  const auto alone = run_certified(problem, 0, Backend::ipopt);
  std::vector<CertifiedRun> runs(8);
  {
    std::vector<std::jthread> threads;
    for (auto& run : runs) {
      threads.emplace_back([&] { run = run_certified(problem, 0, Backend::ipopt); });
    }
  }
  for (const auto& run : runs) EXPECT_EQ(run.parameters, alone.parameters);
}

/// log(p), which has no value from zero down; reported either as a failure or as NaN.
class Logarithm final : public LeastSquaresProblem {
 public:
  explicit Logarithm(bool says) : says_(says) {}
  std::size_t blocks() const override { return 1; }
  std::size_t residuals(std::size_t) const override { return 1; }
  Result<void> evaluate(std::size_t, std::span<const double> p, std::span<double> residual,
                        std::span<double> jacobian) const override {
    if (says_ && p[0] <= 0.0) return failure(ErrorCode::numerics, "no logarithm");
    residual[0] = std::log(p[0]);
    if (!jacobian.empty()) jacobian[0] = 1.0 / p[0];
    return {};
  }

 private:
  bool says_;
};

constexpr SolverSettings kPatient{
    .max_iterations = 200, .function_tolerance = 1e-14, .parameter_tolerance = 1e-14};

// The bounds of Gay (1984).
TEST(Certified, GulfHasNoPerfectFitWithinItsPublishedBounds) {
  const CertifiedProblem& gulf = problem_named("Gulf research");
  std::vector<BoundedParameter> parameters;
  for (const double start : gulf.starts[0]) {
    parameters.push_back({.start = start, .lower = 0.0, .upper = 10.0});
  }
  const auto solution = minimise(*gulf.residuals, parameters, kPatient);
  ASSERT_TRUE(solution) << solution.error().message();
  claims::expect("docs/certified.md", "gulf",
                 {{"sum of squares", 2.0 * solution->cost},
                  {"x1", solution->p[0]},
                  {"x2", solution->p[1]},
                  {"x3", solution->p[2]}});
}

// The full step from 10 goes to 10 - 10 ln 10 < 0.
TEST(MinimiseIpopt, TurnsBackWhereNothingCanBeEvaluated) {
  for (const bool says : {true, false}) {
    const std::vector<BoundedParameter> parameters = {{.start = 10, .lower = -99, .upper = 99}};
    const auto solution = minimise_ipopt(Logarithm(says), parameters, kPatient);
    ASSERT_TRUE(solution) << solution.error().message();
    EXPECT_NEAR(solution->p[0], 1.0, 1e-6);
  }
}

TEST(MinimiseIpopt, SaysWithWhichParametersAStartFails) {
  for (const bool says : {true, false}) {
    const std::vector<BoundedParameter> parameters = {{.start = -7.5, .lower = -99, .upper = 99}};
    const auto solution = minimise_ipopt(Logarithm(says), parameters, kPatient);
    ASSERT_FALSE(solution);
    EXPECT_EQ(solution.error().code, ErrorCode::numerics);
    EXPECT_THAT(solution.error().message(), testing::HasSubstr("-7.5"));
  }
}

TEST(MinimiseIpopt, HoldsBounds) {
  const std::vector<BoundedParameter> parameters = {{.start = 10, .lower = 2, .upper = 99}};
  const auto solution = minimise_ipopt(Logarithm(true), parameters, kPatient);
  ASSERT_TRUE(solution);
  EXPECT_GE(solution->p[0], 2.0);
  EXPECT_NEAR(solution->p[0], 2.0, 1e-6);
  EXPECT_TRUE(solution->bound_active[0]);
}

TEST(MinimiseIpopt, FindsTheSameWithCurvatureFromTheGradients) {
  SolverSettings settings = kPatient;
  settings.curvature = Curvature::limited_memory;
  const std::vector<BoundedParameter> parameters = {{.start = 3, .lower = 0.1, .upper = 99}};
  const auto solution = minimise_ipopt(Logarithm(true), parameters, settings);
  ASSERT_TRUE(solution);
  EXPECT_NEAR(solution->p[0], 1.0, 1e-6);
}

}  // namespace
}  // namespace flexspline::estimators
