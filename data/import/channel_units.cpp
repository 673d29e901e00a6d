#include "import/channel_units.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "tables/unit_words.hpp"

namespace flexspline::data {
namespace {

using enum ColumnKind;

/// Rates of benches, Hz: a unit of time that gives another is none.
constexpr double kSlowestRate = 0.01;  // creep is recorded once in a minute
constexpr double kFastestRate = 50000.0;

bool is_mark(Quantity quantity) {
  return quantity == Quantity::valid || quantity == Quantity::drive_enabled;
}

}  // namespace

std::optional<Quantity> quantity_of(const ColumnMeaning& one, Rig rig) {
  using enum ColumnSide;
  switch (one.kind) {
    case angle:
      if (one.commanded) return Quantity::commanded_angle;
      if (rig == Rig::specimen)
        return one.side == motor ? std::nullopt : std::optional(Quantity::angle);
      if (one.side == load || (one.side == ColumnSide::unknown && rig == Rig::servo)) {
        return Quantity::load_angle;
      }
      return Quantity::motor_angle;
    case torque:
      if (one.commanded) return Quantity::commanded_torque;
      if (one.side == motor || rig == Rig::servo) return Quantity::motor_torque;
      return Quantity::transmitted_torque;
    case torsion:
      return Quantity::torsion;
    case displacement:
      return Quantity::displacement;
    case velocity:
      return rig == Rig::specimen ? std::optional(Quantity::velocity) : std::nullopt;
    case force:
      return Quantity::force;
    case current:
      return Quantity::current;
    case duty_cycle:
      return Quantity::duty_cycle;
    case voltage:
      return Quantity::supply_voltage;
    case temperature:
      return Quantity::temperature;
    case enabled:
      return Quantity::drive_enabled;
    case valid:
      return Quantity::valid;
    default:
      return std::nullopt;
  }
}

std::string_view usual_unit(const QuantityInfo& info) {
  switch (info.dimensions[0]) {
    case Dimension::angle:
      return "deg";
    case Dimension::torque:
      return "Nm";
    case Dimension::time:
      return "s";
    default:
      return "UNIT";
  }
}

void find_unit_of(Quantity quantity, const TableSurvey& table, std::size_t column,
                  ColumnRole& role) {
  const ColumnSurvey& survey = table.columns[column];
  if (is_mark(quantity) && survey.low >= 0.0 && survey.high <= 1.0) role.unit = find_unit("1");
  if (role.unit || !survey.column.unit.empty() || quantity != Quantity::time) return;
  const double step = usual_step(table, column);
  if (!(step > 0.0)) return;
  std::vector<Unit> fitting;
  for (const char* symbol : {"s", "ms", "us"}) {
    const Unit unit = *find_unit(symbol);
    const double rate = 1.0 / (unit.factor * step);
    if (rate >= kSlowestRate && rate <= kFastestRate) fitting.push_back(unit);
  }
  if (fitting.size() != 1) return;
  role.unit = fitting[0];
  role.certainty = std::max(role.certainty, Certainty::likely);
  role.evidence += fmt::format("; of s, ms and us only {} gives a bench's rate, {:.6g} Hz",
                               fitting[0].symbol, 1.0 / (fitting[0].factor * step));
}

}  // namespace flexspline::data
