#include "answers/kind_parts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include <fmt/format.h>

#include "comparison/middle_of.hpp"

namespace flexspline::studies {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::set<double> places_of(const Gathered& gathered) {
  std::set<double> places;
  for (const auto& [name, line] : gathered) {
    for (const auto& [place, values] : line) places.insert(place);
  }
  return places;
}

}  // namespace

double sweep_position(const SweepAxis& sweep, std::size_t point) {
  const SweepValue& value = sweep.points.at(point).front();
  if (const auto* number = std::get_if<double>(&value)) return *number;
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  return static_cast<double>(point);
}

std::string sweep_label(const SweepAxis& sweep) {
  const SweepKey& key = sweep.keys.front();
  return key.unit.empty() ? key.path : key.path + " / " + key.unit;
}

AnswerPanel lines_of(const Gathered& gathered, const std::string& x_label,
                     const std::string& y_label) {
  AnswerPanel panel;
  panel.x_label = x_label;
  panel.y_label = y_label;
  const std::set<double> places = places_of(gathered);
  panel.x_log =
      !places.empty() && *places.begin() > 0.0 && *places.rbegin() > 10.0 * *places.begin();
  double least = std::numeric_limits<double>::infinity();
  double most = 0.0;
  for (const auto& [name, line] : gathered) {
    AnswerSeries series;
    series.name = name;
    for (const auto& [place, values] : line) {
      const double median = middle_of(values);
      if (std::isnan(median)) continue;
      series.x.push_back(place);
      series.y.push_back(median);
      least = std::min(least, median);
      most = std::max(most, median);
    }
    panel.series.push_back(std::move(series));
  }
  panel.y_log = least > 0.0 && most > 10.0 * least;
  return panel;
}

AnswerTable table_of(const std::string& id, const std::string& caption, const Gathered& gathered,
                     const std::string& x_name) {
  AnswerTable table{id, caption, {x_name}, {}};
  for (const auto& [name, line] : gathered) table.columns.push_back(name);
  for (const double place : places_of(gathered)) {
    std::vector<std::variant<std::string, double>> row = {place};
    for (const auto& [name, line] : gathered) {
      const auto at = line.find(place);
      row.emplace_back(at == line.end() ? kNaN : middle_of(at->second));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

AnswerPanel loop_cells(const std::string& title, const std::vector<Loop>& loops,
                       const std::vector<double>& values) {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  std::set<double> amplitudes;
  std::set<double> frequencies;
  for (const Loop& loop : loops) {
    amplitudes.insert(loop.amplitude);
    frequencies.insert(loop.frequency_hz);
  }
  AnswerPanel panel;
  panel.title = title;
  panel.x_label = "frequency / Hz";
  panel.y_label = "amplitude / deg";
  for (const double f : frequencies) panel.x_names.push_back(fmt::format("{:g}", f));
  for (const double a : amplitudes) panel.y_names.push_back(fmt::format("{:.3g}", kDegrees * a));
  panel.cells.assign(amplitudes.size(), std::vector<double>(frequencies.size(), kNaN));
  for (std::size_t k = 0; k < loops.size(); ++k) {
    const auto a = std::distance(amplitudes.begin(), amplitudes.find(loops[k].amplitude));
    const auto f = std::distance(frequencies.begin(), frequencies.find(loops[k].frequency_hz));
    panel.cells[static_cast<std::size_t>(a)][static_cast<std::size_t>(f)] = values[k];
  }
  return panel;
}

double residuals_of(const CasePlan& one, const CaseRow& row) {
  const auto& given = one.estimator->options.numbers;
  const auto most = given.find("samples");
  return std::min(row.number("samples"), static_cast<double>(one.train.size()) *
                                             (most == given.end() ? 3000.0 : most->second));
}

std::string extremes_sentence(const Gathered& gathered, const std::string& axis) {
  std::string text;
  for (const auto& [name, line] : gathered) {
    double low = kNaN, high = kNaN, at_low = kNaN, at_high = kNaN;
    for (const auto& [place, values] : line) {
      const double median = middle_of(values);
      if (std::isnan(median)) continue;
      if (!(low <= median)) low = median, at_low = place;
      if (!(high >= median)) high = median, at_high = place;
    }
    if (std::isnan(low)) continue;
    text += fmt::format("{}{}: from {:.2g} % of peak at {} = {:.3g} to {:.2g} % at {:.3g}",
                        text.empty() ? "" : "; ", name, low, axis, at_low, high, at_high);
  }
  return text.empty() ? "No case has held-out recordings." : text + ".";
}

}  // namespace flexspline::studies
