#pragma once

#include <compare>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "flexspline/core/error.hpp"
#include "flexspline/core/recording.hpp"

namespace flexspline::data {

/// A drive whose laws no estimator shares: f and g^-1 odd, rising, smooth and not polynomial,
/// h even and positive. SI; what a rig does not have is 0 (a specimen has no motor and ratio 1).
struct HiddenGear {
  std::string families;                      ///< which f, g^-1 and h were drawn, for the answer
  std::function<double(double)> stiffness;   ///< f(phi), Nm
  std::function<double(double)> damping;     ///< g^-1(phi'/h), Nm
  std::function<double(double)> modulation;  ///< h(phi)
  double rated_torsion = 0.0;                ///< rad, the windup under rated_torque
  double rated_torque = 0.0;                 ///< Nm, what the design's largest motion asks for
  double gear_ratio = 50.0;
  double motor_inertia = 0.0;        ///< kg m2
  double motor_drag = 0.0;           ///< Nm s/rad
  double motor_coulomb = 0.0;        ///< Nm
  double motor_coulomb_speed = 1.0;  ///< rad/s: friction is coulomb w / sqrt(w^2 + this^2)
  double load_inertia = 0.0;         ///< kg m2
  double load_drag = 0.0;            ///< Nm s/rad
  double load_mass = 0.0;            ///< kg, of the servo's pendulum
  double arm_length = 0.0;           ///< m
};

enum class HiddenMotion { sine, multisine, ramp, step_hold, staircase };

/// One recording to make. The motion is that of the shaft that the rig's position loop holds: the
/// torsion on locked and specimen, the load on free and servo. It starts at rest and unloaded.
/// staircase: out and back on both sides at constant speeds 1 : 2 : 4; ramp: the same at one speed.
struct HiddenExcitation {
  HiddenMotion motion = HiddenMotion::sine;
  double amplitude = 0.0;     ///< rad at the output; the largest travel
  double frequency_hz = 0.0;  ///< of a sine, the lowest of a multisine, else cycles / duration
  double cycles = 3.0;        ///< duration times frequency
  int samples = 700;
};

/// Which bench: a rig; or a specimen whose angle travels, a joint moved alone between position
/// loop and torque sensor.
struct BenchKind {
  Rig rig = Rig::locked;
  bool travels = false;

  BenchKind() = default;
  BenchKind(Rig of, bool is_joint = false) : rig(of), travels(is_joint) {}  // NOLINT: a rig is one
  friend auto operator<=>(const BenchKind&, const BenchKind&) = default;
};

/// The rig's name; "joint" where the angle travels.
std::string_view name_of(BenchKind kind);
std::optional<BenchKind> find_bench_kind(std::string_view name);
std::span<const BenchKind> bench_kinds();

/// What the instruments add. Shares of noise are of the peak torque of the same sensor.
struct HiddenNuisances {
  double torque_noise = 0.0;         ///< rms share, white and coloured together
  double coloured_share = 0.0;       ///< of the noise's variance; a first-order process
  double coloured_samples = 20.0;    ///< its correlation, in samples
  double motor_encoder_step = 0.0;   ///< rad at the motor (torsion on a specimen); 0: not quantised
  double load_encoder_step = 0.0;    ///< rad at the load
  double time_jitter = 0.0;          ///< rms share of the interval; stamps tell the true instants
  double angle_zero = 0.0;           ///< rad at the output: the torsion's zero is off by this
  double torque_offset = 0.0;        ///< of the transmitted torque's sensor, over its noise's rms
  double motor_torque_offset = 0.0;  ///< of the motor torque's channel, over its noise's rms
  double zero_spread = 0.0;         ///< rad at the output: each recording's zero, beside angle_zero
  double temperature_spread = 0.0;  ///< K: each recording's gear is warmer or colder by up to this
  double load_zero = 0.0;           ///< rad: the load encoder's zero is off by this
  double filter_samples = 0.0;  ///< time constant over the interval: one low pass on every channel
  int tail_degrees = 0;         ///< noise of Student's t with so many degrees of freedom; 0: normal
};

/// A whole bench, drawn or put together by hand.
struct HiddenBench {
  Rig rig = Rig::locked;
  std::uint64_t seed = 0;
  HiddenGear gear;
  std::vector<HiddenExcitation> design;
  HiddenNuisances nuisances;
  bool travels = false;  ///< a specimen that is a joint: f is of the angle, neither odd nor rising

  BenchKind kind() const { return {rig, travels}; }
};

/// The equation whose residual an effect's size is measured in: the drive is that of a servo, motor
/// torque over load motion.
enum class HiddenEquation { torsion, load, motor, drive };

/// What to conceal: size_fraction is the largest residual it leaves in its equation, on signals
/// without noise and with the true laws, over the peak torque of that equation's sensor
/// (transmitted torque; motor torque for motor and drive) on the bench without it.
struct HiddenEffect {
  std::string id;
  double size_fraction = 0.0;
};

struct HiddenParameter {
  std::string name;
  double value = 0.0;
  std::string unit;
};

/// An interval of one recording, s on that recording's clock.
struct HiddenPlace {
  std::string recording;
  double from_s = 0.0;
  double to_s = 0.0;
  double duration_s = 0.0;  ///< of the recording
};

/// What was concealed, as it came out.
struct HiddenFinding {
  std::string id;
  std::string coordinate;  ///< empty: outside the catalogue of diagnoses
  HiddenEquation equation = HiddenEquation::torsion;
  double size_fraction = 0.0;  ///< measured, alone on the bench
  std::vector<HiddenParameter> parameters;
  std::vector<std::string> names{};    ///< right names beside the id
  std::optional<HiddenPlace> place{};  ///< where it is confined to
};

struct HiddenAnswer {
  std::vector<HiddenFinding> effects;  ///< by id; empty: nothing is hidden
  double noise_std = 0.0;              ///< Nm, of the transmitted torque
  double motor_noise_std = 0.0;        ///< Nm, of the motor torque
  double peak_torque = 0.0;            ///< Nm, transmitted, on the bench without the effects
  double peak_motor_torque = 0.0;      ///< Nm
};

/// ideal: the same channels at the same instants without noise, quantisation or zero error.
struct HiddenDataset {
  RecordingSet measured;
  RecordingSet ideal;
  HiddenAnswer answer;
};

struct HiddenLaw;    // what an effect adds, bench/hidden_law.hpp
struct HiddenScale;  // how large things are on a bench, bench/hidden_law.hpp

/// Where an effect enters.
enum class HiddenSite { transmission, load, motor, torque_sensor, motor_sensor, encoder };

/// What the right answer to a hidden effect is, told by the id: its name; for "variant:..." one of
/// the row's names, in another form than the catalogue's; for "unknown:..." that something is left
/// without a name, in the row's coordinate; for "incident:..." the same, and its recording and
/// interval.
enum class HiddenClass { named, variant, unknown, incident };

HiddenClass hidden_class(std::string_view id);

/// A row of the catalogue of concealable effects. Ids and coordinates are those of diagnoses.
struct HiddenRow {
  std::string_view id;
  std::string_view coordinate;
  std::string_view equation;  ///< as it is added here; other forms than the estimators fit
  HiddenSite site = HiddenSite::transmission;
  std::vector<Rig> rigs;
  bool dissipates = false;  ///< what it adds takes energy from every closed cycle
  std::function<HiddenLaw(const HiddenScale& scale, double amount)> make{};
  bool joint = false;                     ///< a joint that travels shows it too
  std::vector<std::string_view> names{};  ///< of a variant: the right ones

  bool shows_on(BenchKind kind) const;
};

/// Every effect that can be concealed: those with a file of their own, in other forms than the
/// catalogue's, and every other effect of the catalogue that is sought by its law, as it stands.
std::span<const HiddenRow> hidden_effects();

/// One file each in data/bench/hidden.
std::span<const HiddenRow> written_hidden_effects();

/// A way in which sound benches differ, of which nothing is left out: the right answer is as if it
/// were not there. One file each in data/bench/disturbances; apply draws its own amount from the
/// seed and tells it.
struct DisturbanceRow {
  std::string_view id;
  std::string_view says;
  std::vector<BenchKind> kinds;
  std::vector<HiddenParameter> (*apply)(HiddenBench& bench, std::uint64_t seed) = nullptr;
};

std::span<const DisturbanceRow> disturbances();

/// Errors: usage, with every id there is.
Result<const DisturbanceRow*> find_disturbance(std::string_view id);

/// Errors: usage, with every id there is.
Result<const HiddenRow*> find_hidden_effect(std::string_view id);

HiddenEquation hidden_equation(HiddenSite site, Rig rig);
std::string_view name_of(HiddenEquation equation);
std::string_view name_of(HiddenMotion motion);

/// A bench drawn from a seed: families and parameters of the gear (+-20 % and more), a design of
/// eight to eleven recordings in two decades of rate, noise of 0.3 to 0.6 %, encoders, jitter; the
/// torques' offsets and what the angle's zero is worth in torque within +-0.1 of the noise's rms.
/// From recording to recording the zero moves by half of that and the gear's temperature by up to
/// 0.3 to 0.9 K: grease by 3.5 % a K, dry friction and the losses of the torsion by 1 % a K. On
/// free the load asks for 1.05 times the rated torque at most.
/// A joint has a travel of 0.5 to 0.9 rad, 0.1 to 0.6 rad/s, gravity and cables over the angle.
HiddenBench draw_hidden_bench(BenchKind kind, std::uint64_t seed);

/// Runs the bench with the effects and without any, deterministic by the bench's seed: neither the
/// order of the effects nor that of the recordings matters, and size 0 is absence.
/// How: the held shaft's motion is prescribed and the torques follow by inverse dynamics on a grid
/// of eight steps a sample. On free and servo the torsion is what the load's torque asks for, by
/// BDF2 with a bracketed Newton iteration; so it is with compliance in series. Each effect's amount
/// is found by repeating the run with it alone until its size is met to 2 %.
/// Not modelled: the position loop's error, torque saturation, resonances of load and gear.
/// Errors: usage for an unknown effect, one that the rig does not have, a size that it cannot reach
/// and a setting out of range; numerics where a torque is not finite.
Result<HiddenDataset> run_hidden_bench(const HiddenBench& bench, std::vector<HiddenEffect> effects);

}  // namespace flexspline::data
