#include "import/find_rig.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace flexspline::data {
namespace {

constexpr double kMostRatio = 400.0;  // of a gear; what moves less is held
constexpr double kFollows = 0.99;     // of the motor's variance
constexpr double kWhole = 3e-3;       // ratios are whole numbers of teeth over two

using enum ColumnKind;

/// What is there, by role or by choice.
class Presence {
 public:
  Presence(const TableSurvey& table, const std::vector<ColumnRole>& roles,
           const std::vector<ColumnChoice>& choices)
      : table_(table), roles_(roles), choices_(choices) {}

  bool has(Quantity quantity, ColumnKind kind, ColumnSide side) const {
    return chosen(quantity) || find(kind, side) != nullptr;
  }
  const ColumnSurvey* find(ColumnKind kind, ColumnSide side) const {
    for (std::size_t i = 0; i < roles_.size(); ++i) {
      const ColumnMeaning& one = roles_[i].meaning;
      if (one.kind == kind && one.side == side && !one.commanded && table_.columns[i].moves()) {
        return &table_.columns[i];
      }
    }
    return nullptr;
  }
  bool chosen(Quantity quantity) const {
    return std::ranges::any_of(choices_, [&](const ColumnChoice& one) {
      return one.quantity == quantity && !one.column.empty();
    });
  }

 private:
  const TableSurvey& table_;
  const std::vector<ColumnRole>& roles_;
  const std::vector<ColumnChoice>& choices_;
};

bool load_moves(const Presence& there) {
  if (there.chosen(Quantity::load_angle)) return true;
  const ColumnSurvey* load = there.find(angle, ColumnSide::load);
  const ColumnSurvey* motor = there.find(angle, ColumnSide::motor);
  if (load == nullptr || motor == nullptr) return load != nullptr;
  const SlopeFit fit = fit_slope(load->sample, motor->sample);
  return fit.explained > kFollows && std::abs(fit.slope) < kMostRatio;
}

}  // namespace

std::optional<RigGuess> find_rig_of(const TableSurvey& table, const std::vector<ColumnRole>& roles,
                                    const std::vector<ColumnChoice>& choices) {
  const Presence there(table, roles, choices);
  const bool motor_turns = there.has(Quantity::motor_angle, angle, ColumnSide::motor);
  const bool transmitted = there.has(Quantity::transmitted_torque, torque, ColumnSide::load) ||
                           there.find(torque, ColumnSide::unknown) != nullptr ||
                           there.chosen(Quantity::torque);
  const bool driven = there.has(Quantity::motor_torque, torque, ColumnSide::motor);
  const bool fed = there.has(Quantity::current, current, ColumnSide::unknown) ||
                   there.has(Quantity::current, current, ColumnSide::motor) ||
                   there.has(Quantity::duty_cycle, duty_cycle, ColumnSide::unknown);
  const bool moved = there.has(Quantity::torsion, torsion, ColumnSide::unknown) ||
                     there.has(Quantity::torsion, torsion, ColumnSide::load) ||
                     there.has(Quantity::displacement, displacement, ColumnSide::unknown) ||
                     there.chosen(Quantity::angle);
  const bool forced = there.has(Quantity::force, force, ColumnSide::unknown);
  if (moved && !motor_turns && (transmitted || forced)) {
    return RigGuess{Rig::specimen, "a force or torque over an imposed motion"};
  }
  const bool load_turns = load_moves(there);
  if (motor_turns && load_turns && driven) {
    return RigGuess{Rig::free, "both angles move, and the motor's torque is there"};
  }
  if (motor_turns && !load_turns && transmitted) {
    return RigGuess{Rig::locked, "the motor turns under a torque, and no output turns with it"};
  }
  if (!motor_turns && load_turns && (driven || fed)) {
    return RigGuess{Rig::servo, "one angle, of the output, and what drives it"};
  }
  return std::nullopt;
}

std::optional<RatioGuess> find_ratio(const TableSurvey& table, std::size_t motor, double motor_unit,
                                     std::size_t load, double load_unit) {
  const SlopeFit fit = fit_slope(table.columns[load].sample, table.columns[motor].sample);
  const double found = fit.slope * motor_unit / load_unit;
  if (fit.explained < kFollows || !(std::abs(found) >= 1.0)) return std::nullopt;
  const double whole = std::round(found);
  const bool near = std::abs(found - whole) <= kWhole * std::abs(found);
  return RatioGuess{near ? whole : found,
                    fmt::format("{:.6g} found from the two angles{}", std::abs(found),
                                near ? ", the nearest whole number taken" : "")};
}

}  // namespace flexspline::data
