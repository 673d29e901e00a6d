#include "flexspline/studies/paper_facts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "paper/damping_shape.hpp"
#include "paper/loop_figures.hpp"
#include "paper/odd_polynomial.hpp"

namespace flexspline::studies {
namespace {

using Facts = std::vector<PaperFact>;
constexpr double kDegreesPerRad = 180.0 / std::numbers::pi;

void add_loop(Facts& facts) {
  const PaperLoop loop = measure_paper_loop();
  facts.push_back({"peak_torque", "Peak torque of the loop", loop.peak_torque, "Nm", "16.54", 4});
  facts.push_back({"peak_torque_share", "Peak torque against the gear's rated torque",
                   100.0 * loop.peak_torque / kRatedTorque, "%", "7.3", 2});
  facts.push_back(
      {"peak_g_inverse", "Peak of g^-1 on the loop", loop.peak_damping, "Nm", "4.47", 3});
  facts.push_back({"loop_area", "Loop area, by quadrature", loop.area, "Nm deg", "2.468", 4});
  facts.push_back({"loop_area_closed_form",
                   "Loop area, closed form pi A v0^k b_k (2k-1)!!/(2k)!! summed",
                   closed_form_area(), "Nm deg", "2.468", 4});
  facts.push_back(
      {"loop_work", "Work lost per cycle", loop.area / kDegreesPerRad, "J", "0.0431", 3});
}

void add_stiffness(Facts& facts) {
  const double tangent = kStiffness.slope(0.0) * kDegreesPerRad;
  const double edge = kStiffness.slope(kAmplitudeDeg) * kDegreesPerRad;
  const double secant = kStiffness.value(kAmplitudeDeg) / kAmplitudeDeg * kDegreesPerRad;
  constexpr double kCatalogueStiffness = 1.5e5;  // Nm/rad, K1 of a gear of that rating and ratio
  facts.push_back(
      {"tangent_stiffness_zero", "Tangent stiffness at zero", tangent, "Nm/rad", "810", 3});
  facts.push_back(
      {"tangent_stiffness_edge", "Tangent stiffness at the edge", edge, "Nm/rad", "11381", 5});
  facts.push_back(
      {"secant_stiffness", "Secant stiffness over the loop", secant, "Nm/rad", "4738", 4});
  facts.push_back({"softer_than_catalogue",
                   "Catalogue stiffness K1 = 1.5e5 Nm/rad against the secant",
                   kCatalogueStiffness / secant, "times", "30", 1});
}

void add_monotonicity(Facts& facts) {
  const double f_turn = kStiffness.slope_zeros().front();
  const double g_turn = kDamping.slope_zeros().front();
  facts.push_back({"f_slope_zero", "f' = 0: f stops rising", f_turn, "deg", "0.2362", 4});
  facts.push_back({"f_slope_zero_share", "the same, of the trained range",
                   100.0 * f_turn / kAmplitudeDeg, "%", "118", 3});
  facts.push_back(
      {"g_slope_zero", "(g^-1)' = 0: g^-1 stops rising", g_turn, "deg/s", "0.00713", 3});
  facts.push_back({"g_slope_zero_share", "the same, of the trained range",
                   100.0 * g_turn / kSpeedDeg, "%", "113.5", 4});
  facts.push_back({"f_zero_share", "f < 0 above this share of the range",
                   100.0 * kStiffness.zeros().front() / kAmplitudeDeg, "%", "136", 3});
  facts.push_back({"g_zero_share", "g^-1 < 0 above this share of the range",
                   100.0 * kDamping.zeros().front() / kSpeedDeg, "%", "131.5", 4});
}

void add_extrapolation(Facts& facts) {
  facts.push_back({"f_at_twice", "f at twice the amplitude", kStiffness.value(2.0 * kAmplitudeDeg),
                   "Nm", "-3908", 4});
  facts.push_back(
      {"g_at_1.5", "g^-1 at 1.5 times the speed", kDamping.value(1.5 * kSpeedDeg), "Nm", "-41", 2});
  facts.push_back(
      {"g_at_2", "g^-1 at twice the speed", kDamping.value(2.0 * kSpeedDeg), "Nm", "-1540", 3});
  facts.push_back({"g_at_5", "g^-1 at five times the speed", kDamping.value(5.0 * kSpeedDeg), "Nm",
                   "-1.2e7", 2});
}

void add_fingerprint(Facts& facts) {
  const PowerLaw power = fit_power_law();
  facts.push_back(
      {"power_law_exponent", "Exponent n of g^-1 = c (v/v0)^n", power.exponent, "1", "1.79", 3});
  facts.push_back(
      {"power_law_coefficient", "Coefficient c of the same", power.coefficient, "Nm", "4.50", 3});
  facts.push_back(
      {"power_law_misfit", "its rms misfit, of the peak", power.rms_percent, "%", "1.1", 2});
  facts.push_back({"quadratic_misfit",
                   "misfit of v|v|, the shape of a rate-independent Rayleigh loop",
                   shape_misfit_percent([](double v) { return v * v; }), "%", "2.4", 2});
  facts.push_back({"linear_misfit", "misfit of a linear damper",
                   shape_misfit_percent([](double v) { return v; }), "%", "10", 2});
  facts.push_back({"coulomb_misfit", "misfit of Coulomb friction, tanh(5 v/v0)",
                   shape_misfit_percent([](double v) { return std::tanh(5.0 * v); }), "%", "25",
                   2});
}

void add_conditioning(Facts& facts) {
  facts.push_back({"condition_f", "Condition number of the raw-unit design matrix of f",
                   vandermonde_condition(kAmplitudeDeg), "1", "1e8", 1});
  facts.push_back({"condition_g", "Condition number of the raw-unit design matrix of g^-1",
                   vandermonde_condition(kSpeedDeg), "1", "1e20", 1});
  facts.push_back({"cancellation_f", "Terms of f at the edge, summed without sign, over their sum",
                   kStiffness.cancellation(kAmplitudeDeg), "times", "8.8", 2});
  facts.push_back(
      {"cancellation_g", "The same of g^-1", kDamping.cancellation(kSpeedDeg), "times", "15", 2});
}

void add_inertia(Facts& facts) {
  const double inertia = kGearRatio * kGearRatio * (kWaveGeneratorInertia + kMotorInertia);
  const auto torque = [&](double frequency_hz) {
    const double omega = 2.0 * std::numbers::pi * frequency_hz;
    return inertia * kAmplitudeDeg / kDegreesPerRad * omega * omega;
  };
  facts.push_back(
      {"inertia", "Inertia J = N^2 (J_wg + J_m) at the output", inertia, "kg m2", "1.815", 4});
  facts.push_back({"inertia_torque_0.005", "J phi'' at 0.005 Hz", torque(0.005), "Nm", "6e-6", 1});
  facts.push_back({"inertia_torque_1", "J phi'' at 1 Hz", torque(1.0), "Nm", "0.25", 2});
  facts.push_back({"inertia_torque_5", "J phi'' at 5 Hz", torque(5.0), "Nm", "6.3", 2});
}

}  // namespace

std::vector<PaperFact> paper_facts() {
  Facts facts;
  add_loop(facts);
  add_stiffness(facts);
  add_monotonicity(facts);
  add_extrapolation(facts);
  add_fingerprint(facts);
  add_conditioning(facts);
  add_inertia(facts);
  return facts;
}

std::string rounded(double value, int digits) {
  // Through the scientific form, as only that rounds to significant digits.
  const std::string scientific = fmt::format("{:.{}e}", value, digits - 1);
  const double kept = std::stod(scientific);
  const int exponent = std::stoi(scientific.substr(scientific.find('e') + 1));
  return fmt::format("{:.{}f}", kept, std::max(0, digits - 1 - exponent));
}

}  // namespace flexspline::studies
