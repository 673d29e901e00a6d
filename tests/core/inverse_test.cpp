// Torque-driven and displacement-driven simulation undo each other, for every effect that acts in a
// torsion law.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "claims/claims.hpp"
#include "effect_paths.hpp"
#include "flexspline/core/simulate.hpp"
#include "flexspline/core/torque_signal.hpp"
#include "motions.hpp"
#include "rig_examples.hpp"

namespace flexspline {
namespace {

/// What may be lost there and back, of the largest.
constexpr double kLost = 1e-8;

bool acts_in_a_torsion_law(const EffectRow& row) {
  return row.site == Site::transmission || row.site == Site::kinematics ||
         row.site == Site::motor || row.site == Site::load || row.site == Site::torque_signal;
}

/// A law of the size of the effect: of the output, or of the motor shaft, whose angle the torsion
/// of a specimen is too.
struct Specimen {
  ModelSpec model;
  double range;
  double torque;
};

Specimen specimen_of(const EffectRow& row) {
  const bool motor = row.site == Site::motor;
  Specimen specimen{example_drive().torsion, 2e-3, 30.0};
  if (motor) {
    specimen.range = 0.2;
    specimen.torque = 1.0;
    specimen.model.f = law_spec("odd_polynomial", 0.2, {}, {0.8, 0.2});
    specimen.model.g_inverse = law_spec("odd_polynomial", 5.0, {}, {0.1, 0.03});
    specimen.model.h = law_spec("bounded_modulation", 0.2, {}, {0.1, 0.2});
  }
  specimen.model.effects = {{std::string(row.id), nominal_parameters(row)}};
  if (row.id == "load_dependent_kinematic_error") {
    // Passive beside a spring of at least its own compliance only.
    specimen.model.effects.push_back({"series_compliance", {{"compliance", 4.8e-5}}});
  }
  return specimen;
}

// Three shares of amplitude: minor loops, turning points between the samples. Starts at zero.
Motion loops(double range, int per_cycle) {
  Motion motion = harmonic_motion({0.5 * range, 0.3 * range, 0.2 * range}, per_cycle, 2);
  const double start = motion.position.front();
  for (double& x : motion.position) x -= start;
  return motion;
}

/// The two ways of driving a specimen in one system: the first by a signal, the second by what the
/// first makes of it, with no samples between them.
class ThereAndBack final : public OdeSystem {
 public:
  ThereAndBack(const DriveSpec& drive, Quantity given, const Signal& signal) {
    const bool moved = given == Quantity::torsion;
    first_ = made_rig(Rig::specimen, drive, {{{given, signal}}, {}},
                      moved ? "displacement_driven" : "force_driven");
    const Signal between{[this](double) { return value_; }, [this](double) { return rate_; }};
    const Quantity other = moved ? Quantity::transmitted_torque : Quantity::torsion;
    second_ = made_rig(Rig::specimen, drive, {{{other, between}}, {}},
                       moved ? "force_driven" : "displacement_driven");
    moved_ = moved;
    for (const EffectSpec& spec : drive.torsion.effects) {
      const EffectRow& row = **find_effect(spec.effect);
      if (row.site != Site::torque_signal) continue;
      sensor_ = &row;
      sensor_values_ = *parameter_values(row, spec);
      sensor_states_ = state_count(row, sensor_values_.size());
    }
    p_first_ = first_->parameter_vector();
    p_second_ = second_->parameter_vector();
  }

  std::size_t states() const override {
    return first_->states() + second_->states() + sensor_states_;
  }
  std::size_t parameters() const override { return 0; }
  void rate(double t, std::span<const double> y, std::span<const double>,
            std::span<double> ydot) const override {
    const std::size_t n = first_->states();
    const std::size_t m = second_->states();
    first_->rate(t, y.first(n), p_first_, ydot.first(n));
    const auto memory = pass_on(t, y, ydot.first(n));
    second_->rate(t, y.subspan(n, m), p_second_, ydot.subspan(n, m));
    std::ranges::copy(memory, ydot.subspan(n + m).begin());
  }
  // For Newton's iteration, without what the second sees of the first: that only feeds forward.
  void rate(double t, std::span<const Dual> y, std::span<const Dual>,
            std::span<Dual> ydot) const override {
    const std::size_t n = first_->states();
    const std::size_t m = second_->states();
    first_->rate(t, y.first(n), duals(p_first_), ydot.first(n));
    const auto memory = pass_on(t, reals(y), reals(ydot.first(n)));
    second_->rate(t, y.subspan(n, m), duals(p_second_), ydot.subspan(n, m));
    std::ranges::copy(memory, ydot.subspan(n + m).begin());
  }

  /// What the second gives back.
  double back(double t, std::span<const double> y) const {
    const std::size_t n = first_->states();
    if (moved_) return y[n];
    std::vector<double> ydot(n);
    first_->rate(t, y.first(n), p_first_, ydot);
    pass_on(t, y, ydot);
    return second_->instant(t, y.subspan(n, second_->states()), p_second_).transmitted_torque;
  }

 private:
  using Numbers = std::vector<double>;

  // Enters what the second sees, and gives the rates of the memory of the sensor between them.
  Numbers pass_on(double t, std::span<const double> y, std::span<const double> ydot) const {
    if (!moved_) {
      value_ = y[0];
      rate_ = ydot[0];
      return Numbers(sensor_states_, 0.0);
    }
    const Numbers from(y.begin(), y.begin() + static_cast<std::ptrdiff_t>(ydot.size()));
    const Numbers memory(y.end() - static_cast<std::ptrdiff_t>(sensor_states_), y.end());
    const Numbers still(sensor_states_, 0.0);
    const auto torque = [&](double by) {
      return true_torque(t, from, ydot, by).transmitted_torque;
    };
    Instant<double> x = true_torque(t, from, ydot, 0.0);
    x.transmitted_torque_rate = slope(torque);
    Numbers memory_rate = still;
    if (sensor_states_ > 0) sensor_->real.rate(x, sensor_values_, memory, memory_rate);
    const auto shown = [&](double by) {
      const auto now = true_torque(t, from, ydot, by);
      Numbers moved = memory;
      for (std::size_t k = 0; k < moved.size(); ++k) moved[k] += by * memory_rate[k];
      const double added =
          sensor_ == nullptr ? 0.0 : sensor_->real.term(now, sensor_values_, moved);
      return now.transmitted_torque + added;
    };
    value_ = shown(0.0);
    rate_ = slope(shown);
    return memory_rate;
  }

  template <class Function>
  static double slope(const Function& function) {
    constexpr double kStep = 1e-5;
    return (8.0 * (function(kStep) - function(-kStep)) -
            (function(2.0 * kStep) - function(-2.0 * kStep))) /
           (12.0 * kStep);
  }

  Instant<double> true_torque(double t, Numbers y, std::span<const double> ydot, double by) const {
    for (std::size_t k = 0; k < y.size(); ++k) y[k] += by * ydot[k];
    return first_->instant(t + by, y, p_first_);
  }

  static Numbers reals(std::span<const Dual> values) {
    Numbers list;
    for (const Dual& v : values) list.push_back(v.value());
    return list;
  }
  static std::vector<Dual> duals(std::span<const double> values) {
    return {values.begin(), values.end()};
  }

  std::unique_ptr<RigSystem> first_;
  std::unique_ptr<RigSystem> second_;
  std::vector<double> p_first_;
  std::vector<double> p_second_;
  bool moved_ = false;
  const EffectRow* sensor_ = nullptr;
  Numbers sensor_values_;
  std::size_t sensor_states_ = 0;
  mutable double value_ = 0.0;
  mutable double rate_ = 0.0;
};

/// Zero at the start, like its first derivative.
Signal wave(double size) {
  constexpr double w = 2.0 * std::numbers::pi;
  return {[=](double t) {
            return size * (std::sin(w * t) - 0.5 * std::sin(2.0 * w * t) +
                           0.4 * (1.0 - std::cos(3.0 * w * t)));
          },
          [=](double t) {
            return size * w *
                   (std::cos(w * t) - std::cos(2.0 * w * t) + 1.2 * std::sin(3.0 * w * t));
          }};
}

/// NaN once there was one.
double largest(double so_far, double difference) {
  return std::abs(difference) <= so_far ? so_far : std::abs(difference);
}

/// Largest difference between what drives a specimen and what comes back, over the largest of it.
double lost_there_and_back(const DriveSpec& drive, Quantity given, const Signal& signal) {
  const ThereAndBack system(drive, given, signal);
  const auto times = instants(2.0, 400);
  const std::vector<double> rest(system.states(), 0.0);
  const auto y = simulated(system, {}, times, rest, 1e-11, 1e-14);
  double worst = 0.0;
  double most = 0.0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto now = std::span(y).subspan(i * system.states(), system.states());
    worst = largest(worst, system.back(times[i], now) - signal.value(times[i]));
    most = std::max(most, std::abs(signal.value(times[i])));
  }
  return worst / most;
}

/// Nothing drives a motor on a specimen, and what distorts its torque has nothing to distort.
bool idle_on_a_specimen(const Specimen& specimen) {
  Specimen without = specimen;
  without.model.effects.clear();
  const Motion motion = loops(specimen.range, 200);
  const auto with = simulate_torque(specimen.model, motion);
  const auto bare = simulate_torque(without.model, motion);
  EXPECT_TRUE(with && bare);
  return !with || !bare || *with == *bare;
}

TEST(TheLaw, HasEveryEffectButThoseOfTheMotorsTorque) {
  std::vector<std::string_view> idle;
  for (const EffectRow& row : effects()) {
    if (acts_in_a_torsion_law(row) && idle_on_a_specimen(specimen_of(row))) idle.push_back(row.id);
  }
  EXPECT_THAT(idle, testing::UnorderedElementsAre("current_lag", "torque_constant_error",
                                                  "torque_saturation"));
}

class InTheLaw : public testing::TestWithParam<std::size_t> {
 protected:
  const EffectRow& row() const { return effects()[GetParam()]; }
};

class InTheSpecimen : public InTheLaw {};
class OnTheInstrument : public InTheLaw {};

/// Effects without a way back from the torque, and what says so.
const std::map<std::string_view, std::string_view> kOneWay = {
    {"inertia_torque", "needs the acceleration"},
    {"sensor_delay", "needs the whole signal"},
    {"torque_quantisation", "needs the whole signal"},
    {"torque_sensor_lag", "needs the whole signal"}};

/// Effects whose torque is not made as a function of time, and what says so: they are driven as
/// rigs.
const std::map<std::string_view, std::string_view> kAsRigsOnly = {
    {"gms_friction", "switches while it slips"},
    {"load_dependent_kinematic_error", "kinematics follow the torque"},
    {"lost_motion", "kinematics follow the torque"},
    {"play_backlash", "kinematics follow the torque"},
    {"series_compliance", "kinematics follow the torque"},
    {"torque_sensor_nonlinearity", "needs the rate of the transmitted torque"}};

// The memory's own update along the path against its rate, integrated.
TEST_P(InTheLaw, GivesBackTheMotionThatMadeItsTorque) {
  const Specimen specimen = specimen_of(row());
  const Motion motion = loops(specimen.range, 400);
  const auto torque = torque_signal(specimen.model, motion);
  for (const auto* exceptions : {&kOneWay, &kAsRigsOnly}) {
    const auto exception = exceptions->find(row().id);
    if (exception == exceptions->end()) continue;
    ASSERT_FALSE(torque);
    EXPECT_THAT(torque.error().message(), testing::HasSubstr(std::string(exception->second)));
    return;
  }
  ASSERT_TRUE(torque) << torque.error().message();
  const auto torsion =
      simulate_torsion(specimen.model, motion.time, *torque, 0.0, {1e-11, 1e-13, 5000000});
  ASSERT_TRUE(torsion) << torsion.error().message();
  double worst = 0.0;
  for (std::size_t i = 0; i < torsion->size(); ++i) {
    worst = std::max(worst, std::abs((*torsion)[i] - motion.position[i]));
  }
  std::printf("%s, motion to torque to motion: %.1e of the range\n", row().id.data(),
              worst / specimen.range);
  EXPECT_LT(worst, kLost * specimen.range);
}

// Both ways round, as differential equations, for what is not on the instrument.
TEST_P(InTheSpecimen, UndoesItselfAsRigs) {
  const Specimen specimen = specimen_of(row());
  DriveSpec drive;
  drive.torsion = specimen.model;
  drive.gear_ratio = 1.0;
  const double motion = lost_there_and_back(drive, Quantity::torsion, wave(0.5 * specimen.range));
  const double torque =
      lost_there_and_back(drive, Quantity::transmitted_torque, wave(0.5 * specimen.torque));
  std::printf("%s: motion %.1e, torque %.1e of the largest\n", row().id.data(), motion, torque);
  EXPECT_LT(motion, kLost);
  EXPECT_LT(torque, kLost);
}

TEST(BoucWen, UndoesItselfAtEveryExponent) {
  for (const double exponent : {0.5, 2.0, 3.3}) {
    DriveSpec drive;
    drive.gear_ratio = 1.0;
    drive.torsion = example_drive().torsion;
    drive.torsion.effects = {
        {"bouc_wen", {{"height", 4.5}, {"slip_length", 3e-4}, {"exponent", exponent}}}};
    const Motion motion = loops(2e-3, 400);
    const auto torque = torque_signal(drive.torsion, motion);
    ASSERT_TRUE(torque) << torque.error().message();
    const auto torsion =
        simulate_torsion(drive.torsion, motion.time, *torque, 0.0, {1e-11, 1e-13, 5000000});
    ASSERT_TRUE(torsion) << torsion.error().message();
    for (std::size_t i = 0; i < torsion->size(); ++i) {
      EXPECT_NEAR((*torsion)[i], motion.position[i], kLost * 2e-3) << "exponent " << exponent;
    }
    EXPECT_LT(lost_there_and_back(drive, Quantity::transmitted_torque, wave(15.0)), kLost);
  }
}

// What the instrument adds goes the other way round through its samples.
TEST_P(OnTheInstrument, GivesBackTheMotionThatItShowed) {
  const Specimen specimen = specimen_of(row());
  DriveSpec drive;
  drive.torsion = specimen.model;
  drive.gear_ratio = 1.0;
  const double motion = lost_there_and_back(drive, Quantity::torsion, wave(0.5 * specimen.range));
  std::printf("%s: motion %.1e of the largest\n", row().id.data(), motion);
  EXPECT_LT(motion, kLost);
}

TEST_P(OnTheInstrument, GivesBackTheTorqueThatItShowed) {
  const Specimen specimen = specimen_of(row());
  DriveSpec drive;
  drive.torsion = specimen.model;
  // It turns at samples, which is where a sensor's memory has to see it turn.
  const Signal shown = sine(0.5 * specimen.torque, 1.0);
  const auto rig = made_rig(Rig::specimen, drive, {{{Quantity::transmitted_torque, shown}}, {}});
  const auto times = instants(2.0, 4000);
  const auto p = rig->parameter_vector();
  const auto y = simulated(*rig, p, times, rig->rest(), 1e-11, 1e-15);
  Motion motion;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto state = std::span(y).subspan(i * rig->states(), rig->states());
    motion.time.push_back(times[i]);
    motion.position.push_back(state[0]);
    motion.velocity.push_back(rig->instant(times[i], state, p).motor_speed);
    motion.acceleration.push_back(0.0);
  }
  const auto torque = simulate_torque(specimen.model, motion);
  ASSERT_TRUE(torque) << torque.error().message();
  double worst = 0.0;
  double most = 0.0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    worst = std::max(worst, std::abs((*torque)[i] - shown.value(times[i])));
    most = std::max(most, std::abs(shown.value(times[i])));
  }
  std::printf("%s, torque to motion to torque: %.1e of its peak\n", row().id.data(), worst / most);
  EXPECT_LT(worst, kLost * most);
}

TEST(ThereAndBackAgain, LosesNoMoreThanThePageSays) {
  claims::expect("docs/simulation.md", "inverse", {{"lost", kLost}});
}

template <class Wanted>
std::vector<std::size_t> effects_that(const Wanted& wanted) {
  std::vector<std::size_t> list;
  for (std::size_t k = 0; k < effects().size(); ++k) {
    if (acts_in_a_torsion_law(effects()[k]) && wanted(effects()[k])) list.push_back(k);
  }
  return list;
}

const auto kName = [](const auto& param) { return std::string(effects()[param.param].id); };

INSTANTIATE_TEST_SUITE_P(Catalogue, InTheLaw,
                         testing::ValuesIn(effects_that([](const EffectRow&) { return true; })),
                         kName);
INSTANTIATE_TEST_SUITE_P(Catalogue, InTheSpecimen,
                         testing::ValuesIn(effects_that([](const EffectRow& row) {
                           return row.site != Site::torque_signal;
                         })),
                         kName);
INSTANTIATE_TEST_SUITE_P(Catalogue, OnTheInstrument,
                         testing::ValuesIn(effects_that([](const EffectRow& row) {
                           return row.site == Site::torque_signal && !kOneWay.contains(row.id);
                         })),
                         kName);

}  // namespace
}  // namespace flexspline
