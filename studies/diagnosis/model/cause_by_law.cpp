#include "diagnosis/model/cause_by_law.hpp"
#include "diagnosis/frame/coordinates.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "diagnosis/model/cause_columns.hpp"
#include "flexspline/core/effect_dependence.hpp"
#include "flexspline/core/effect_path.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Role = ParameterSearch::Role;
using Values = std::span<const double>;

double measure(const Frame& f, Scale by) {
  switch (by) {
    case Scale::one:
      return 1.0;
    case Scale::motor_speed:
      return f.speed_range;
    case Scale::load_speed:
      return f.load_speed.abs().maxCoeff();
    case Scale::torsion:
      return f.torsion_range;
    case Scale::torsion_rate:
      return f.rate_range;
    case Scale::torque:
      return f.torque_range;
    case Scale::duration:
      return f.duration;
    case Scale::session:
      break;
  }
  return f.session;
}

Instant<double> instant_at(const Frame& f, Index r) {
  return {.time = f.clock[r],
          .motor_angle = f.motor_angle[r],
          .motor_speed = f.motor_speed[r],
          .motor_acceleration = f.motor_acceleration[r],
          .load_angle = f.load_angle[r],
          .load_speed = f.load_speed[r],
          .load_acceleration = f.load_acceleration[r],
          .torsion = f.torsion[r],
          .torsion_rate = f.torsion_rate[r],
          .torsion_acceleration = f.torsion_acceleration[r],
          .transmitted_torque = f.smooth_torque[r],
          .transmitted_torque_rate = f.torque_rate[r],
          .motor_torque = f.smooth_motor_torque[r],
          .motor_torque_rate = f.motor_torque_rate[r],
          .gear_ratio = f.ratio};
}

/// An effect, and how it is sought in one equation.
class Sought {
 public:
  Sought(std::shared_ptr<const EffectRow> effect, Equation at, bool own_width)
      : effect_(std::move(effect)), at_(at), own_width_(own_width) {}

  bool across() const { return effect_->site == Site::motor && at_ == Equation::torsion; }
  bool has(Role role) const {
    return std::ranges::any_of(effect_->parameters,
                               [&](const EffectParameter& p) { return p.search.role == role; });
  }

  std::vector<Shape> shapes(const Frame& f) const {
    std::vector<Shape> list;
    for (const EffectParameter& p : effect_->parameters) {
      const ParameterSearch& s = p.search;
      if (s.role != Role::shape) continue;
      const double unit = measure(f, seen(s.scale));
      list.push_back({.name = p.name,
                      .unit = p.unit,
                      .lower = s.lower * unit,
                      .upper = s.upper * unit,
                      .grid = s.grid,
                      .meaning = s.meaning});
    }
    // Below the first width a sign is as good as abrupt, above the last it is a drag.
    if (own_width_) {
      list.push_back({.name = "width",
                      .unit = "rad/s",
                      .lower = 1e-3 * f.rate_range,
                      .upper = 0.1 * f.rate_range,
                      .meaning = "over which it turns its sign, or around zero torque"});
    }
    return list;
  }

  std::vector<Term> terms(const Frame&) const {
    std::vector<Term> list;
    for (const EffectParameter& p : effect_->parameters) {
      if (p.search.role != Role::linear) continue;
      const std::string unit(p.unit);
      const std::string meaning(p.search.meaning);
      if (has(Role::phase)) return {{"sine", unit, meaning}, {"cosine", unit, "its cosine"}};
      list.push_back({std::string(p.name), unit, meaning});
    }
    return list;
  }

  Columns columns(Equation equation, const Frame& f, const Reference& known, Values shape) const {
    Columns list;
    for (const std::size_t k : linear()) {
      for (const double phase : phases()) list.push_back(column(f, known, shape, k, phase));
    }
    if (effect_->site == Site::torque_signal) return of_torque_signal(equation, f, std::move(list));
    if (effect_->site == Site::load && equation == Equation::motor) {
      for (ArrayXd& column : list) column /= f.ratio;
    }
    return list;
  }

  Counterpart counterpart(const FittedCause& c) const {
    Counterpart made;
    std::vector<SignPart> sign = {{1.0, own_width_ ? c.shape.back() : 1.0}};
    if (has(Role::sign_width) && !own_width_) {
      const auto& whole = at_ == Equation::motor ? c.motor_sign : c.torsion_sign;
      sign.assign(whole.begin(), whole.end());
    }
    for (const SignPart& part : sign)
      made.effects.push_back({std::string(effect_->id), fitted(c, part)});
    if (depends_on(*effect_, nominal(), &Instant<Complex>::time)) made.caveat = kSessionClock;
    return made;
  }

  /// An angle has a period, or a place, only where it travels; the motor's where its turns show.
  bool can_show(const Frame& f) const {
    const bool of_motor = depends_on(*effect_, nominal(), &Instant<Complex>::motor_angle);
    const bool of_load = depends_on(*effect_, nominal(), &Instant<Complex>::load_angle);
    if (f.rig == Rig::specimen) return !(of_motor || of_load) || travels(f);
    return !of_motor || geared(f);
  }

  bool nonnegative() const {
    return !has(Role::phase) && std::ranges::all_of(effect_->parameters, [](const auto& p) {
      return p.search.role != Role::linear || p.lower >= 0.0;
    });
  }

 private:
  /// Across the transmission the torsion is the motor's angle.
  Scale seen(Scale scale) const {
    return across() && scale == Scale::motor_speed ? Scale::torsion_rate : scale;
  }

  std::vector<std::size_t> linear() const {
    std::vector<std::size_t> list;
    for (std::size_t k = 0; k < effect_->parameters.size(); ++k)
      if (effect_->parameters[k].search.role == Role::linear) list.push_back(k);
    return list;
  }

  std::vector<double> phases() const {
    return has(Role::phase) ? std::vector<double>{0.0, std::numbers::pi / 2.0}
                            : std::vector<double>{0.0};
  }

  std::vector<double> nominal() const {
    std::vector<double> values;
    for (const EffectParameter& p : effect_->parameters) values.push_back(p.nominal);
    return values;
  }

  /// Parameters at shapes, with the linear ones at zero and an abrupt sign where it has no width.
  std::vector<double> values_at(const Frame& f, Values shape, double phase, double width) const {
    std::vector<double> values = nominal();
    std::size_t next = 0;
    for (std::size_t k = 0; k < values.size(); ++k) {
      const ParameterSearch& s = effect_->parameters[k].search;
      if (s.role == Role::linear) values[k] = 0.0;
      if (s.role == Role::phase) values[k] = phase;
      if (s.role == Role::shape) values[k] = shape[next++];
      if (s.role == Role::sign_width) values[k] = width;
      if (s.role == Role::negligible) values[k] = 1e-6 * measure(f, seen(s.scale));
    }
    return values;
  }

  double abrupt(const Frame& f) const {
    return 1e-12 * std::max(at_ == Equation::motor ? f.speed_range : f.rate_range, 1e-300);
  }

  ArrayXd column(const Frame& f, const Reference& known, Values shape, std::size_t which,
                 double phase) const {
    std::vector<double> values = values_at(f, shape, phase, own_width_ ? shape.back() : abrupt(f));
    values[which] = 1.0;
    ArrayXd column = along(f, values);
    if (!has(Role::sign_width) || own_width_) return column;
    const ArrayXd& speed = at_ == Equation::motor ? f.motor_speed : f.torsion_rate;
    const ArrayXd sign = at_ == Equation::motor ? known.motor_sign
                                                : rounded_sign(f.torsion_rate, known.torsion_sign);
    return column * speed.sign() * sign;
  }

  ArrayXd along(const Frame& f, const std::vector<double>& values) const {
    const bool turned = across() || f.rig == Rig::specimen;
    ArrayXd column(f.rows());
    for (const Segment& s : f.segments) {
      std::vector<double> states(effect_->states, 0.0);
      Instant<double> last;
      for (Index r = s.first; r < s.first + s.count; ++r) {
        Instant<double> x = instant_at(f, r);
        if (turned) x = across_transmission(x);
        if (r > s.first && effect_->states > 0) effect_->real.advance(last, x, values, states);
        column[r] = effect_->real.term(x, values, states);
        last = x;
      }
    }
    return column;
  }

  std::vector<std::pair<std::string, double>> fitted(const FittedCause& c,
                                                     const SignPart& part) const {
    std::vector<double> values = values_at(c.frame, c.shape, 0.0, part.width);
    Index next = 0;
    for (const std::size_t k : linear()) values[k] = part.share * c.coefficients[next++];
    std::vector<std::pair<std::string, double>> named;
    for (std::size_t k = 0; k < values.size(); ++k) {
      const EffectParameter& p = effect_->parameters[k];
      if (has(Role::phase)) {
        const double s = c.coefficients[0];
        const double q = c.coefficients[1];
        if (p.search.role == Role::linear) values[k] = part.share * std::hypot(s, q);
        if (p.search.role == Role::phase) values[k] = std::atan2(q, s);
      }
      named.emplace_back(p.name, values[k]);
    }
    return named;
  }

  std::shared_ptr<const EffectRow> effect_;
  Equation at_;
  bool own_width_;
};

std::vector<Rig> both(const std::vector<Rig>& a, const std::vector<Rig>& b) {
  std::vector<Rig> list;
  std::ranges::copy_if(a, std::back_inserter(list),
                       [&](Rig rig) { return std::ranges::find(b, rig) != b.end(); });
  return list;
}

/// Where an effect shows: the rigs, and the equations on them.
struct Place {
  std::vector<Rig> rigs;
  std::vector<Equation> at;
  bool own_width = false;
};

std::vector<Place> places(const EffectRow& effect) {
  const bool rubs = std::ranges::any_of(effect.parameters, [](const EffectParameter& p) {
    return p.search.role == Role::sign_width;
  });
  const std::vector<Rig> specimen = {Rig::specimen};
  switch (effect.site) {
    case Site::motor: {
      std::vector<Place> list = {{kMotors, {Equation::motor}},
                                 {rubs ? kAnyRig : specimen, {Equation::torsion}}};
      if (rubs) list.push_back({specimen, {Equation::torsion}, true});
      return list;
    }
    case Site::load:
      return {{{Rig::free}, {Equation::load}}, {{Rig::servo}, {Equation::motor}}};
    case Site::transmission:
      return {{kAnyRig, {Equation::torsion}}};
    case Site::torque_signal:
      return {{kAnyRig, {Equation::torsion, Equation::load, Equation::motor}}};
    case Site::motor_torque_signal:
      return {{kMotors, {Equation::motor}}};
    default:
      return {};
  }
}

}  // namespace

std::optional<CauseRow> cause_by_law(const EffectRow& effect) {
  if (!sought_by_law(effect)) return std::nullopt;
  const auto shared = std::make_shared<const EffectRow>(effect);
  CauseRow row{.id = effect.id, .coordinate = effect.coordinate, .forms = {}};
  for (const Place& place : places(effect)) {
    const Sought sought(shared, place.at.front(), place.own_width);
    CauseForm form{
        .equation =
            std::string(effect.equation) + (sought.across() ? ", across the transmission" : ""),
        .rigs = both(place.rigs, effect.sought_on.empty() ? effect.rigs : effect.sought_on),
        .at = place.at};
    if (form.rigs.empty()) continue;
    const bool shaped = place.own_width || sought.has(Role::shape);
    if (shaped) form.shapes = [=](const Frame& f) { return sought.shapes(f); };
    form.terms = [=](const Frame& f) { return sought.terms(f); };
    form.columns = [=](Equation e, const Frame& f, const Reference& known, Values shape) {
      return sought.columns(e, f, known, shape);
    };
    form.nonnegative = sought.nonnegative();
    form.friction = sought.across() && sought.has(Role::sign_width);
    form.offsets_torque = effect.site == Site::torque_signal && effect.coordinate == "constant";
    form.extends = place.own_width;
    form.where = [=](const Frame& f) { return sought.can_show(f); };
    form.counterpart = [=](const FittedCause& c) { return sought.counterpart(c); };
    row.forms.push_back(std::move(form));
  }
  if (row.forms.empty()) return std::nullopt;
  return row;
}

}  // namespace flexspline::studies
