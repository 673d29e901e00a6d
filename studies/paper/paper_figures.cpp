#include "paper/paper_figures.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <nlohmann/json.hpp>

#include "comparison/decimate.hpp"
#include "flexspline/core/law.hpp"
#include "paper/odd_polynomial.hpp"

namespace flexspline::studies {
namespace {

using nlohmann::ordered_json;
using Series = std::vector<double>;

constexpr double kDegreesPerRad = 180.0 / std::numbers::pi;

Series in_degrees(const Series& radians) {
  Series degrees(radians);
  for (double& value : degrees) value *= kDegreesPerRad;
  return degrees;
}

/// "paper": what the printed numbers give. "ours": the experiment repeated on the virtual bench.
ordered_json series(const char* side, const char* name, Series x, Series y, const char* style) {
  return {
      {"name", name}, {"x", std::move(x)}, {"y", std::move(y)}, {"style", style}, {"side", side}};
}

/// What a figure shows and, after the bar, what is wrong in it.
struct Remark {
  const char* says;
  const char* wrong;
};

ordered_json figure(const char* id, const char* title, const char* x, const char* y,
                    const Remark& remark, ordered_json drawn) {
  return {{"id", id},
          {"title", title},
          {"x_label", x},
          {"y_label", y},
          {"says", remark.says},
          {"wrong", remark.wrong},
          {"series", std::move(drawn)}};
}

/// What the figures are drawn from, in degrees and newton metres.
struct Drawn {
  Series time, motor_angle, torsion, torque, differentiated, pure_sine;
  Series locus_torsion, locus_mean, locus_speed, locus_half_difference;
  Series f, g, torque_fitted;
  std::size_t cycle = 0;  ///< first sample of the last cycle
};

Series differentiated(const Series& time, const Series& y) {
  Series rate(y.size(), 0.0);
  for (std::size_t i = 1; i + 1 < y.size(); ++i) {
    rate[i] = (y[i + 1] - y[i - 1]) / (time[i + 1] - time[i - 1]);
  }
  if (rate.size() > 2) {
    rate.front() = rate[1];
    rate.back() = rate[rate.size() - 2];
  }
  return rate;
}

Drawn prepare(const PaperExperiment& experiment, const Law& f, const Law& g) {
  Drawn drawn;
  drawn.time = experiment.record.time;
  drawn.motor_angle = in_degrees(*experiment.recording.find(Quantity::motor_angle));
  drawn.torsion = in_degrees(experiment.record.motion);
  drawn.torque = experiment.record.effort;
  drawn.differentiated = differentiated(drawn.time, drawn.torsion);
  const estimators::MidpointLocus& locus = experiment.locus;
  const double omega = locus.angular_frequency;
  for (std::size_t i = 0; i < drawn.time.size(); ++i) {
    const double speed = -locus.amplitude * omega * std::sin(omega * drawn.time[i] + locus.phase);
    drawn.pure_sine.push_back(speed * kDegreesPerRad);
    drawn.torque_fitted.push_back(f.value(experiment.record.motion[i]) + g.value(speed));
  }
  drawn.locus_torsion = in_degrees(locus.motion);
  drawn.locus_mean = locus.midpoint;
  drawn.locus_speed = in_degrees(locus.rising_rate);
  drawn.locus_half_difference = locus.distance;
  for (const double x : locus.motion) drawn.f.push_back(f.value(x));
  for (const double v : locus.rising_rate) drawn.g.push_back(g.value(v));
  // One sample more than a period, so that the loop closes.
  const double step = drawn.time[1] - drawn.time[0];
  const double start = drawn.time.back() - 2.0 * std::numbers::pi / omega - 0.5 * step;
  drawn.cycle =
      static_cast<std::size_t>(std::ranges::lower_bound(drawn.time, start) - drawn.time.begin());
  return drawn;
}

/// Table I along the sine that the paper asked for, over some cycles.
struct Printed {
  Series time, motor_angle, torsion, speed, torque;

  explicit Printed(int cycles) {
    constexpr int kSamples = 400;
    for (int i = 0; i <= kSamples; ++i) {
      const double angle = 2.0 * std::numbers::pi * cycles * i / kSamples;
      time.push_back(angle / kOmega);
      torsion.push_back(kAmplitudeDeg * std::sin(angle));
      motor_angle.push_back(kGearRatio * torsion.back());
      speed.push_back(kSpeedDeg * std::cos(angle));
      torque.push_back(kStiffness.value(torsion.back()) + kDamping.value(speed.back()));
    }
  }
};

/// A function of Table I over its range.
ordered_json printed_function(const OddPolynomial& function, double from, double to) {
  constexpr int kSamples = 200;
  Series x, y;
  for (int i = 0; i <= kSamples; ++i) {
    x.push_back(from + (to - from) * i / kSamples);
    y.push_back(function.value(x.back()));
  }
  return series("paper", "Table I", std::move(x), std::move(y), "line");
}

void add_time_figures(const Drawn& d, ordered_json& figures) {
  const auto all = kept_indices(0, d.time.size());
  const auto cycle = kept_indices(d.cycle, d.time.size());
  const auto of = [](const Series& y, const std::vector<std::size_t>& kept) {
    return at_indices(y, kept);
  };
  const Printed five(5), one(1);
  const auto ours = [&](const char* name, const Series& y, const std::vector<std::size_t>& kept) {
    return series("ours", name, of(d.time, kept), of(y, kept), "line");
  };
  figures.push_back(figure(
      "figure_4", "Measured angular displacement", "t / s", "theta_1 / deg",
      {"Motor angle, 10 deg at 0.005 Hz; ours runs up from rest.",
       "Everything that follows rests on one amplitude and one frequency, which does not separate a "
       "viscous loss from a rate-independent one."},
      {series("paper", "pure sine", five.time, five.motor_angle, "line"),
       ours("measured", d.motor_angle, all)}));
  figures.push_back(figure(
      "figure_5", "Measured transmitted torque", "t / s", "tau / Nm",
      {"Torque along that motion.",
       "That it is no pure sine is read as a nonlinear spring alone; hysteresis bends it too."},
      {series("paper", "Table I", five.time, five.torque, "line"),
       ours("measured", d.torque, all)}));
  figures.push_back(figure(
      "figure_6", "Measured steady state hysteresis curve", "phi / deg", "tau / Nm",
      {"The last cycle.",
       "One loop. Section 6 says that the loop changes with its amplitude and that the torque "
       "depends on every displacement before; eq. (4) with Table I has no such memory."},
      {series("paper", "Table I", one.torsion, one.torque, "line"),
       series("ours", "measured", of(d.torsion, cycle), of(d.torque, cycle), "line")}));
  figures.push_back(figure(
      "figure_7", "Measured and estimated angular velocity", "t / s", "phi' / (deg/s)",
      {"Differentiation drowns the speed in encoder noise; the paper takes the derivative of a "
       "pure sine instead.",
       "The pure sine is right only as far as the motion is one: harmonics of the motion go into "
       "g^-1 unseen (the input 'harmonics' of this study)."},
      {series("paper", "pure sine", one.time, one.speed, "line"),
       ours("differentiated", d.differentiated, cycle),
       ours("its pure sine", d.pure_sine, cycle)}));
}

void add_function_figures(const Drawn& d, ordered_json& figures) {
  const auto f_points = series("ours", "midpoint locus", d.locus_torsion, d.locus_mean, "points");
  const auto g_points =
      series("ours", "midpoint locus", d.locus_speed, d.locus_half_difference, "points");
  const auto f_table = printed_function(kStiffness, -kAmplitudeDeg, kAmplitudeDeg);
  const auto g_table = printed_function(kDamping, 0.0, kSpeedDeg);
  figures.push_back(figure(
      "figure_8", "Measured stiffness function", "phi / deg", "f / Nm",
      {"Mean of the two torques at each torsion, eq. (18).",
       "\"Same ordinate\" and \"horizontal distance\" in the text do not match torque plotted "
       "over torsion."},
      {f_table, f_points}));
  figures.push_back(figure(
      "figure_9", "Measured viscous damping function", "phi' / (deg/s)", "g^-1 / Nm",
      {"Half their difference, eq. (17), over the speed.",
       "The text calls this locus g; it is g^-1. Its shape is 4.50 (v/v0)^1.79 Nm to 1.1 %, near "
       "v|v|: along a sine, the half height of a rate-independent loop."},
      {g_table, g_points}));
  figures.push_back(figure(
      "figure_10", "Measured and estimated stiffness function", "phi / deg", "f / Nm",
      {"The same fit to our recording recovers Table I.",
       "Called strictly rising; it is so to 118 % of this range, and negative above 136 %. The "
       "\"nonlinear\" least squares is linear, with condition number 1e8 in raw units."},
      {f_table, f_points, series("ours", "estimated", d.locus_torsion, d.f, "line")}));
  figures.push_back(figure(
      "figure_11", "Measured and estimated viscous damping function", "phi' / (deg/s)", "g^-1 / Nm",
      {"The same fit to our recording recovers Table I.",
       "It turns round at 113.5 % of this speed and is -1540 Nm at twice it, from a gear rated "
       "226 Nm: the model makes energy. Condition number 1e20 in raw units."},
      {g_table, g_points, series("ours", "estimated", d.locus_speed, d.g, "line")}));
  const auto cycle = kept_indices(d.cycle, d.time.size());
  const Series torsion = at_indices(d.torsion, cycle);
  const Printed one(1);
  figures.push_back(figure(
      "figure_12", "Measured and estimated hysteresis loop", "phi / deg", "tau / Nm",
      {"Eq. (26) at the torsion measured and the speed of a pure sine.",
       "The loop it is held against is the loop it was fitted to, and the differential equation "
       "is never integrated."},
      {series("paper", "Table I", one.torsion, one.torque, "line"),
       series("ours", "measured", torsion, at_indices(d.torque, cycle), "line"),
       series("ours", "estimated", torsion, at_indices(d.torque_fitted, cycle), "line")}));
}

}  // namespace

ordered_json paper_figures(const PaperExperiment& experiment) {
  const auto f = make_law(experiment.estimate.model.f);
  const auto g = make_law(experiment.estimate.model.g_inverse);
  if (!f || !g) return ordered_json::array();
  const Drawn drawn = prepare(experiment, **f, **g);
  ordered_json figures = ordered_json::array();
  add_time_figures(drawn, figures);
  add_function_figures(drawn, figures);
  return figures;
}

}  // namespace flexspline::studies
