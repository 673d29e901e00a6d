#include "comparison/function_errors.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "flexspline/core/law.hpp"

namespace flexspline::studies {
namespace {

constexpr int kHalf = 100;  // points on either side of zero

template <class Visit>
void over_range(double edge, const Visit& visit) {
  for (int i = -kHalf; i <= kHalf; ++i) visit(edge * i / kHalf);
}

double rms_percent(const LawSpec& spec, const std::function<double(double)>& truth, double edge) {
  const auto law = make_law(spec);
  if (!law || !truth || !(edge > 0.0)) return kNotComputed;
  double sum = 0.0;
  over_range(edge, [&](double x) {
    const double error = (*law)->value(x) - truth(x);
    sum += error * error;
  });
  return 100.0 * std::sqrt(sum / (2 * kHalf + 1)) / std::abs(truth(edge));
}

double largest_log_error(const LawSpec& spec, const std::function<double(double)>& truth,
                         double edge) {
  const auto law = make_law(spec);
  if (!law || !(edge > 0.0)) return kNotComputed;
  double largest = 0.0;
  over_range(edge, [&](double x) {
    const double known = truth ? truth(x) : 0.0;
    largest = std::max(largest, std::abs(std::log((*law)->value(x)) - known));
  });
  return 100.0 * largest;
}

}  // namespace

Reach reach_of(const PreparedInput& input, const std::vector<std::string>& ids) {
  Reach reach;
  for (const std::string& id : ids) {
    const StudyRecording* found = input.find(id);
    if (found == nullptr || !found->record.amplitude || !found->record.frequency_hz) continue;
    const double amplitude = *found->record.amplitude;
    const double omega = 2.0 * std::numbers::pi * *found->record.frequency_hz;
    reach.motion = std::max(reach.motion, amplitude);
    reach.speed = std::max(reach.speed, amplitude * omega);
  }
  return reach;
}

std::map<std::string, double> function_errors(const Estimate& estimate, const PreparedInput& input,
                                              const std::vector<std::string>& trained) {
  std::map<std::string, double> errors{
      {"f", kNotComputed}, {"g_inverse", kNotComputed}, {"h", kNotComputed}};
  if (!input.truth || !input.truth->slip_elements.empty()) return errors;
  const Reach reach = reach_of(input, trained);
  errors["f"] = rms_percent(estimate.model.f, input.truth->stiffness, reach.motion);
  errors["g_inverse"] = rms_percent(estimate.model.g_inverse, input.truth->damping, reach.speed);
  const bool printed = std::ranges::any_of(
      estimate.bands, [](const FunctionBand& band) { return band.function == "h"; });
  if (printed) {
    errors["h"] = largest_log_error(estimate.model.h, input.truth->log_modulation, reach.motion);
  }
  return errors;
}

}  // namespace flexspline::studies
