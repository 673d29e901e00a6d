#pragma once

#include <string>
#include <vector>

#include <fmt/format.h>

#include "drawn_gears.hpp"
#include "flexspline/core/in_parallel.hpp"
#include "flexspline/core/torsion_record.hpp"
#include "flexspline/data/bench.hpp"

namespace flexspline::estimators {

/// What the instruments of the virtual bench add.
struct NoiseColour {
  std::string_view name;
  data::BenchSensors sensors;
  double torque_step = 0.0;  ///< of the torque's channel, share of kPeak
};

inline const std::array<NoiseColour, 4> kNoiseColours = {{
    {"white", {.encoder_step = 6.3e-5, .angle_noise = 0.005, .torque_noise_white = 0.005}},
    {"short",
     {.encoder_step = 6.3e-5,
      .angle_noise = 0.005,
      .torque_noise_white = 0.003,
      .torque_noise_coloured = 0.004,
      .torque_noise_samples = 3}},
    {"long",
     {.encoder_step = 6.3e-5,
      .angle_noise = 0.005,
      .torque_noise_white = 0.004,
      .torque_noise_coloured = 0.003,
      .torque_noise_samples = 25}},
    {"quantised",
     {.encoder_step = 6.3e-4, .angle_noise = 0.002, .torque_noise_white = 0.003},
     0.005},
}};

/// A torsion, or an angle that travels: no cycle of it counts as a repeat, h is 1, and f holds the
/// torque's offset.
enum class CoverageMotion { torsion, travels };

/// A set of recordings of a drawn gear, with its laws as the recordings show them. The angle's zero
/// and the torque's are off by up to 3 and 2 %, which moves along the gauges of the torsion law:
/// f(0) = 0 and h(0) = 1 where the recorded angle is zero.
struct CoverageSet {
  std::vector<TorsionRecord> records;
  Shape f, g_inverse, h;  ///< of rad, of rad/s, of rad: Nm, Nm, 1
};

/// What became of one function of one set.
struct BandScore {
  int held = 0;
  int asked = 0;            ///< 0: no band was printed
  double half_width = 0.0;  ///< root mean square over the valid range, of kPeak; of h itself
  double error = 0.0;       ///< of the middle of the band, likewise
};

struct SetScore {
  BandScore f, g_inverse, h;
  bool failed = false;
  bool identifiable = false;
  std::string says;
  double seconds = 0.0;

  /// The verdict promises what the band does not keep: root mean squares over the valid range.
  bool overconfident() const { return identifiable && h.asked > 0 && h.error > h.half_width; }
};

/// Scores of one family in one colour of noise, together.
struct CoverageTally {
  int sets = 0, failed = 0, printed = 0, identifiable = 0, overconfident = 0;
  BandScore f, g_inverse, h;  ///< held and asked alone
  std::vector<double> f_width, g_width, h_width, h_error, seconds;

  void add(const SetScore& one);
  void add(const CoverageTally& other);
};

// The loops of the study: two amplitudes at one frequency, and two frequencies.
inline constexpr std::array<std::array<double, 2>, 4> kLoops = {
    {{1.0, 1.0}, {0.5, 1.0}, {1.0, 0.5}, {0.6, 1.7}}};
inline constexpr double kLargestZero = 0.03;
inline constexpr double kLargestOffset = 0.02;
inline constexpr double kGearRatio = 50.0;

inline data::BenchTruth bench_truth(const DrawnGear& gear) {
  data::BenchTruth truth;
  truth.stiffness = [f = gear.f](double phi) { return kPeak * f(phi / kAmplitude); };
  truth.damping = [g = gear.g_inverse](double w) { return kPeak * g(w / kSpeed); };
  truth.log_modulation = [h = gear.log_h](double phi) { return h(phi / kAmplitude); };
  return truth;
}

inline void spoil(Recording& recording, double zero, double offset, double step) {
  for (double& angle : recording.channels[Quantity::motor_angle]) angle += zero * kGearRatio;
  for (double& torque : recording.channels[Quantity::transmitted_torque]) {
    torque += offset;
    if (step > 0.0) torque = std::round(torque / step) * step;
  }
}

inline BandScore score_of(const FunctionBand& band, const Shape& truth, double unit) {
  BandScore score;
  double error = 0.0;
  double width = 0.0;
  for (std::size_t k = 0; k < band.argument.size(); ++k) {
    const double x = band.argument[k];
    if (x < band.valid_from || x > band.valid_to) continue;
    const double y = truth(x);
    score.held += band.lower[k] <= y && y <= band.upper[k] ? 1 : 0;
    ++score.asked;
    error += std::pow(0.5 * (band.lower[k] + band.upper[k]) - y, 2);
    width += std::pow(0.5 * (band.upper[k] - band.lower[k]), 2);
  }
  score.half_width = std::sqrt(width / score.asked) / unit;
  score.error = std::sqrt(error / score.asked) / unit;
  return score;
}

inline CoverageSet coverage_set(const GearFamily& family, const NoiseColour& noise,
                                unsigned replicate,
                                CoverageMotion motion = CoverageMotion::torsion) {
  std::vector<unsigned> words(family.name.begin(), family.name.end());
  words.insert(words.end(), noise.name.begin(), noise.name.end());
  words.push_back(replicate);
  std::seed_seq seeds(words.begin(), words.end());
  Draw draw(seeds);
  DrawnGear gear = drawn_gear(family, draw);
  if (motion == CoverageMotion::travels) gear.log_h = [](double) { return 0.0; };
  const auto truth = bench_truth(gear);
  const bool off = replicate % 2 == 1;
  const double zero = off ? kAmplitude * uniform(draw, -kLargestZero, kLargestZero) : 0.0;
  const double offset = off ? kPeak * uniform(draw, -kLargestOffset, kLargestOffset) : 0.0;
  std::vector<Recording> recordings;
  for (const auto& [amplitude, frequency] : kLoops) {
    auto made =
        data::make_recording(truth,
                             {.amplitude = amplitude * kAmplitude,
                              .frequency_hz = frequency * kFrequency,
                              .cycles = 5,
                              .samples_per_cycle = 300},
                             noise.sensors, draw(), fmt::format("loop-{}", recordings.size()));
    expects(made.has_value(), "the virtual bench makes the recording");
    spoil(made->measured, zero, offset, noise.torque_step * kPeak);
    recordings.push_back(std::move(made->measured));
  }
  CoverageSet set;
  set.records = *torsion_records(data::paper_bench("coverage", std::move(recordings)));
  if (motion == CoverageMotion::travels) {
    for (TorsionRecord& one : set.records) one.travels = true;
    set.f = [=](double phi) { return truth.stiffness(phi - zero) + offset; };
    set.g_inverse = truth.damping;
    return set;
  }
  const double at_zero = std::exp(truth.log_modulation(-zero));
  set.f = [=](double phi) { return truth.stiffness(phi - zero) - truth.stiffness(-zero); };
  set.g_inverse = [=](double w) { return truth.damping(w / at_zero); };
  set.h = [=](double phi) { return std::exp(truth.log_modulation(phi - zero)) / at_zero; };
  return set;
}

inline SetScore score(const CoverageSet& set, const Options& options = {}) {
  SetScore result;
  const auto estimate = fitted("trajectory_ceres", set.records, options);
  result.failed = !estimate;
  if (!estimate) {
    result.says = estimate.error().message();
    return result;
  }
  result.identifiable = estimate->identifiability.verdict == "identifiable";
  result.says = estimate->identifiability.says;
  result.seconds = estimate->seconds;
  for (const auto& band : estimate->bands) {
    if (band.function == "f") result.f = score_of(band, set.f, kPeak);
    if (band.function == "g_inverse") result.g_inverse = score_of(band, set.g_inverse, kPeak);
    if (band.function == "h") result.h = score_of(band, set.h, 1.0);
  }
  return result;
}

inline void CoverageTally::add(const SetScore& one) {
  ++sets;
  failed += one.failed ? 1 : 0;
  printed += one.h.asked > 0 ? 1 : 0;
  identifiable += one.identifiable ? 1 : 0;
  overconfident += one.overconfident() ? 1 : 0;
  const auto count = [](BandScore& all, const BandScore& added, std::vector<double>& widths) {
    all.held += added.held;
    all.asked += added.asked;
    if (added.asked > 0) widths.push_back(added.half_width);
  };
  count(f, one.f, f_width);
  count(g_inverse, one.g_inverse, g_width);
  count(h, one.h, h_width);
  if (one.h.asked > 0) h_error.push_back(one.h.error);
  seconds.push_back(one.seconds);
}

inline void CoverageTally::add(const CoverageTally& other) {
  sets += other.sets;
  failed += other.failed;
  printed += other.printed;
  identifiable += other.identifiable;
  overconfident += other.overconfident;
  const auto join = [](BandScore& all, const BandScore& added) {
    all.held += added.held;
    all.asked += added.asked;
  };
  join(f, other.f);
  join(g_inverse, other.g_inverse);
  join(h, other.h);
  using Member = std::vector<double> CoverageTally::*;
  for (Member member : {&CoverageTally::f_width, &CoverageTally::g_width, &CoverageTally::h_width,
                        &CoverageTally::h_error, &CoverageTally::seconds}) {
    (this->*member).insert((this->*member).end(), (other.*member).begin(), (other.*member).end());
  }
}

inline double share(const BandScore& score) {
  return score.asked > 0 ? static_cast<double>(score.held) / score.asked : kNotComputed;
}

inline double median(std::vector<double> values) {
  if (values.empty()) return kNotComputed;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Every set of these families and colours, `replicates` of each from `first` on; a row a family, a
/// column a colour.
inline std::vector<std::vector<CoverageTally>> band_coverage(
    std::span<const GearFamily> families, unsigned replicates, unsigned first, unsigned threads,
    const Options& options = {}, CoverageMotion motion = CoverageMotion::torsion) {
  const std::size_t colours = kNoiseColours.size();
  std::vector<SetScore> scores(families.size() * colours * replicates);
  in_parallel(scores.size(), threads, [&](std::size_t k) {
    const std::size_t cell = k / replicates;
    const auto replicate = first + static_cast<unsigned>(k % replicates);
    scores[k] = score(
        coverage_set(families[cell / colours], kNoiseColours[cell % colours], replicate, motion),
        options);
  });
  std::vector<std::vector<CoverageTally>> tallies(families.size(),
                                                  std::vector<CoverageTally>(colours));
  for (std::size_t k = 0; k < scores.size(); ++k) {
    const std::size_t cell = k / replicates;
    tallies[cell / colours][cell % colours].add(scores[k]);
  }
  return tallies;
}

}  // namespace flexspline::estimators
