#include "import/column_roles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "readers/cell_text.hpp"
#include "tables/unit_words.hpp"

namespace flexspline::data {
namespace {

constexpr double kOneMotion = 0.99;  // of the variance: two columns are one motion
constexpr double kOtherSide = 4.0;   // the least ratio by which sides are told apart
constexpr double kEvenSteps = 0.2;   // of the usual step

ColumnRole role_of(const ColumnSurvey& one) {
  ColumnRole role;
  role.meaning = meaning_of_name(one.column.name);
  role.unit = unit_of_word(one.column.unit);
  ColumnMeaning& meaning = role.meaning;
  if (one.column.clock) {
    meaning = {ColumnKind::time, ColumnSide::unknown, false};
    role.evidence = "marked as time by the file";
  } else if (meaning.kind == ColumnKind::unknown && role.unit) {
    meaning.kind = kind_of(role.unit->dimension);
    role.certainty = Certainty::likely;
    role.evidence = "by its unit alone";
  } else if (meaning.kind != ColumnKind::unknown) {
    role.evidence = "by its name";
    if (role.unit && !may_have(meaning.kind, role.unit->dimension)) {
      meaning.kind = kind_of(role.unit->dimension);
      role.certainty = Certainty::likely;
      role.evidence = "by its unit, against its name";
    } else if (role.unit) {
      role.evidence = "by its name and unit";
    }
  }
  return role;
}

bool is_plain_angle(const ColumnRole& role, const ColumnSurvey& survey) {
  return role.meaning.kind == ColumnKind::angle && !role.meaning.commanded && survey.moves();
}

/// Two angles of which at least one has no side.
void tell_sides(const TableSurvey& table, std::vector<ColumnRole>& roles) {
  std::vector<std::size_t> angles;
  for (std::size_t i = 0; i < roles.size(); ++i) {
    if (is_plain_angle(roles[i], table.columns[i])) angles.push_back(i);
  }
  if (angles.size() != 2) return;
  auto [a, b] = std::pair(angles[0], angles[1]);
  const auto range = [&](std::size_t i) {
    const double unit = roles[i].unit ? roles[i].unit->factor : 1.0;
    return unit * (table.columns[i].high - table.columns[i].low);
  };
  if (range(a) < range(b)) std::swap(a, b);
  const double ratio = range(a) / range(b);
  const SlopeFit fit = fit_slope(table.columns[b].sample, table.columns[a].sample);
  if (ratio < kOtherSide || fit.explained < kOneMotion) return;
  const auto take = [&](std::size_t i, ColumnSide side, std::string evidence) {
    if (roles[i].meaning.side != ColumnSide::unknown) return;
    roles[i].meaning.side = side;
    roles[i].certainty = Certainty::likely;
    roles[i].evidence += std::move(evidence);
  };
  take(a, ColumnSide::motor,
       fmt::format(", and it turns {:.4g} times as far as the other angle", ratio));
  take(b, ColumnSide::load, fmt::format(", and the other angle turns {:.4g} times as far", ratio));
}

/// Steps that hardly differ: a clock, or a counter.
bool rises_evenly(const TableSurvey& table, std::size_t column) {
  const ColumnSurvey& one = table.columns[column];
  if (one.falls > 0 || one.repeats > 0 || one.present != table.rows || one.sample.size() < 16) {
    return false;
  }
  const double usual = usual_step(table, column) * static_cast<double>(table.stride);
  for (std::size_t i = 1; i < one.sample.size(); ++i) {
    if (std::abs(one.sample[i] - one.sample[i - 1] - usual) > kEvenSteps * usual) return false;
  }
  return usual > 0.0;
}

}  // namespace

SlopeFit fit_slope(const std::vector<double>& x, const std::vector<double>& y) {
  double n = 0.0, mean_x = 0.0, mean_y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
  for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i) {
    if (!std::isfinite(x[i]) || !std::isfinite(y[i])) continue;
    n += 1.0;
    const double dx = x[i] - mean_x;
    const double dy = y[i] - mean_y;
    mean_x += dx / n, mean_y += dy / n;
    xx += dx * (x[i] - mean_x), xy += dx * (y[i] - mean_y), yy += dy * (y[i] - mean_y);
  }
  if (!(xx > 0.0) || !(yy > 0.0)) return {};
  return {xy / xx, xy * xy / (xx * yy)};
}

std::vector<ColumnRole> column_roles(const TableSurvey& table) {
  std::vector<ColumnRole> roles;
  for (const ColumnSurvey& one : table.columns) roles.push_back(role_of(one));
  tell_sides(table, roles);
  return roles;
}

std::optional<std::size_t> find_time(const TableSurvey& table, std::vector<ColumnRole>& roles) {
  std::optional<std::size_t> best;
  const auto is_time = [&](std::size_t i) {
    return roles[i].meaning.kind == ColumnKind::time && !roles[i].meaning.commanded &&
           table.columns[i].moves();
  };
  for (std::size_t i = 0; i < roles.size(); ++i) {
    if (!is_time(i)) continue;
    const auto rises = [&](std::size_t k) {
      const ColumnSurvey& one = table.columns[k];
      return one.present - std::min(one.present, one.repeats + one.falls);
    };
    if (!best || rises(i) > rises(*best)) best = i;
  }
  if (best) return best;
  std::vector<std::size_t> even;
  for (std::size_t i = 0; i < roles.size(); ++i) {
    if (roles[i].meaning.kind == ColumnKind::unknown && rises_evenly(table, i)) even.push_back(i);
  }
  if (even.size() != 1) return std::nullopt;
  ColumnRole& role = roles[even[0]];
  role.meaning.kind = ColumnKind::time;
  role.certainty = Certainty::likely;
  role.evidence = fmt::format("the only column that rises by even steps, of {:.6g}",
                              usual_step(table, even[0]));
  return even[0];
}

std::string column_in_words(const TableSurvey& table, std::size_t column) {
  const TableColumn& one = table.columns[column].column;
  return fmt::format("column {} '{}'{}", column + 1, shown(one.name),
                     one.unit.empty() ? "" : fmt::format(" [{}]", shown(one.unit)));
}

std::string columns_in_words(const TableSurvey& table) {
  std::string words;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    words += (i > 0 ? ", " : "") + column_in_words(table, i);
  }
  return words;
}

}  // namespace flexspline::data
