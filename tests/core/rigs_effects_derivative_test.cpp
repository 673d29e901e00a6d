// Every effect in every rig: the Jacobians of the equations of motion by duals, where the inputs
// and whatever is not differentiated are constants, against central differences.
#include <algorithm>
#include <cmath>
#include <random>

#include "claims/claims.hpp"
#include "effect_paths.hpp"
#include "flexspline/core/effect.hpp"
#include "integrators/system_duals.hpp"
#include "rig_examples.hpp"

namespace flexspline {
namespace {

/// Of a derivative, where differences tell it so well.
constexpr double kDifference = 1e-5;

struct Form {
  Rig rig;
  std::string id;
};

std::vector<Form> forms() {
  std::vector<Form> all;
  for (const RigRow& row : rigs()) {
    for (const RigForm& form : row.forms) all.push_back({row.rig, std::string(form.id)});
  }
  return all;
}

std::string name_of(const Form& form) { return std::string(rig_row(form.rig).id) + "_" + form.id; }

/// Every channel that a form may ask for, of a usual size.
RigInputs every_input(const Form& form) {
  const double turn = form.rig == Rig::specimen ? 2e-3 : 0.1;
  return {{{Quantity::motor_torque, sine(0.4, 2.0)},
           {Quantity::commanded_angle, sine(turn, 2.0)},
           {Quantity::torsion, sine(turn, 2.0)},
           {Quantity::transmitted_torque, sine(20.0, 2.0)},
           {Quantity::current, sine(4.0, 2.0)},
           {Quantity::duty_cycle, sine(0.5, 2.0)},
           {Quantity::supply_voltage, constant(12.0)}},
          {},
          constant(1.5)};
}

/// Rates as a function of all arguments, states then parameters.
std::vector<double> rates(const RigSystem& rig, double t, const std::vector<double>& z) {
  std::vector<double> out(rig.states());
  const std::span<const double> all(z);
  rig.rate(t, all.first(rig.states()), all.subspan(rig.states()), out);
  return out;
}

/// Central difference of fourth order.
std::vector<double> difference(const RigSystem& rig, double t, std::vector<double> z, std::size_t k,
                               double step) {
  const double at = z[k];
  std::vector<double> sum(rig.states());
  const double weights[] = {8.0, -8.0, -1.0, 1.0};
  const double steps[] = {1.0, -1.0, 2.0, -2.0};
  for (int s = 0; s < 4; ++s) {
    z[k] = at + steps[s] * step;
    const auto moved = rates(rig, t, z);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += weights[s] * moved[i] / (12.0 * step);
  }
  return sum;
}

class EveryEffectInEveryRig : public testing::TestWithParam<Form> {
 protected:
  int smooth_ = 0;
  int tried_ = 0;

  DriveSpec drive_with(const EffectRow& row, std::mt19937_64& draw) const {
    DriveSpec drive = example_drive();
    if (GetParam().rig == Rig::specimen) drive.gear_ratio = 1.0;
    const auto values = scattered_parameters(row, draw);
    EffectSpec spec{std::string(row.id), {}};
    for (std::size_t k = 0; k < row.parameters.size(); ++k) {
      spec.parameters.emplace_back(row.parameters[k].name, values[k]);
    }
    drive.torsion.effects = {spec};
    return drive;
  }

  /// States along a simulated motion: away from rest, within the reach of the laws.
  static std::vector<double> reached(const RigSystem& rig, double t) {
    SystemSettings settings;
    settings.relative_tolerance = 1e-6;
    const double times[] = {0.0, t};
    auto start = rig.rest();
    const auto run = integrate_system(rig, rig.parameter_vector(), times, start, settings);
    EXPECT_TRUE(run) << run.error().message();
    if (!run) return {};
    return {run->state.begin() + static_cast<std::ptrdiff_t>(rig.states()), run->state.end()};
  }

  void expect_jacobian(const RigSystem& rig, const std::string& name, double t) {
    SCOPED_TRACE(name);
    const auto p = rig.parameter_vector();
    auto z = reached(rig, t);
    if (z.empty()) return;
    const auto n = static_cast<Eigen::Index>(rig.states());
    Eigen::MatrixXd exact(n, n + static_cast<Eigen::Index>(p.size()));
    SystemDuals duals(rig, p);
    duals.jacobian(t, z.data(), Eigen::Map<Eigen::MatrixXd>(exact.data(), n, n));
    duals.parameter_jacobian(
        t, z.data(), Eigen::Map<Eigen::MatrixXd>(exact.data() + n * n, n, exact.cols() - n));
    z.insert(z.end(), p.begin(), p.end());
    const auto now = rates(rig, t, z);
    for (std::size_t k = 0; k < z.size(); ++k) {
      const double size = std::max(std::abs(z[k]), 1e-6);
      const auto fine = difference(rig, t, z, k, 1e-5 * size);
      const auto coarse = difference(rig, t, z, k, 1e-4 * size);
      for (std::size_t i = 0; i < now.size(); ++i) {
        const double slope = exact(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
        ++tried_;
        const double rounding = 1e-9 * std::abs(now[i]) / size;
        const double spread = std::abs(fine[i] - coarse[i]);
        if (spread > 1e-3 * std::abs(coarse[i]) + 10.0 * rounding) continue;  // near a kink
        ++smooth_;
        EXPECT_NEAR(slope, coarse[i], kDifference * std::abs(slope) + 3.0 * spread + rounding)
            << name << ": rate " << i << " by argument " << k << " of " << z.size() << " ("
            << rig.states() << " states) at " << t << " s";
      }
    }
  }
};

TEST_P(EveryEffectInEveryRig, HasTheDerivativesOfItsEquations) {
  int simulated = 0;
  for (const EffectRow& row : effects()) {
    // The same whatever else is in the catalogue.
    std::vector<std::uint32_t> own(row.id.begin(), row.id.end());
    own.push_back(20261120);
    std::seed_seq seeds(own.begin(), own.end());
    std::mt19937_64 draw(seeds);
    const auto drive = drive_with(row, draw);
    const auto rig = make_rig(GetParam().rig, drive, every_input(GetParam()), GetParam().id);
    if (!rig) {
      EXPECT_FALSE(rig.error().message().empty());
      continue;  // has no place there: said by the tests of refusals
    }
    ++simulated;
    for (const double t : {0.071, 0.163}) expect_jacobian(**rig, std::string(row.id), t);
    if (HasFailure()) break;
  }
  std::printf("%s: %d effects, %d of %d derivatives compared\n", name_of(GetParam()).c_str(),
              simulated, smooth_, tried_);
  EXPECT_GT(simulated, 10);
  EXPECT_GT(smooth_, 0.9 * tried_);
}

TEST(EveryFormOfThePage, HasTheDerivativesOfItsEquations) {
  claims::expect("docs/simulation.md", "rig-jacobians",
                 {{"forms", static_cast<double>(forms().size())}, {"difference", kDifference}});
}

INSTANTIATE_TEST_SUITE_P(Rigs, EveryEffectInEveryRig, testing::ValuesIn(forms()),
                         [](const auto& param) { return name_of(param.param); });

}  // namespace
}  // namespace flexspline
