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

ordered_json series(const char* name, Series x, Series y, const char* style) {
  return {{"name", name}, {"x", std::move(x)}, {"y", std::move(y)}, {"style", style}};
}

ordered_json figure(const char* id, const char* title, const char* x, const char* y,
                    const char* says, ordered_json drawn) {
  return {{"id", id},     {"title", title}, {"x_label", x},
          {"y_label", y}, {"says", says},   {"series", std::move(drawn)}};
}

/// What the figures are drawn from, in degrees and newton metres.
struct Drawn {
  Series time, motor_angle, torsion, torque, differentiated, pure_sine;
  Series locus_torsion, locus_mean, locus_speed, locus_half_difference;
  Series f, f_table, g, g_table, torque_fitted;
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
  drawn.locus_speed = in_degrees(locus.rate);
  drawn.locus_half_difference = locus.distance;
  for (const double x : locus.motion) {
    drawn.f.push_back(f.value(x));
    drawn.f_table.push_back(kStiffness.value(x * kDegreesPerRad));
  }
  for (const double v : locus.rate) {
    drawn.g.push_back(g.value(v));
    drawn.g_table.push_back(kDamping.value(v * kDegreesPerRad));
  }
  // One sample more than a period, so that the loop closes.
  const double step = drawn.time[1] - drawn.time[0];
  const double start = drawn.time.back() - 2.0 * std::numbers::pi / omega - 0.5 * step;
  drawn.cycle =
      static_cast<std::size_t>(std::ranges::lower_bound(drawn.time, start) - drawn.time.begin());
  return drawn;
}

ordered_json time_figures(const Drawn& d) {
  const auto all = kept_indices(0, d.time.size());
  const auto cycle = kept_indices(d.cycle, d.time.size());
  const auto of = [](const Series& y, const std::vector<std::size_t>& kept) {
    return at_indices(y, kept);
  };
  ordered_json figures = ordered_json::array();
  figures.push_back(figure("figure_4", "Measured angular displacement", "t / s", "theta_1 / deg",
                           "Motor angle of the virtual bench: 10 deg, 0.005 Hz, from rest.",
                           {series("measured", of(d.time, all), of(d.motor_angle, all), "line")}));
  figures.push_back(figure("figure_5", "Measured transmitted torque", "t / s", "tau / Nm",
                           "Not a pure sine: the stiffness is nonlinear.",
                           {series("measured", of(d.time, all), of(d.torque, all), "line")}));
  figures.push_back(figure(
      "figure_6", "Measured steady state hysteresis curve", "phi / deg", "tau / Nm",
      "The last cycle.", {series("measured", of(d.torsion, cycle), of(d.torque, cycle), "line")}));
  figures.push_back(figure(
      "figure_7", "Measured and estimated angular velocity", "t / s", "phi' / (deg/s)",
      "Differentiation drowns the speed in encoder noise; the paper takes the derivative of a pure "
      "sine instead, which is right only as far as the motion is one.",
      {series("differentiated", of(d.time, cycle), of(d.differentiated, cycle), "line"),
       series("pure sine", of(d.time, cycle), of(d.pure_sine, cycle), "line")}));
  return figures;
}

void add_function_figures(const Drawn& d, ordered_json& figures) {
  const auto f_points = series("midpoint locus", d.locus_torsion, d.locus_mean, "points");
  const auto g_points = series("midpoint locus", d.locus_speed, d.locus_half_difference, "points");
  figures.push_back(figure("figure_8", "Measured stiffness function", "phi / deg", "f / Nm",
                           "Mean of the two torques at each torsion, eq. (18).", {f_points}));
  figures.push_back(figure("figure_9", "Measured viscous damping function", "phi' / (deg/s)",
                           "g^-1 / Nm", "Half their difference, eq. (17), over the speed.",
                           {g_points}));
  figures.push_back(figure("figure_10", "Measured and estimated stiffness function", "phi / deg",
                           "f / Nm",
                           "The fit to the virtual recording beside Table I as published.",
                           {f_points, series("estimated", d.locus_torsion, d.f, "line"),
                            series("Table I", d.locus_torsion, d.f_table, "line")}));
  figures.push_back(figure("figure_11", "Measured and estimated viscous damping function",
                           "phi' / (deg/s)", "g^-1 / Nm",
                           "The fit to the virtual recording beside Table I as published.",
                           {g_points, series("estimated", d.locus_speed, d.g, "line"),
                            series("Table I", d.locus_speed, d.g_table, "line")}));
  const auto cycle = kept_indices(d.cycle, d.time.size());
  const Series torsion = at_indices(d.torsion, cycle);
  figures.push_back(figure(
      "figure_12", "Measured and estimated hysteresis loop", "phi / deg", "tau / Nm",
      "Eq. (26) at the measured torsion and the pure-sine speed, on the loop it was fitted to.",
      {series("measured", torsion, at_indices(d.torque, cycle), "line"),
       series("estimated", torsion, at_indices(d.torque_fitted, cycle), "line")}));
}

}  // namespace

ordered_json paper_figures(const PaperExperiment& experiment) {
  const auto f = make_law(experiment.estimate.model.f);
  const auto g = make_law(experiment.estimate.model.g_inverse);
  if (!f || !g) return ordered_json::array();
  const Drawn drawn = prepare(experiment, **f, **g);
  ordered_json figures = time_figures(drawn);
  add_function_figures(drawn, figures);
  return figures;
}

}  // namespace flexspline::studies
