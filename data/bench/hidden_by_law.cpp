#include "bench/hidden_by_law.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "bench/hidden_differences.hpp"
#include "bench/hidden_law.hpp"
#include "flexspline/core/effect_path.hpp"

namespace flexspline::data {
namespace {

using Role = ParameterSearch::Role;

std::optional<HiddenSite> site_on_bench(Site site) {
  switch (site) {
    case Site::motor:
      return HiddenSite::motor;
    case Site::load:
      return HiddenSite::load;
    case Site::transmission:
      return HiddenSite::transmission;
    case Site::torque_signal:
      return HiddenSite::torque_sensor;
    case Site::motor_torque_signal:
      return HiddenSite::motor_sensor;
    default:
      return std::nullopt;
  }
}

bool moves_load(const HiddenScale& scale) {
  return scale.rig == Rig::free || scale.rig == Rig::servo;
}

double torsion_rate(const HiddenScale& scale) {
  return moves_load(scale) ? scale.torsion * scale.mean_rate : scale.speed;
}

double measure(const HiddenScale& scale, Scale by) {
  switch (by) {
    case Scale::one:
      return 1.0;
    case Scale::motor_speed:
      return scale.friction_speed();
    case Scale::load_speed:
      return scale.speed;
    case Scale::torsion:
      return scale.torsion;
    case Scale::torsion_rate:
      return torsion_rate(scale);
    case Scale::torque:
      return scale.torque;
    case Scale::duration: {
      double longest = 0.0;
      for (const auto& span : scale.recordings) longest = std::max(longest, span.duration);
      return longest;
    }
    case Scale::session:
      break;
  }
  return scale.clock_end;
}

/// Parameters with their linear ones at 1; shapes are drawn from the middle of their range.
std::vector<double> drawn_values(const EffectRow& effect, const HiddenScale& scale) {
  std::vector<double> values;
  for (const EffectParameter& parameter : effect.parameters) {
    const ParameterSearch& search = parameter.search;
    const double unit = measure(scale, search.scale);
    const double share = scale.draw(effect.id, values.size(), 0.3, 0.7);
    double value = parameter.nominal;
    if (search.role == Role::linear) value = 1.0;
    if (search.role == Role::phase) value = (2.0 * share - 1.0) * std::numbers::pi;
    if (search.role == Role::shape)
      value = unit * search.lower * std::pow(search.upper / search.lower, share);
    if (search.role == Role::sign_width) value = 0.02 * scale.friction_speed();
    if (search.role == Role::negligible) value = 1e-6 * unit;
    values.push_back(value);
  }
  return values;
}

using SharedEffect = std::shared_ptr<const EffectRow>;

/// The law along one recording. Its memory moves where it is told to remember.
class LawAlong {
 public:
  LawAlong(SharedEffect effect, std::vector<double> values)
      : effect_(std::move(effect)), values_(std::move(values)), states_(effect_->states, 0.0) {}

  double at(const Instant<double>& x) const {
    if (effect_->states == 0) return effect_->real.term(x, values_, {});
    std::vector<double> states = states_;
    if (last_) effect_->real.advance(*last_, x, values_, states);
    return effect_->real.term(x, values_, states);
  }

  void remember(const Instant<double>& x) {
    if (effect_->states == 0) return;
    if (last_) effect_->real.advance(*last_, x, values_, states_);
    last_ = x;
  }

  double next(const Instant<double>& x) {
    remember(x);
    return effect_->real.term(x, values_, states_);
  }

 private:
  SharedEffect effect_;
  std::vector<double> values_;
  std::vector<double> states_;
  std::optional<Instant<double>> last_;
};

Instant<double> instant_of(const LoadPoint& x, const HiddenScale& scale) {
  Instant<double> i;
  i.time = x.clock;
  i.load_angle = x.angle, i.load_speed = x.velocity, i.load_acceleration = x.acceleration;
  if (moves_load(scale)) return i;
  i.torsion = x.angle, i.torsion_rate = x.velocity, i.torsion_acceleration = x.acceleration;
  return across_transmission(i);
}

Instant<double> instant_of(const MotorPoint& x, const HiddenScale& scale) {
  Instant<double> i;
  i.time = x.clock;
  i.motor_angle = x.angle, i.motor_speed = x.velocity;
  i.transmitted_torque = x.torque, i.motor_torque = x.drive;
  i.gear_ratio = scale.gear->gear_ratio;
  return i;
}

Instant<double> instant_of(const TorsionPoint& x, const HiddenScale& scale) {
  Instant<double> i;
  i.time = x.clock;
  i.torsion = x.torsion, i.torsion_rate = x.rate;
  i.motor_angle = x.motor_angle;
  i.gear_ratio = scale.gear->gear_ratio;
  return scale.rig == Rig::specimen ? across_transmission(i) : i;
}

/// The whole of a recording as its sensors would see it.
std::vector<Instant<double>> path_of(const HiddenSignals& s, const HiddenScale& scale) {
  const double ratio = scale.gear->gear_ratio;
  std::vector<double> torsion(s.size());
  for (std::size_t k = 0; k < s.size(); ++k)
    torsion[k] = s.motor_angle[k] / ratio - s.load_angle[k];
  const auto motor = slopes(s.motor_angle, s.step);
  const auto load = slopes(s.load_angle, s.step);
  const auto rate = slopes(torsion, s.step);
  const auto torque_rate = slopes(s.torque, s.step);
  std::vector<Instant<double>> path(s.size());
  for (std::size_t k = 0; k < s.size(); ++k) {
    Instant<double>& i = path[k];
    i.time = s.clock(k);
    i.motor_angle = s.motor_angle[k], i.motor_speed = motor[k];
    i.load_angle = s.load_angle[k], i.load_speed = load[k];
    i.torsion = torsion[k], i.torsion_rate = rate[k];
    i.transmitted_torque = s.torque[k], i.transmitted_torque_rate = torque_rate[k];
    i.motor_torque = s.motor_torque[k];
    i.gear_ratio = ratio;
  }
  return path;
}

void put_on_signal(HiddenLaw& law, const HiddenScale& scale, LawAlong along,
                   std::vector<double> HiddenSignals::*signal) {
  law.sensing = [=](HiddenSignals& s) {
    LawAlong own = along;
    const auto path = path_of(s, scale);
    for (std::size_t k = 0; k < s.size(); ++k) (s.*signal)[k] += own.next(path[k]);
  };
}

void put_on_shaft(HiddenLaw& law, const HiddenScale& scale, HiddenSite site, LawAlong along) {
  if (site == HiddenSite::transmission) {
    const auto shared = std::make_shared<LawAlong>(std::move(along));
    law.transmission = [=](const TorsionPoint& x) { return shared->at(instant_of(x, scale)); };
    law.remember = [=](const TorsionPoint& x) { shared->remember(instant_of(x, scale)); };
  } else if (site == HiddenSite::motor && scale.at_motor()) {
    law.motor = [=](const MotorPoint& x) mutable { return along.next(instant_of(x, scale)); };
  } else {
    law.load = [=](const LoadPoint& x) mutable { return along.next(instant_of(x, scale)); };
  }
}

/// Largest |term| over a few strokes of the size of the bench's, to start the search of the size.
double response(const SharedEffect& effect, const std::vector<double>& values,
                const HiddenScale& scale) {
  LawAlong along(effect, values);
  double most = 0.0;
  for (int k = 0; k < 400; ++k) {
    const double turn = 0.06 * k;
    Instant<double> i;
    i.time = scale.clock_end * k / 400.0;
    i.motor_angle = scale.motor_speed / scale.mean_rate * std::sin(turn);
    i.motor_speed = scale.friction_speed() * std::cos(turn);
    i.load_angle = scale.motion * std::sin(turn), i.load_speed = scale.speed * std::cos(turn);
    i.torsion = scale.torsion * std::sin(turn),
    i.torsion_rate = torsion_rate(scale) * std::cos(turn);
    i.transmitted_torque = scale.torque * std::sin(turn);
    i.motor_torque = scale.motor_torque * std::sin(turn);
    i.gear_ratio = scale.gear->gear_ratio;
    most = std::max(most, std::abs(along.next(i)));
  }
  return most > 0.0 && std::isfinite(most) ? most : 1.0;
}

HiddenLaw make(const SharedEffect& effect, HiddenSite site, const HiddenScale& scale,
               double amount) {
  const bool motor_side =
      site == HiddenSite::motor_sensor || (site == HiddenSite::motor && scale.at_motor());
  std::vector<double> values = drawn_values(*effect, scale);
  const double unit =
      (motor_side ? scale.motor_torque : scale.torque) / response(effect, values, scale);
  HiddenLaw law;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const EffectParameter& parameter = effect->parameters[k];
    if (parameter.search.role == Role::linear) values[k] = amount * unit;
    law.parameters.push_back({std::string(parameter.name), values[k], std::string(parameter.unit)});
  }
  LawAlong along(effect, std::move(values));
  if (site == HiddenSite::torque_sensor) {
    put_on_signal(law, scale, std::move(along), &HiddenSignals::torque);
  } else if (site == HiddenSite::motor_sensor) {
    put_on_signal(law, scale, std::move(along), &HiddenSignals::motor_torque);
  } else {
    put_on_shaft(law, scale, site, std::move(along));
  }
  return law;
}

}  // namespace

std::optional<HiddenRow> hidden_by_law(const EffectRow& effect) {
  const auto site = site_on_bench(effect.site);
  if (!site || !sought_by_law(effect)) return std::nullopt;
  const auto has_sign = std::ranges::any_of(effect.parameters, [](const EffectParameter& p) {
    return p.search.role == Role::sign_width;
  });
  const std::vector<Rig> rigs = effect.sought_on.empty() ? effect.rigs : effect.sought_on;
  const bool on_specimen = std::ranges::find(rigs, Rig::specimen) != rigs.end();
  return HiddenRow{
      .id = effect.id,
      .coordinate = effect.coordinate,
      .equation = effect.equation,
      .site = *site,
      .rigs = rigs,
      .dissipates = has_sign && effect.passive,
      .make = [row = std::make_shared<const EffectRow>(effect), at = *site](
                  const HiddenScale& scale, double amount) { return make(row, at, scale, amount); },
      .joint = on_specimen && *site == HiddenSite::motor};
}

}  // namespace flexspline::data
