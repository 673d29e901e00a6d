#include "flexspline/core/rig_residuals.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "flexspline/core/effect_path.hpp"
#include "flexspline/core/law.hpp"
#include "path_reactions.hpp"

namespace flexspline {
namespace {

using Series = std::vector<double>;
using Path = std::vector<Instant<double>>;

void enter(Path& path, const Series& series, double Instant<double>::*member) {
  for (std::size_t i = 0; i < series.size(); ++i) path[i].*member = series[i];
}

// Torsion by eq. (8), or as measured.
Path path_of(Rig rig, const DriveSpec& drive, const DriveChannels& c) {
  using I = Instant<double>;
  Path path(c.time.size());
  enter(path, c.time, &I::time);
  enter(path, c.motor_angle, &I::motor_angle);
  enter(path, c.motor_speed, &I::motor_speed);
  enter(path, c.motor_acceleration, &I::motor_acceleration);
  enter(path, c.load_angle, &I::load_angle);
  enter(path, c.load_speed, &I::load_speed);
  enter(path, c.load_acceleration, &I::load_acceleration);
  enter(path, c.motor_torque, &I::motor_torque);
  for (I& x : path) {
    x.gear_ratio = drive.gear_ratio;
    x.torsion = x.motor_angle / drive.gear_ratio - x.load_angle;
    x.torsion_rate = x.motor_speed / drive.gear_ratio - x.load_speed;
    x.torsion_acceleration = x.motor_acceleration / drive.gear_ratio - x.load_acceleration;
  }
  for (auto member : {&I::torsion, &I::motor_angle, &I::load_angle}) enter(path, c.torsion, member);
  for (auto member : {&I::torsion_rate, &I::motor_speed, &I::load_speed}) {
    enter(path, c.torsion_rate, member);
  }
  for (auto member : {&I::torsion_acceleration, &I::motor_acceleration, &I::load_acceleration}) {
    enter(path, c.torsion_acceleration, member);
  }
  if (rig == Rig::servo) {
    enter(path, c.load_angle, &I::torsion);
    enter(path, c.load_speed, &I::torsion_rate);
  }
  if (!c.transmitted_torque.empty()) set_torque(path, c.transmitted_torque);
  return path;
}

Result<Series> effects_at(std::initializer_list<Site> sites, const DriveSpec& drive,
                          const Path& path) {
  Series sum(path.size(), 0.0);
  for (const EffectSpec& spec : drive.torsion.effects) {
    const auto row = find_effect(spec.effect);
    if (!row) return tl::unexpected(row.error());
    if (std::ranges::find(sites, site_of(**row, spec)) == sites.end()) continue;
    if (auto done = apply_along(**row, spec, path, sum); !done) return tl::unexpected(done.error());
  }
  return sum;
}

// The torsion that the law sees, and its rate by differences of what the kinematics add.
Result<Path> seen_by_the_law(const DriveSpec& drive, Path path) {
  const auto added = effects_at({Site::kinematics}, drive, path);
  if (!added) return tl::unexpected(added.error());
  for (std::size_t i = 0; i < path.size(); ++i) {
    const std::size_t before = i > 0 ? i - 1 : 0;
    const std::size_t after = std::min(i + 1, path.size() - 1);
    path[i].torsion += (*added)[i];
    if (after == before) continue;
    path[i].torsion_rate +=
        ((*added)[after] - (*added)[before]) / (path[after].time - path[before].time);
  }
  return path;
}

// On a specimen whatever opposes the motion is part of the effort.
Result<Series> torsion_law_along(Rig rig, const DriveSpec& drive, const Path& rigid) {
  const auto path = seen_by_the_law(drive, rigid);
  if (!path) return tl::unexpected(path.error());
  const auto f = make_law(drive.torsion.f);
  const auto g_inverse = make_law(drive.torsion.g_inverse);
  const auto h = make_law(drive.torsion.h);
  for (const auto* law : {&f, &g_inverse, &h}) {
    if (!*law) return tl::unexpected(law->error());
  }
  auto torque = rig == Rig::specimen
                    ? effects_at({Site::transmission, Site::motor, Site::load}, drive, *path)
                    : effects_at({Site::transmission}, drive, *path);
  if (!torque) return torque;
  for (std::size_t i = 0; i < path->size(); ++i) {
    const auto& x = (*path)[i];
    (*torque)[i] +=
        (*f)->value(x.torsion) + (*g_inverse)->value(x.torsion_rate / (*h)->value(x.torsion));
  }
  return torque;
}

// Adds what the transmission returns to a shaft that both turn. A servo's is rigid.
Result<void> add_reactions(Rig rig, const DriveSpec& drive, const Path& path,
                           double Instant<double>::*angle, Series& sum) {
  if (rig == Rig::servo || rig == Rig::specimen) return {};
  const auto seen = seen_by_the_law(drive, path);
  if (!seen) return tl::unexpected(seen.error());
  const auto returned = reactions_along(drive.torsion, path, *seen, angle);
  if (!returned) return tl::unexpected(returned.error());
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += (*returned)[i];
  return {};
}

// J1 theta_m'' + B1 theta_m' + tau_f + effects, and what the kinematics return.
Result<Series> motor_side(Rig rig, const DriveSpec& drive, const Path& path) {
  auto sum = effects_at({Site::motor}, drive, path);
  if (!sum) return sum;
  const auto done = add_reactions(rig, drive, path, &Instant<double>::motor_angle, *sum);
  if (!done) return tl::unexpected(done.error());
  for (std::size_t i = 0; i < path.size(); ++i) {
    const auto& x = path[i];
    (*sum)[i] += drive.motor_inertia * x.motor_acceleration + drive.motor_viscous * x.motor_speed +
                 drive.motor_coulomb * std::tanh(x.motor_speed / drive.coulomb_width);
  }
  return sum;
}

// J2 theta_l'' + B2 theta_l' + tau_L + effects.
// A servo's transmission is rigid: its effects oppose the motion of the load.
Result<Series> load_side(Rig rig, const DriveSpec& drive, const Path& path,
                         const Series& external) {
  auto sum = rig == Rig::servo ? effects_at({Site::load, Site::transmission}, drive, path)
                               : effects_at({Site::load}, drive, path);
  if (!sum) return sum;
  const auto done = add_reactions(rig, drive, path, &Instant<double>::load_angle, *sum);
  if (!done) return tl::unexpected(done.error());
  const double weight = drive.load_mass * drive.gravity * drive.arm_length;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const auto& x = path[i];
    (*sum)[i] += drive.load_inertia * x.load_acceleration + drive.load_viscous * x.load_speed +
                 weight * std::sin(x.load_angle) + (external.empty() ? 0.0 : external[i]);
  }
  return sum;
}

struct Needed {
  const Series* series;
  std::string_view name;
};

EquationResidual absent_without(std::initializer_list<Needed> needs, bool exists,
                                std::string_view rig) {
  EquationResidual residual;
  if (!exists) residual.absent = fmt::format("the {} rig has no such equation", rig);
  for (const Needed& one : needs) {
    if (residual.absent.empty() && one.series->empty()) {
      residual.absent = fmt::format("{} is not measured", one.name);
    }
  }
  return residual;
}

Result<void> same_lengths(const DriveChannels& c) {
  const std::initializer_list<Needed> all = {{&c.motor_angle, "motor_angle"},
                                             {&c.motor_speed, "motor_speed"},
                                             {&c.motor_acceleration, "motor_acceleration"},
                                             {&c.load_angle, "load_angle"},
                                             {&c.load_speed, "load_speed"},
                                             {&c.load_acceleration, "load_acceleration"},
                                             {&c.torsion, "torsion"},
                                             {&c.torsion_rate, "torsion_rate"},
                                             {&c.torsion_acceleration, "torsion_acceleration"},
                                             {&c.transmitted_torque, "transmitted_torque"},
                                             {&c.motor_torque, "motor_torque"},
                                             {&c.load_torque, "load_torque"}};
  for (const Needed& one : all) {
    if (one.series->empty() || one.series->size() == c.time.size()) continue;
    return failure(ErrorCode::bad_data,
                   fmt::format("the channel {} has {} samples, time has {}", one.name,
                               one.series->size(), c.time.size()),
                   "all channels are as long as time");
  }
  return {};
}

// left times factor - right, sample by sample.
Series difference(const Series& left, double factor, const Series& right) {
  Series out(left.size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = left[i] * factor - right[i];
  return out;
}

// Which equations the rig and its channels allow.
DriveResiduals formable(Rig rig, const DriveChannels& c) {
  const bool both = rig == Rig::free;
  const std::string_view name = name_of(rig);
  const Needed torque{&c.transmitted_torque, "transmitted_torque"};
  const Needed motor_torque{&c.motor_torque, "motor_torque"};
  const Needed motion = rig == Rig::specimen ? Needed{&c.torsion_rate, "torsion"}
                                             : Needed{&c.motor_acceleration, "motor_angle"};
  const Needed load_motion{&c.load_acceleration, "load_angle"};
  DriveResiduals r;
  r.motor = absent_without({torque, motor_torque, motion}, both || rig == Rig::locked, name);
  r.load = absent_without({torque, load_motion}, both, name);
  r.torsion =
      absent_without({torque, motion, both ? load_motion : motion}, rig != Rig::servo, name);
  r.drive = absent_without({motor_torque, motion, load_motion}, both || rig == Rig::servo, name);
  return r;
}

}  // namespace

Result<DriveResiduals> residuals(Rig rig, const DriveSpec& drive, const DriveChannels& c) {
  if (auto good = same_lengths(c); !good) return tl::unexpected(good.error());
  const Path path = path_of(rig, drive, c);
  const auto motor = motor_side(rig, drive, path);
  const auto load = load_side(rig, drive, path, c.load_torque);
  const auto law = torsion_law_along(rig, drive, path);
  for (const auto* side : {&motor, &load, &law}) {
    if (!*side) return tl::unexpected(side->error());
  }
  DriveResiduals r = formable(rig, c);
  const Series zero(path.size(), 0.0);
  if (r.motor.absent.empty()) {
    const Series given = difference(c.motor_torque, 1.0, *motor);
    r.motor.value =
        difference(given, 1.0, difference(c.transmitted_torque, 1.0 / drive.gear_ratio, zero));
  }
  if (r.load.absent.empty()) r.load.value = difference(c.transmitted_torque, 1.0, *load);
  if (r.torsion.absent.empty()) r.torsion.value = difference(c.transmitted_torque, 1.0, *law);
  if (r.drive.absent.empty()) {
    r.drive.value = difference(difference(c.motor_torque, 1.0, *motor), drive.gear_ratio, *load);
  }
  return r;
}

}  // namespace flexspline
