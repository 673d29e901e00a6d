#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "flexspline/reports/table.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
}

/// A text that a spreadsheet would compute, or run, stays a text behind an apostrophe.
std::string csv_field(std::string text) {
  if (text.size() > 1 && std::string_view("=+-@\t\r").find(text[0]) != std::string_view::npos) {
    text.insert(text.begin(), '\'');
  }
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  replace_all(text, "\"", "\"\"");
  return "\"" + text + "\"";
}

std::string csv_cell(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return csv_field(*text);
  const double value = std::get<double>(cell);
  return std::isfinite(value) ? fmt::format("{}", value) : std::string{};
}

std::string markdown_text(std::string text) {
  replace_all(text, "\\", "\\\\");
  replace_all(text, "|", "\\|");
  replace_all(text, "<", "&lt;");
  replace_all(text, "\n", " ");
  return text;
}

std::string latex_text(const std::string& text) {
  static const std::array<std::pair<char, const char*>, 10> special = {
      {{'\\', "\\textbackslash{}"},
       {'&', "\\&"},
       {'%', "\\%"},
       {'$', "\\$"},
       {'#', "\\#"},
       {'_', "\\_"},
       {'{', "\\{"},
       {'}', "\\}"},
       {'~', "\\textasciitilde{}"},
       {'^', "\\textasciicircum{}"}}};
  std::string escaped;
  for (const char letter : text) {
    const auto found = std::find_if(special.begin(), special.end(),
                                    [&](const auto& pair) { return pair.first == letter; });
    if (found == special.end()) {
      escaped += letter;
    } else {
      escaped += found->second;
    }
  }
  static const std::array<std::pair<const char*, const char*>, 9> symbols = {
      {{"⁻¹", "$^{-1}$"},
       {"²", "$^{2}$"},
       {"φ", "$\\varphi$"},
       {"τ", "$\\tau$"},
       {"θ", "$\\theta$"},
       {"×", "$\\times$"},
       {"±", "$\\pm$"},
       {"–", "--"},
       {"°", "$^{\\circ}$"}}};
  for (const auto& [from, to] : symbols) replace_all(escaped, from, to);
  return escaped;
}

template <class Escape>
std::string row_text(const Table& table, const std::vector<Cell>& row, std::string_view between,
                     Escape escape) {
  std::string line;
  for (std::size_t i = 0; i < row.size() && i < table.columns.size(); ++i) {
    if (i > 0) line += between;
    line += escape(shown(row[i], table.columns[i]));
  }
  return line;
}

}  // namespace

bool is_numeric(const Table& table, std::size_t column) {
  return std::any_of(table.rows.begin(), table.rows.end(), [&](const auto& row) {
    return column < row.size() && std::holds_alternative<double>(row[column]);
  });
}

Table without_empty_columns(Table table) {
  const auto is_absent = [](const Cell& cell) {
    const auto* number = std::get_if<double>(&cell);
    return number != nullptr && !std::isfinite(*number);
  };
  for (std::size_t i = table.columns.size(); i-- > 0;) {
    const bool empty = std::all_of(table.rows.begin(), table.rows.end(),
                                   [&](const auto& row) { return is_absent(row[i]); });
    if (!empty) continue;
    const auto at = static_cast<std::ptrdiff_t>(i);
    table.columns.erase(table.columns.begin() + at);
    for (auto& row : table.rows) row.erase(row.begin() + at);
  }
  return table;
}

Column errors_of_signal(std::string name) { return {std::move(name), "%", 2, 100.0}; }

std::string shown(const Cell& cell, const Column& column) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  const double value = std::get<double>(cell);
  if (value > column.most) return "diverged";
  return column.digits == 0 ? compact(value, 6) : digits(value, column.digits);
}

std::string csv_of(const Table& table) {
  std::string text;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const Column& column = table.columns[i];
    if (i > 0) text += ',';
    text += csv_field(column.unit.empty() ? column.name : column.name + " / " + column.unit);
  }
  text += '\n';
  for (const auto& row : table.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i > 0) text += ',';
      text += csv_cell(row[i]);
    }
    text += '\n';
  }
  return text;
}

std::string markdown_of(const Table& table) {
  std::string names = "|", rule = "|", units = "|";
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    names += fmt::format(" {} |", markdown_text(table.columns[i].name));
    rule += is_numeric(table, i) ? " ---: |" : " --- |";
    units += fmt::format(" {} |", markdown_text(table.columns[i].unit));
  }
  std::string text = names + "\n" + rule + "\n" + units + "\n";
  for (const auto& row : table.rows) {
    text += "| " + row_text(table, row, " | ", markdown_text) + " |\n";
  }
  return text + "\n" + markdown_text(table.caption) + "\n";
}

std::string latex_of(const Table& table) {
  std::string layout, names, units;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    layout += is_numeric(table, i) ? 'r' : 'l';
    const std::string between = i > 0 ? " & " : "";
    names += between + latex_text(table.columns[i].name);
    units += between + latex_text(table.columns[i].unit);
  }
  std::string text = "\\begin{table}\n\\caption{" + latex_text(table.caption) +
                     "}\n\\label{tab:" + table.id + "}\n\\begin{tabular}{" + layout +
                     "}\n\\toprule\n" + names + " \\\\\n" + units + " \\\\\n\\midrule\n";
  for (const auto& row : table.rows) {
    text += row_text(table, row, " & ", latex_text) + " \\\\\n";
  }
  return text + "\\bottomrule\n\\end{tabular}\n\\end{table}\n";
}

}  // namespace flexspline::reports
