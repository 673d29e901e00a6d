#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "export/c_model.hpp"
#include "export/carrier.hpp"
#include "export/law_fits.hpp"
#include "flexspline/core/law.hpp"

namespace flexspline::data {
namespace {

constexpr int kPoints = 401;

/// A function on points, for a lookup table that is linear between them.
struct Table {
  std::string name;
  std::string argument;
  std::string value;
  std::vector<double> at;
  std::vector<double> values;
};

// Half the points even over the domain, half even in the logarithm, where a law may be steep.
std::vector<double> points_over(double domain) {
  std::vector<double> points = {0.0};
  for (int k = 1; k <= kPoints / 4; ++k) {
    const double even = domain * k / (kPoints / 4);
    const double steep = domain * std::pow(10.0, -5.0 * k / (kPoints / 4 + 1.0));
    for (double x : {even, -even, steep, -steep}) points.push_back(x);
  }
  std::ranges::sort(points);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

Result<Table> of_law(std::string name, std::string argument, std::string value,
                     const LawSpec& spec) {
  const auto law = make_law(spec);
  if (!law) return tl::unexpected(law.error());
  Table table{
      std::move(name), std::move(argument), std::move(value), points_over(domain_of(spec)), {}};
  for (double x : table.at) table.values.push_back((*law)->value(x));
  return table;
}

// Over 100 widths of its sign or 100 rad/s.
Table of_friction(const DriveSpec& d) {
  Table table{"motor_friction",
              "motor_speed_rad_s",
              "torque_nm",
              points_over(std::max(100.0, 100.0 * d.coulomb_width)),
              {}};
  for (double w : table.at) {
    double torque = d.motor_coulomb * std::tanh(w / d.coulomb_width) + d.motor_viscous * w;
    for (const EffectSpec& one : d.torsion.effects) {
      const auto& p = one.parameters;
      torque += p[0].second * std::tanh(w / p[2].second) + p[1].second * w;
    }
    table.values.push_back(torque);
  }
  return table;
}

Result<std::vector<Table>> tables_of(const RigModel& model) {
  const ModelSpec& laws = model.drive.torsion;
  std::vector<Table> tables;
  if (model.rig != Rig::servo) {
    const auto add = [&](Result<Table> table) -> Result<void> {
      if (!table) return tl::unexpected(table.error());
      tables.push_back(std::move(*table));
      return {};
    };
    if (auto d = add(of_law("f", "torsion_rad", "torque_nm", laws.f)); !d) {
      return tl::unexpected(d.error());
    }
    if (auto d = add(of_law("g_inverse", "rate_rad_s", "torque_nm", laws.g_inverse)); !d) {
      return tl::unexpected(d.error());
    }
    LawSpec h = laws.h;
    h.valid_to = domain_of(laws.f);
    if (auto d = add(of_law("h", "torsion_rad", "factor", h)); !d) return tl::unexpected(d.error());
  }
  if (model.rig != Rig::specimen) tables.push_back(of_friction(model.drive));
  return tables;
}

std::string csv_of(const Table& table, const ExportHead& head) {
  std::string text = commented(head, "# ") + "\n" + table.argument + "," + table.value + "\n";
  for (std::size_t k = 0; k < table.at.size(); ++k) {
    text += fmt::format("{},{}\n", table.at[k], table.values[k]);
  }
  return text;
}

std::string list_of(const std::vector<double>& values) {
  std::string text;
  for (std::size_t k = 0; k < values.size(); ++k) {
    text += fmt::format("{}{}", k == 0 ? "" : k % 6 == 0 ? ", ...\n    " : ", ", values[k]);
  }
  return text;
}

std::string matlab_of(const std::vector<Table>& tables, const RigModel& model,
                      const ExportHead& head) {
  std::string text = fmt::format(
      "function m = {}()\n% Lookup tables and constants of a harmonic drive, SI units. For "
      "Simulink's "
      "1-D Lookup\n% Table: breakpoints m.<name>.x, table data m.<name>.y, linear in between and "
      "beyond.\n% torque = f(torsion) + g_inverse(torsion_rate/h(torsion)), torsion = "
      "motor_angle/gear_ratio - load_angle.\n{}\n",
      head.name, commented(head, "% "));
  const DriveSpec& d = model.drive;
  for (const auto& [name, value] :
       {std::pair("gear_ratio", d.gear_ratio), std::pair("motor_inertia", d.motor_inertia),
        std::pair("load_inertia", d.load_inertia), std::pair("load_viscous", d.load_viscous),
        std::pair("weight", d.load_mass * d.gravity * d.arm_length)}) {
    text += fmt::format("m.{} = {};\n", name, value);
  }
  for (const Table& table : tables) {
    text += fmt::format("m.{0}.x = [{1}]; % {2}\nm.{0}.y = [{3}]; % {4}\n", table.name,
                        list_of(table.at), table.argument, list_of(table.values), table.value);
  }
  return text + "end\n";
}

Result<Carried> carry(const RigModel& model) {
  Carrier carrier(model);
  carrier.drop_instruments();
  carrier.drop_effects([&](const EffectRow& row, const EffectSpec& effect) {
    const bool in_table =
        row.id == "coulomb_viscous_friction" && !effect.across && model.rig != Rig::specimen;
    return std::string(in_table ? "" : "a table of one variable cannot hold it");
  });
  return std::move(carrier).done();
}

Result<std::vector<ExportedFile>> write(const RigModel& model, const ExportHead& head) {
  const auto tables = tables_of(model);
  if (!tables) return tl::unexpected(tables.error());
  std::vector<ExportedFile> files = {{head.name + ".m", matlab_of(*tables, model, head)}};
  for (const Table& table : *tables) {
    files.push_back({fmt::format("{}_{}.csv", head.name, table.name), csv_of(table, head)});
  }
  return files;
}

}  // namespace

ExporterRow describe_table() {
  return {.id = "table",
          .says = "lookup tables for Simulink and others: a .m function and one CSV a table",
          .carries = "f, g^-1 and h at 401 points, the motor's friction over its speed, constants",
          .not_carried = "effects other than viscous and dry friction of the motor",
          .carry = carry,
          .write = write};
}

}  // namespace flexspline::data
