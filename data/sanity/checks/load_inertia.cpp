#include <cmath>

#include <fmt/format.h>

#include "sanity/check.hpp"
#include "sanity/evidence.hpp"

namespace flexspline::data {
namespace {

using Eigen::ArrayXd;

constexpr SanityVerdict kBackwards{"check_sign", Severity::error,
                                   "check the sign of transmitted_torque against load_angle"};
constexpr SanityVerdict kOtherInertia{
    "check_units", Severity::error,
    "check the units of time, load_angle and transmitted_torque, and the inertia"};

constexpr double kMostOff = 2.0;
constexpr double kClear = 20.0;  // standard errors, of white noise

/// J in tau = J theta_l'' + B theta_l' + c |.| + m sin(theta_l), over what the set states; or
/// without gravity, which on short strokes is much like an inertia.
std::vector<Factor> inertias(const ObservedSet& all) {
  std::vector<Factor> list;
  const double stated = all.constant("load_inertia_kgm2");
  for (const Observed& o : all.recordings) {
    if (o.effort.size() == 0 || o.load_angle.size() == 0) continue;
    std::vector<ArrayXd> columns = {o.load_acceleration, o.load_speed, smooth_sign(o.load_speed),
                                    ArrayXd::Ones(o.time.size())};
    const Regression level = regression(columns, o.effort, o.usable);
    columns.push_back(o.load_angle.sin());
    const Regression fit = nearer_to(stated, level, regression(columns, o.effort, o.usable));
    if (std::abs(fit.coefficient[0]) < kClear * fit.error[0]) continue;
    list.push_back({o.recording->id, fit.coefficient[0] / stated});
  }
  return list;
}

SanityFinding finding(const std::string& recording, double factor, double ratio) {
  const std::string seen =
      fmt::format("torque over acceleration of the load is {:.3g} times load_inertia_kgm2", factor);
  if (factor < 0.0) return kBackwards.on(recording, seen);
  const std::string mistake = mistake_of(factor, ratio);
  return kOtherInertia.on(recording,
                          mistake.empty() ? seen : fmt::format("{} ({})", seen, mistake));
}

std::vector<SanityFinding> find(const ObservedSet& all) {
  if (all.set.rig != Rig::free || !(all.constant("load_inertia_kgm2") > 0.0)) return {};
  const auto factors = inertias(all);
  if (factors.empty()) return {};
  const double ratio = all.constant("gear_ratio");
  const Agreement agreement = agreement_of(factors, kMostOff);
  std::vector<SanityFinding> list;
  if (is_off(agreement.common, kMostOff)) list.push_back(finding("", agreement.common, ratio));
  for (const Factor& other : agreement.others) {
    if (is_mistaken_alone(other.value, kMostOff)) {
      list.push_back(finding(other.recording, other.value, ratio));
    }
  }
  return list;
}

}  // namespace

SanityRow describe_load_inertia() {
  return {"load_inertia",
          "the load's inertia against torque over acceleration",
          {kBackwards, kOtherInertia},
          find};
}

}  // namespace flexspline::data
