#include "effect_pages.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "effect_picture.hpp"
#include "flexspline/core/write_file.hpp"
#include "flexspline/reports/draw_figures.hpp"
#include "flexspline/reports/equation.hpp"

namespace flexspline::app {
namespace {

constexpr std::string_view kOrigin =
    "<!-- Written by `flexspline list effects --pages docs/effects`; change the row, not this. -->";

std::string rigs_of(const std::vector<Rig>& rigs) {
  std::string list;
  for (const Rig rig : rigs) {
    list += fmt::format("{}{}", list.empty() ? "" : ", ", name_of(rig));
  }
  return list;
}

std::string memory_of(const EffectRow& row) {
  if (row.states == 0) return "none";
  return fmt::format("{} state{}{}", row.states, row.states == 1 ? "" : "s",
                     row.repeats ? " an element" : "");
}

std::string passivity_of(const EffectRow& row) {
  return row.passive ? "yes" : fmt::format("no: {}", row.active_because);
}

std::string sought_of(const EffectRow& row) {
  if (!sought_by_law(row)) return {};
  return fmt::format("| a diagnosis seeks it | by this law{} |\n",
                     row.sought_on.empty() ? "" : ", " + rigs_of(row.sought_on));
}

std::string facts(const EffectRow& row) {
  const auto yes = [](bool is) { return is ? "yes" : "no"; };
  return fmt::format(
      "| | |\n|---|---|\n"
      "| enters | {} |\n"
      "| organised in | {} |\n"
      "| rigs | {} |\n"
      "| memory | {} |\n"
      "| passive: makes no energy over a closed cycle | {} |\n"
      "| rate independent | {} |\n{}",
      site_in_words(row.site), row.coordinate, rigs_of(row.rigs), memory_of(row),
      passivity_of(row), yes(row.rate_independent), sought_of(row));
}

std::string parameter_table(const EffectRow& row) {
  std::string table = fmt::format(
      "| parameter | unit | from | to | nominal | nominal after |\n|---|---|---|---|---|---|\n");
  for (const EffectParameter& one : row.parameters) {
    table += fmt::format("| `{}` | {} | {:.6g} | {:.6g} | {:.6g} | {} |\n", one.name, one.unit,
                         one.lower, one.upper, one.nominal, one.source);
  }
  if (row.repeats) table += "\nThe parameters repeat, one group an element.\n";
  return table;
}

/// What a figure's file is called: letters, digits and dashes.
std::string picture_name(const EffectRow& row) {
  std::string name(row.id);
  std::ranges::replace(name, '_', '-');
  return name;
}

}  // namespace

std::string_view site_in_words(Site site) {
  switch (site) {
    case Site::motor:
      return "motor equation (5), Nm at the motor shaft, opposing the motor torque";
    case Site::load:
      return "load equation (6), Nm at the output, opposing the transmitted torque";
    case Site::transmission:
      return "torsion law (7), Nm at the output, part of the transmitted torque";
    case Site::kinematics:
      return "kinematics (8), rad at the output, part of the torsion";
    case Site::torque_signal:
      return "torque signal, Nm: measured minus true transmitted torque";
    case Site::motor_torque_signal:
      return "motor torque signal, Nm: recorded minus true motor torque";
    case Site::motor_angle_signal:
      return "motor angle signal, rad: measured minus true motor angle";
    case Site::load_angle_signal:
      return "load angle signal, rad: measured minus true load angle";
  }
  return "unknown";
}

std::string effect_text(const EffectRow& row, std::string_view equation) {
  return fmt::format(
      "# {}\n\n{}\n\n{}\n## Parameters\n\nSI. Nominal values are for a unit of 226 Nm and ratio "
      "50.\n\n{}\n## Range\n\nHolds for: {}.\n\nNot modelled: {}.\n\n## Source\n\n{}\n",
      row.id, equation, facts(row), parameter_table(row), row.range, row.not_modelled, row.source);
}

std::string effect_page(const EffectRow& row) {
  const std::string shown = fmt::format(
      "$$\n{}\n$$\n\n![the loop without and with it, and the difference](figures/{}.svg)",
      reports::tex_of(row.equation), picture_name(row));
  return fmt::format("{}\n{}", kOrigin, effect_text(row, shown));
}

std::string effect_index() {
  std::string text = fmt::format(
      "{}\n# Effects\n\nWhat a recording can show beyond the torsion law "
      "tau = f(phi) + g^-1(phi'/h(phi)) and the drive\nof Dhaouadi and Ghorbel (2003), eqs. "
      "(5)-(8). One page each.\n\n| effect | organised in | enters |\n|---|---|---|\n",
      kOrigin);
  for (const EffectRow& row : effects()) {
    text += fmt::format("| [{0}]({0}.md) | {1} | {2} |\n", row.id, row.coordinate,
                        site_in_words(row.site));
  }
  return text;
}

Result<void> check_effect_pages(const std::filesystem::path& folder) {
  std::vector<std::string> names = {"README.md"};
  for (const EffectRow& row : effects()) names.push_back(fmt::format("{}.md", row.id));
  for (const std::string& name : names) {
    const auto there = read_file(folder / name);
    if (!there || there->starts_with(kOrigin)) continue;
    return failure(ErrorCode::cannot_write,
                   fmt::format("{} is not a page of the catalogue", (folder / name).string()),
                   "choose another folder, or add --force to replace it");
  }
  return {};
}

Result<void> write_effect_pages(const std::filesystem::path& folder) {
  for (const EffectRow& row : effects()) {
    const auto path = folder / fmt::format("{}.md", row.id);
    if (auto done = write_file(path, effect_page(row)); !done) return done;
  }
  std::vector<reports::Figure> pictures;
  for (const EffectRow& row : effects()) {
    auto picture = picture_of(row);
    if (!picture) return tl::unexpected(in_context(picture.error(), std::string(row.id)));
    pictures.push_back(std::move(*picture));
  }
  if (auto done = reports::draw_figures(folder / "figures", pictures); !done) return done;
  return write_file(folder / "README.md", effect_index());
}

}  // namespace flexspline::app
