// Derivatives of the collocation problem and of its numbers, and the solver below it.
#include <cmath>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Dense>

#include "flexspline/estimators/certified_ode.hpp"
#include "ode_fit/collocation_nlp.hpp"
#include "ode_fit_fixture.hpp"

namespace flexspline::estimators {
namespace {

// f = sin(x y) exp(x) / y: all second derivatives in closed form.
TEST(HyperDual, GivesSecondDerivatives) {
  const double a = 0.7;
  const double b = 1.3;
  const auto f = [](const HyperDual& x, const HyperDual& y) { return sin(x * y) * exp(x) / y; };
  const HyperDual mixed = f(HyperDual(a, 1.0, 0.0), HyperDual(b, 0.0, 1.0));
  const double s = std::sin(a * b);
  const double c = std::cos(a * b);
  const double e = std::exp(a);
  EXPECT_NEAR(mixed.value, s * e / b, 1e-15);
  EXPECT_NEAR(mixed.first, e * (c + s / b), 1e-14);
  EXPECT_NEAR(mixed.second, e * (a * c / b - s / (b * b)), 1e-14);
  EXPECT_NEAR(mixed.mixed, e * (-a * s + a * c / b - s / (b * b)), 1e-14);
  const HyperDual twice = f(HyperDual(a, 1.0, 1.0), b);
  EXPECT_NEAR(twice.mixed, e * (2.0 * c - b * s + s / b), 1e-14);
}

// Each function against the identity that ties it to products.
TEST(HyperDual, FunctionsKeepTheirIdentities) {
  HyperDual x(0.6, 1.0, 0.4);
  x.mixed = -0.3;
  const auto same = [](const HyperDual& a, const HyperDual& b) {
    EXPECT_NEAR(a.value, b.value, 1e-14);
    EXPECT_NEAR(a.first, b.first, 1e-14);
    EXPECT_NEAR(a.second, b.second, 1e-14);
    EXPECT_NEAR(a.mixed, b.mixed, 1e-13);
  };
  same(log(exp(x)), x);
  same(sqrt(x) * sqrt(x), x);
  same(sin(x) * sin(x) + cos(x) * cos(x), 1.0);
  same(tanh(x), (exp(x) - exp(-x)) / (exp(x) + exp(-x)));
  same(pow(x, 3.0), x * x * x);
  same(sin(atan(x)), x / sqrt(1.0 + x * x));
}

TEST(RadauMesh, DifferentiatesAndReadsCubicsExactly) {
  const auto cubic = [](double s) { return 1.0 + s * (2.0 + s * (-3.0 + 0.5 * s)); };
  const auto slope = [](double s) { return 2.0 + s * (-6.0 + 1.5 * s); };
  for (std::size_t j = 0; j < kStages; ++j) {
    double sum = radau().of_start[j] * cubic(0.0);
    for (std::size_t k = 0; k < kStages; ++k) {
      sum += radau().derivative[j][k] * cubic(radau().node[k]);
    }
    EXPECT_NEAR(sum, slope(radau().node[j]), 1e-13);
  }
  const auto weight = interpolation(0.37);
  double read = weight[0] * cubic(0.0);
  for (std::size_t k = 0; k < kStages; ++k) read += weight[k + 1] * cubic(radau().node[k]);
  EXPECT_NEAR(read, cubic(0.37), 1e-14);
}

// A problem with every kind of entry: a nonlinear law, free initial values that are measured.
struct Case {
  OdeLayout layout;
  std::vector<Mesh> meshes;
  std::vector<double> x;
};

Case methanol_with_free_start() {
  OdeFitProblem problem;
  for (const auto& row : certified_odes()) {
    if (row.name == "methanol") problem = row.problem;
  }
  auto& initial = problem.experiments[0].initial;
  initial[0] = OdeParameter{.name = "y1(0)", .start = 1.0};
  initial[2] = OdeParameter{.name = "y3(0)", .start = 0.1};
  problem.parameters[1].scale = 3.0;
  problem.state_scale = {1.0, 0.5, 0.25};
  Case result{lay_out(problem), {}, {}};
  result.meshes = {first_mesh(result.layout.experiments[0])};
  return result;
}

Eigen::MatrixXd dense(const SparsePattern& pattern, std::span<const double> values,
                      std::size_t rows, std::size_t columns) {
  Eigen::MatrixXd m =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
  for (std::size_t k = 0; k < values.size(); ++k) m(pattern.row[k], pattern.column[k]) += values[k];
  return m;
}

struct Derivatives {
  Eigen::VectorXd constraint;
  Eigen::VectorXd gradient;
  Eigen::MatrixXd jacobian;
};

Derivatives derivatives(const CollocationNlp& nlp, std::span<const double> x) {
  Derivatives d{Eigen::VectorXd(static_cast<Eigen::Index>(nlp.constraints())),
                Eigen::VectorXd(static_cast<Eigen::Index>(nlp.variables())),
                {}};
  EXPECT_TRUE(nlp.constraint(x, {d.constraint.data(), nlp.constraints()}));
  EXPECT_TRUE(nlp.gradient(x, {d.gradient.data(), nlp.variables()}));
  const auto pattern = nlp.jacobian_pattern();
  std::vector<double> values(pattern.size());
  EXPECT_TRUE(nlp.jacobian(x, values));
  d.jacobian = dense(pattern, values, nlp.constraints(), nlp.variables());
  return d;
}

// The same with everything that may be added: coloured noise, a robust loss, inequalities.
class Product final : public OdeInequalityLaw<Product> {
 public:
  std::size_t count() const override { return 2; }
  std::string name(std::size_t) const override { return "product"; }
  double lower(std::size_t) const override { return 0.0; }
  double upper(std::size_t) const override { return 1.0; }
  template <class S>
  void functions(std::span<const S> p, std::span<S> g) const {
    g[0] = S(p[0] * S(p[1] * p[2]));
    g[1] = S(p[3] * p[3]);
  }
};

Case with_everything() {
  Case c = methanol_with_free_start();
  c.layout.loss = {Loss::cauchy, 0.4};
  c.layout.inequalities = std::make_shared<Product>();
  auto& experiment = c.layout.experiments[0];
  for (std::size_t o = 0; o < experiment.outputs(); ++o) {
    experiment.whitening.emplace_back(ColouredNoise{1.0, 0.7, 0.1}, experiment.source.times);
  }
  return c;
}

class CollocationDerivatives : public ::testing::TestWithParam<Case (*)()> {};

INSTANTIATE_TEST_SUITE_P(CollocationNlp, CollocationDerivatives,
                         ::testing::Values(methanol_with_free_start, with_everything),
                         [](const auto& each) {
                           return each.index == 0 ? std::string("plain") : "with_everything";
                         });

TEST_P(CollocationDerivatives, AgreeWithDifferences) {
  const Case c = GetParam()();
  const auto* system = dynamic_cast<const TwiceOdeSystem*>(c.layout.system.get());
  const CollocationNlp nlp(c.layout, *system, c.meshes);
  std::vector<double> x(nlp.variables());
  for (std::size_t v = 0; v < x.size(); ++v)
    x[v] = 0.6 + 0.3 * std::sin(1.7 * static_cast<double>(v));
  std::vector<double> lambda(nlp.constraints());
  for (std::size_t k = 0; k < lambda.size(); ++k)
    lambda[k] = std::cos(0.9 * static_cast<double>(k));
  const auto pattern = nlp.hessian_pattern();
  std::vector<double> values(pattern.size());
  ASSERT_TRUE(nlp.hessian(x, 0.8, lambda, values));
  Eigen::MatrixXd hessian = dense(pattern, values, x.size(), x.size());
  EXPECT_TRUE(hessian.isLowerTriangular()) << "the solver reads one triangle";
  hessian = hessian.selfadjointView<Eigen::Lower>();
  const Eigen::Map<const Eigen::VectorXd> weights(lambda.data(),
                                                  static_cast<Eigen::Index>(lambda.size()));
  const Derivatives at = derivatives(nlp, x);
  constexpr double kStep = 1e-5;
  for (std::size_t v = 0; v < x.size(); ++v) {
    auto ahead = x;
    auto behind = x;
    ahead[v] += kStep;
    behind[v] -= kStep;
    const Derivatives plus = derivatives(nlp, ahead);
    const Derivatives minus = derivatives(nlp, behind);
    const auto column = static_cast<Eigen::Index>(v);
    const Eigen::VectorXd slope = (plus.constraint - minus.constraint) / (2.0 * kStep);
    EXPECT_LT((slope - at.jacobian.col(column)).cwiseAbs().maxCoeff(), 1e-8) << v;
    const Eigen::VectorXd bend = (0.8 * (plus.gradient - minus.gradient) +
                                  (plus.jacobian - minus.jacobian).transpose() * weights) /
                                 (2.0 * kStep);
    EXPECT_LT((bend - hessian.col(column)).cwiseAbs().maxCoeff(), 1e-8) << v;
    double f_plus = 0.0;
    double f_minus = 0.0;
    ASSERT_TRUE(nlp.objective(ahead, f_plus) && nlp.objective(behind, f_minus));
    EXPECT_NEAR((f_plus - f_minus) / (2.0 * kStep), at.gradient[column], 1e-8) << v;
  }
}

// MUMPS has global state: solves in several threads must take turns and agree to the bit.
TEST(IpoptLock, LetsThreadsSolveAtOnce) {
  const auto problem = decay(0.02);
  const auto alone = fit_ode(problem, OdeFitMethod::collocation);
  ASSERT_TRUE(alone);
  std::vector<double> costs(8, 0.0);
  {
    std::vector<std::jthread> threads;
    for (double& cost : costs) {
      threads.emplace_back([&cost, &problem] {
        const auto fit = fit_ode(problem, OdeFitMethod::collocation);
        if (fit) cost = fit->cost;
      });
    }
  }
  EXPECT_THAT(costs, ::testing::Each(alone->cost));
}

}  // namespace
}  // namespace flexspline::estimators
