// The kernels against the laws of the catalogue, stepped one recording at a time with duals, and
// against closed forms.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <Eigen/Core>

#include "flexspline/core/lane_kernels.hpp"
#include "flexspline/core/law.hpp"
#include "flexspline/core/law_scalar.hpp"

namespace flexspline {
namespace {

constexpr int kIntervals = 30;
constexpr int kParts = 2;
const std::vector<double> kCoefficients = {1.0, 0.5, 0.25, 8.0, 12.0, 20.0, 0.4, -0.15};

// phi' = h(phi) g(tau - f(phi)) by the catalogue's laws.
class CatalogueLaw {
 public:
  CatalogueLaw()
      : f_(made("odd_polynomial", 0, 3)),
        g_(made("odd_polynomial", 3, 3)),
        h_(made("exponential_modulation", 6, 2)) {}

  template <class S>
  S rate(const std::vector<S>& p, double torque, const S& x) const {
    const std::span<const S> all(p);
    const S u(torque - evaluate(*f_, x, all.subspan(0, 3)));
    return S(evaluate(*h_, x, all.subspan(6, 2)) * evaluate(*g_, u, all.subspan(3, 3)));
  }

 private:
  static std::unique_ptr<Law> made(std::string law, std::size_t first, std::size_t count) {
    const auto c = std::span(kCoefficients).subspan(first, count);
    return std::move(*make_law(
        {.law = std::move(law), .scale = 1.0, .knots = {}, .coefficients = {c.begin(), c.end()}}));
  }
  std::unique_ptr<Law> f_, g_, h_;
};

// A recording a lane: torque amplitude and frequency grow with the lane.
struct Records {
  int lanes;
  std::vector<double> width, torque, measured, weight, initial;

  double step(int lane) const { return 0.004 * (1.0 + 0.3 * lane); }
  double torque_at(int lane, double t) const {
    return (0.4 + 0.12 * lane) * std::sin(2.0 * std::numbers::pi * t / (kIntervals * step(lane)));
  }

  Records(int count, std::span<const double> nodes, int parts, bool with_start) : lanes(count) {
    for (int lane = 0; lane < lanes; ++lane) {
      width.push_back(step(lane));
      weight.push_back(1.0 / (1.0 + lane));
      initial.push_back(0.01 * lane);
    }
    if (with_start) add_torque(0.0);
    for (int n = 0; n < kIntervals * parts; ++n) {
      for (const double node : nodes) add_torque((n + node) / parts);
    }
    for (int n = 0; n < kIntervals; ++n) {
      for (int lane = 0; lane < lanes; ++lane) measured.push_back(0.1 * std::sin(n + lane));
    }
  }

  LaneBlock block(int parts) const {
    return {.lanes = lanes,
            .intervals = kIntervals,
            .parts = parts,
            .first_parts = parts,
            .width = width.data(),
            .torque = torque.data(),
            .measured = measured.data(),
            .weight = weight.data(),
            .initial = initial.data()};
  }

 private:
  void add_torque(double intervals) {
    for (int lane = 0; lane < lanes; ++lane) {
      torque.push_back(torque_at(lane, intervals * step(lane)));
    }
  }
};

LaneLaws laws(bool free_initial = false) {
  return {
      .f = 3, .g = 3, .h = 2, .coefficient = kCoefficients.data(), .free_initial = free_initial};
}

struct Reference {
  std::vector<double> state;
  Eigen::MatrixXd normal;
};

// The classical formula with duals, B'B at the end of every interval; the last direction is the
// initial state.
Reference stepped(const Records& records, int lane) {
  const CatalogueLaw law;
  const auto directions = static_cast<int>(kCoefficients.size()) + 1;
  std::vector<Dual> p;
  for (std::size_t k = 0; k < kCoefficients.size(); ++k) {
    p.emplace_back(kCoefficients[k], directions, static_cast<int>(k));
  }
  const auto at = static_cast<std::size_t>(lane);
  Dual x(records.initial[at], directions, directions - 1);
  Reference result{{}, Eigen::MatrixXd::Zero(directions + 1, directions + 1)};
  const double h = records.step(lane) / kParts;
  for (int n = 0; n < kIntervals; ++n) {
    for (int part = 0; part < kParts; ++part) {
      const double t = (n + static_cast<double>(part) / kParts) * records.step(lane);
      const double middle = records.torque_at(lane, t + 0.5 * h);
      const Dual k1 = law.rate(p, records.torque_at(lane, t), x);
      const Dual k2 = law.rate(p, middle, x + 0.5 * h * k1);
      const Dual k3 = law.rate(p, middle, x + 0.5 * h * k2);
      const Dual k4 = law.rate(p, records.torque_at(lane, t + h), x + h * k3);
      x = x + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    }
    result.state.push_back(x.value());
    Eigen::VectorXd row(directions + 1);
    const double measured = records.measured[static_cast<std::size_t>(n * records.lanes + lane)];
    for (int k = 0; k < directions; ++k) row[k] = x.slope(k);
    row[directions] = x.value() - measured;
    row *= records.weight[at];
    result.normal += row * row.transpose();
  }
  return result;
}

std::vector<std::pair<InstructionSet, int>> kernels_here() {
  std::vector<std::pair<InstructionSet, int>> all;
  for (int set = 0; set <= static_cast<int>(best_instruction_set()); ++set) {
    const auto instructions = static_cast<InstructionSet>(set);
    for (int lanes = 2; lanes <= most_lanes(instructions); lanes *= 2) {
      all.emplace_back(instructions, lanes);
    }
  }
  return all;
}

TEST(LaneKernels, AgreeWithTheCataloguesLawsToRounding) {
  for (const auto& [set, lanes] : kernels_here()) {
    const Records records(lanes, kRungeKuttaNodes, kParts, true);
    const std::size_t size = 10 * 11 / 2;
    const auto width = static_cast<std::size_t>(lanes);
    std::vector<double> normal(size * width);
    std::vector<double> state(kIntervals * width);
    lane_kernel(set, LaneFormula::runge_kutta, lanes)(laws(true), records.block(kParts),
                                                      {normal.data(), nullptr, state.data()});
    for (int lane = 0; lane < lanes; ++lane) {
      const Reference reference = stepped(records, lane);
      const auto at = static_cast<std::size_t>(lane);
      for (std::size_t n = 0; n < kIntervals; ++n) {
        EXPECT_NEAR(state[n * width + at], reference.state[n], 1e-14) << "lane " << lane;
      }
      std::size_t k = 0;
      for (Eigen::Index i = 0; i < 10; ++i) {
        for (Eigen::Index j = 0; j <= i; ++j, ++k) {
          const double size_of = std::sqrt(reference.normal(i, i) * reference.normal(j, j));
          EXPECT_NEAR(normal[k * width + at], reference.normal(i, j), 1e-12 * size_of)
              << "lane " << lane << " of " << lanes << ", entry " << i << ", " << j;
        }
      }
    }
  }
}

TEST(LaneKernels, GiveTheGradientOfTheImplicitFormula) {
  for (const auto& [set, lanes] : kernels_here()) {
    const Records records(lanes, kRadauNodes, 1, false);
    const auto kernel = lane_kernel(set, LaneFormula::radau, lanes);
    const auto width = static_cast<std::size_t>(lanes);
    std::vector<double> normal(9 * 10 / 2 * width);
    kernel(laws(), records.block(1), {normal.data(), nullptr, nullptr});
    const auto cost = [&](std::vector<double> p, std::size_t lane) {
      std::vector<double> sums(9 * 10 / 2 * width);
      LaneLaws moved = laws();
      moved.coefficient = p.data();
      kernel(moved, records.block(1), {sums.data(), nullptr, nullptr});
      return 0.5 * sums[44 * width + lane];
    };
    for (std::size_t k = 0; k < kCoefficients.size(); ++k) {
      const double step = 1e-5 * std::max(1.0, std::abs(kCoefficients[k]));
      auto up = kCoefficients;
      auto down = kCoefficients;
      up[k] += step;
      down[k] -= step;
      const double difference = (cost(up, 1) - cost(down, 1)) / (2.0 * step);
      EXPECT_NEAR(normal[(36 + k) * width + 1], difference, 1e-8) << "coefficient " << k;
    }
  }
}

// x' = g (tau - k x), tau constant: x = tau/k (1 - exp(-g k t)).
double linear_error(LaneFormula formula, double stiffness, int parts) {
  const std::vector<double> p = {2.0, stiffness / 2.0};
  const std::vector<double> width = {1.0, 1.0};
  const std::vector<double> torque(static_cast<std::size_t>(2 * (3 * parts + 1)), 0.5);
  const std::vector<double> zero(2, 0.0);
  std::vector<double> state(2);
  const LaneBlock block{.lanes = 2,
                        .intervals = 1,
                        .parts = parts,
                        .first_parts = parts,
                        .width = width.data(),
                        .torque = torque.data(),
                        .measured = zero.data(),
                        .weight = zero.data(),
                        .initial = zero.data()};
  lane_kernel(InstructionSet::baseline, formula, 2)(
      {.f = 1, .g = 1, .h = 0, .coefficient = p.data()}, block, {nullptr, nullptr, state.data()});
  return std::abs(state[0] - 0.25 * (1.0 - std::exp(-stiffness)));
}

TEST(LaneKernels, ConvergeInTheOrderOfTheirFormulas) {
  const double explicit_order = std::log2(linear_error(LaneFormula::runge_kutta, 2.0, 8) /
                                          linear_error(LaneFormula::runge_kutta, 2.0, 16));
  const double implicit_order = std::log2(linear_error(LaneFormula::radau, 3.0, 4) /
                                          linear_error(LaneFormula::radau, 3.0, 8));
  EXPECT_NEAR(explicit_order, 4.0, 0.2);
  EXPECT_NEAR(implicit_order, 5.0, 0.2);
}

TEST(LaneKernels, DampAStiffLayerInOneImplicitStep) {
  EXPECT_LT(linear_error(LaneFormula::radau, 1e6, 1), 1e-5);
}

TEST(LaneKernels, ShowAnOverflowAsNoNumber) {
  EXPECT_FALSE(linear_error(LaneFormula::runge_kutta, 1e200, 4) < 1e300);
}

}  // namespace
}  // namespace flexspline
