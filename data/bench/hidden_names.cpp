#include <algorithm>
#include <array>
#include <string>

#include <fmt/format.h>

#include "flexspline/data/hidden_bench.hpp"

namespace flexspline::data {

std::string_view name_of(HiddenEquation equation) {
  switch (equation) {
    case HiddenEquation::torsion:
      return "torsion";
    case HiddenEquation::load:
      return "load";
    case HiddenEquation::motor:
      return "motor";
    case HiddenEquation::drive:
      break;
  }
  return "drive";
}

std::string_view name_of(HiddenMotion motion) {
  switch (motion) {
    case HiddenMotion::sine:
      return "sine";
    case HiddenMotion::multisine:
      return "multisine";
    case HiddenMotion::ramp:
      return "ramp";
    case HiddenMotion::step_hold:
      return "step_hold";
    case HiddenMotion::staircase:
      break;
  }
  return "staircase";
}

std::span<const BenchKind> bench_kinds() {
  static const std::array<BenchKind, 5> kinds = {BenchKind(Rig::locked), BenchKind(Rig::free),
                                                 BenchKind(Rig::specimen), BenchKind(Rig::servo),
                                                 BenchKind(Rig::specimen, true)};
  return kinds;
}

std::string_view name_of(BenchKind kind) { return kind.travels ? "joint" : name_of(kind.rig); }

std::optional<BenchKind> find_bench_kind(std::string_view name) {
  for (const BenchKind kind : bench_kinds()) {
    if (name_of(kind) == name) return kind;
  }
  return std::nullopt;
}

HiddenClass hidden_class(std::string_view id) {
  if (id.starts_with("unknown")) return HiddenClass::unknown;
  if (id.starts_with("incident:")) return HiddenClass::incident;
  return id.starts_with("variant:") ? HiddenClass::variant : HiddenClass::named;
}

bool HiddenRow::shows_on(BenchKind kind) const {
  return kind.travels ? joint : std::ranges::find(rigs, kind.rig) != rigs.end();
}

HiddenEquation hidden_equation(HiddenSite site, Rig rig) {
  if (rig == Rig::servo) return HiddenEquation::drive;
  if (site == HiddenSite::motor_sensor) return HiddenEquation::motor;
  if (site == HiddenSite::motor && rig != Rig::specimen) return HiddenEquation::motor;
  if (site == HiddenSite::load && rig == Rig::free) return HiddenEquation::load;
  return HiddenEquation::torsion;
}

namespace {

template <class Row>
Result<const Row*> find_row(std::span<const Row> rows, std::string_view id, std::string_view what,
                            std::string_view cannot) {
  std::string known;
  for (const Row& row : rows) {
    if (row.id == id) return &row;
    known += (known.empty() ? "" : ", ") + std::string(row.id);
  }
  return failure(ErrorCode::usage, fmt::format("{} \"{}\" cannot be {}", what, id, cannot),
                 "choose one of " + known);
}

}  // namespace

Result<const HiddenRow*> find_hidden_effect(std::string_view id) {
  return find_row(hidden_effects(), id, "effect", "concealed");
}

Result<const DisturbanceRow*> find_disturbance(std::string_view id) {
  return find_row(disturbances(), id, "disturbance", "applied");
}

}  // namespace flexspline::data
