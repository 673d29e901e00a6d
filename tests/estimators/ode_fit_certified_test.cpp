// Published estimation problems: every method at the certified optimum.
#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "claims/claims.hpp"
#include "flexspline/estimators/certified_ode.hpp"
#include "ode_fit_fixture.hpp"

namespace flexspline::estimators {
namespace {

const CertifiedOde& certified(const std::string& name) {
  for (const auto& row : certified_odes()) {
    if (row.name == name) return row;
  }
  throw std::out_of_range(name);
}

class CertifiedFit : public ::testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(OdeFit, CertifiedFit,
                         ::testing::Values("gasoil", "lotka_volterra", "marine", "methanol",
                                           "pinene"),
                         [](const auto& each) { return each.param; });

void expect_certified(const CertifiedOde& row, const OdeFit& fit) {
  EXPECT_EQ(fit.termination, Termination::converged);
  EXPECT_NEAR(2.0 * fit.cost / row.sum_of_squares, 1.0, 1e-6);
  for (std::size_t k = 0; k < row.parameters.size(); ++k) {
    const auto& p = fit.parameters[k];
    if (p.bound_active) {
      EXPECT_NEAR(row.parameters[k], 0.0, 1e-12) << p.name;
      continue;
    }
    EXPECT_NEAR(p.value, row.parameters[k], 0.01 * p.std) << p.name;
    if (std::isfinite(row.std[k])) {
      EXPECT_NEAR(p.std / row.std[k], 1.0, 2e-4) << p.name;
    }
  }
}

TEST_P(CertifiedFit, EveryMethodEndsAtTheSameOptimum) {
  const auto& row = certified(GetParam());
  std::vector<OdeFit> fits;
  for (const auto method : kOdeFitMethods) {
    const auto fit = fit_ode(row.problem, method);
    ASSERT_TRUE(fit) << fit.error().message();
    SCOPED_TRACE(name_of(method));
    expect_certified(row, *fit);
    fits.push_back(*fit);
  }
  for (std::size_t m = 1; m < fits.size(); ++m) {
    EXPECT_NEAR(fits[m].cost / fits[0].cost, 1.0, 1e-6);
    for (std::size_t k = 0; k < fits[0].parameters.size(); ++k) {
      const auto& first = fits[0].parameters[k];
      const auto& other = fits[m].parameters[k];
      EXPECT_EQ(first.bound_active, other.bound_active) << first.name;
      if (!first.bound_active) {
        EXPECT_NEAR(first.value, other.value, 0.01 * first.std);
      }
    }
  }
}

// Printed by COPS with its mesh; marine's is of the implicit midpoint rule.
TEST(CertifiedRows, AgreeWithThePublishedSums) {
  EXPECT_NEAR(certified("gasoil").sum_of_squares, 5.2366e-3, 5e-8);
  EXPECT_NEAR(certified("pinene").sum_of_squares, 19.8721, 1e-4);
  EXPECT_NEAR(certified("methanol").sum_of_squares, 9.02229e-3, 1e-8);
  const CertifiedOde& marine = certified("marine");
  EXPECT_NEAR(marine.sum_of_squares / 1.97462e7, 1.0, 2e-5);
  claims::expect("docs/certified.md", "marine", {{"published", marine.published_sum}});
  claims::expect("docs/certified.md", "marine-below",
                 {{"below", 1.0 - marine.published_sum / marine.sum_of_squares}});
}

// Half-widths published with PSOPT: 0.660, 0.622, 0.707; t(0.975, 39) = 2.02269.
TEST(CertifiedGasoil, HasThePublishedIntervals) {
  const double half_widths[] = {0.6603, 0.6225, 0.7066};
  for (const auto method : kOdeFitMethods) {
    const auto fit = fit_ode(certified("gasoil").problem, method);
    ASSERT_TRUE(fit) << fit.error().message();
    EXPECT_EQ(fit->degrees_of_freedom, 39.0);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& p = fit->parameters[k];
      EXPECT_NEAR(p.ci95_upper - p.value, half_widths[k], 5.1e-5) << name_of(method);
      EXPECT_NEAR(p.value - p.ci95_lower, half_widths[k], 5.1e-5) << name_of(method);
    }
    const auto correlation = [&](int a, int b) {
      return fit->covariance(a, b) / std::sqrt(fit->covariance(a, a) * fit->covariance(b, b));
    };
    EXPECT_NEAR(correlation(0, 1), 0.786, 6e-4);
    EXPECT_NEAR(correlation(0, 2), -0.844, 6e-4);
    EXPECT_NEAR(correlation(1, 2), -0.870, 6e-4);
  }
}

// The last rate lies on 0: inverting all of J'J would tell of a width that is not there.
TEST(CertifiedMethanol, KeepsTheRateOnItsBoundOutOfTheCovariance) {
  for (const auto method : kOdeFitMethods) {
    const auto fit = fit_ode(certified("methanol").problem, method);
    ASSERT_TRUE(fit) << fit.error().message();
    EXPECT_TRUE(fit->parameters[4].bound_active);
    EXPECT_EQ(fit->parameters[4].value, 0.0);
    EXPECT_TRUE(std::isnan(fit->parameters[4].std));
    EXPECT_EQ(fit->covariance.row(4).norm(), 0.0);
    EXPECT_GT(fit->covariance(0, 0), 0.0);
  }
}

// From rates of 0.5 single shooting ends in another minimum, with two rates on 0; states at nodes
// and the trajectory as unknowns start from the samples and end at the certified one.
TEST(CertifiedLotkaVolterra, IsFoundFromAfarByWhatStartsFromTheSamples) {
  const auto& row = certified("lotka_volterra");
  auto problem = row.problem;
  for (auto& rate : problem.parameters) rate.start = 0.5;
  const auto single = fit_ode(problem, OdeFitMethod::single_shooting);
  ASSERT_TRUE(single) << single.error().message();
  EXPECT_GT(single->cost, 100.0 * row.sum_of_squares);
  for (const auto method : {OdeFitMethod::multiple_shooting, OdeFitMethod::collocation}) {
    const auto fit = fit_ode(problem, method);
    ASSERT_TRUE(fit) << fit.error().message();
    expect_certified(row, *fit);
  }
}

}  // namespace
}  // namespace flexspline::estimators
