#include "import/join_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "import/channel_units.hpp"
#include "import/column_roles.hpp"

namespace flexspline::data {
namespace {

constexpr double kGap = 2.5;  // usual steps
constexpr double kSameInstant = 1e-6;
constexpr double kFewestRows = 16.0;

struct Clock {
  std::size_t column = 0;
  double unit_s = 1.0;
};

std::optional<Clock> clock_of(const TableSurvey& table) {
  std::vector<ColumnRole> roles = column_roles(table);
  const auto column = find_time(table, roles);
  if (!column) return std::nullopt;
  find_unit_of(Quantity::time, table, *column, roles[*column]);
  const auto& unit = roles[*column].unit;
  if (!unit || unit->dimension != Dimension::time) return std::nullopt;
  return Clock{*column, unit->factor};
}

double step_s(const TableSurvey& table, const Clock& clock) {
  return clock.unit_s * usual_step(table, clock.column);
}

Result<Clock> joinable(const TableSurvey& table) {
  const auto clock = clock_of(table);
  if (!clock) return failure(ErrorCode::bad_data, table.words() + " has no time of a known unit");
  const ColumnSurvey& time = table.columns[clock->column];
  if (time.falls > 0 || time.repeats > 0) {
    return failure(ErrorCode::bad_data, table.words() + ": its time falls or repeats");
  }
  return *clock;
}

/// Names that are in several of the tables.
std::map<std::string, int> name_counts(const std::vector<const TableSurvey*>& tables) {
  std::map<std::string, int> counts;
  for (const TableSurvey* table : tables) {
    for (const ColumnSurvey& one : table->columns) ++counts[one.column.name];
  }
  return counts;
}

class Joining {
 public:
  Joining(std::vector<std::pair<const TableSurvey*, Clock>> tables,
          std::map<std::string, int> counts)
      : tables_(std::move(tables)), counts_(std::move(counts)) {}

  Result<TableSurvey> join() {
    const auto& [first, clock] = tables_.front();
    joined_ = *first;
    joined_.columns.clear();
    joined_.notes.clear();
    joined_.path.clear();
    low_ = first->columns[clock.column].first;
    high_ = first->columns[clock.column].last;
    for (const auto& [table, its_clock] : tables_) add(*table, its_clock);
    if (!((high_ - low_) >= (kFewestRows - 1.0) * usual_step(*first, clock.column))) {
      return failure(
          ErrorCode::bad_data,
          joined_.words() + ": fewer than 16 rows of the slowest lie where all have samples");
    }
    return std::move(joined_);
  }

 private:
  void add(const TableSurvey& table, const Clock& clock) {
    const auto& [first, first_clock] = tables_.front();
    const double epoch = epoch_of(table, clock) - epoch_of(*first, first_clock);
    TablePart part{table.index,
                   clock.column,
                   clock.unit_s / first_clock.unit_s,
                   epoch / first_clock.unit_s,
                   0.0,
                   {}};
    part.longest_step = kGap * part.clock_factor * usual_step(table, clock.column);
    const ColumnSurvey& time = table.columns[clock.column];
    low_ = std::max(low_, part.clock_factor * time.first + part.clock_offset);
    high_ = std::min(high_, part.clock_factor * time.last + part.clock_offset);
    if (&table == first) add_column(table, part, clock.column);
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      if (i != clock.column) add_column(table, part, i);
    }
    joined_.path += (joined_.path.empty() ? "" : " + ") + table.path;
    joined_.parts.push_back(std::move(part));
  }

  static double epoch_of(const TableSurvey& table, const Clock& clock) {
    return table.columns[clock.column].column.epoch_s.value_or(0.0);
  }

  void add_column(const TableSurvey& table, TablePart& part, std::size_t column) {
    part.columns.push_back(column);
    ColumnSurvey one = table.columns[column];
    if (column != part.clock && counts_[one.column.name] > 1) {
      one.column.name = table.path + "/" + one.column.name;
    }
    if (&table != tables_.front().first) {
      one.present = joined_.rows - std::min(joined_.rows, table.rows - one.present);
      one.sample = at_samples_of_first(table, part, column);
    }
    joined_.columns.push_back(std::move(one));
  }

  std::vector<double> at_samples_of_first(const TableSurvey& table, const TablePart& part,
                                          std::size_t column) const {
    std::vector<double> clock = table.columns[part.clock].sample;
    for (double& t : clock) t = part.clock_factor * t + part.clock_offset;
    const double longest = part.longest_step * static_cast<double>(table.stride);
    std::vector<double> values;
    std::size_t next = 0;
    for (const double t : tables_.front().first->columns[tables_.front().second.column].sample) {
      while (next < clock.size() && !(clock[next] > t)) ++next;
      values.push_back(value_between(clock, table.columns[column].sample, next, t, longest).value);
    }
    return values;
  }

  std::vector<std::pair<const TableSurvey*, Clock>> tables_;  ///< the slowest first
  std::map<std::string, int> counts_;
  TableSurvey joined_;
  double low_ = 0.0;
  double high_ = 0.0;
};

}  // namespace

std::optional<double> rate_of(const TableSurvey& table) {
  const auto clock = clock_of(table);
  const double step = clock ? step_s(table, *clock) : 0.0;
  return step > 0.0 ? std::optional(1.0 / step) : std::nullopt;
}

Between value_between(const std::vector<double>& x, const std::vector<double>& y, std::size_t next,
                      double at, double longest) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  if (next > 0) {
    const double step = next < x.size() ? x[next] - x[next - 1] : longest;
    if (at - x[next - 1] <= kSameInstant * step) return {y[next - 1], true};
  }
  if (next == x.size()) return {kNone, false};
  if (next == 0) {
    return x[0] - at <= kSameInstant * longest ? Between{y[0], true} : Between{kNone, false};
  }
  const double step = x[next] - x[next - 1];
  if (x[next] - at <= kSameInstant * step) return {y[next], true};
  if (step > longest) return {kNone, false};
  return {std::lerp(y[next - 1], y[next], (at - x[next - 1]) / step), false};
}

Result<TableSurvey> join_tables(const std::vector<const TableSurvey*>& tables) {
  std::vector<std::pair<const TableSurvey*, Clock>> timed;
  for (const TableSurvey* table : tables) {
    const auto clock = joinable(*table);
    if (!clock) return tl::unexpected(clock.error());
    timed.emplace_back(table, *clock);
  }
  std::ranges::stable_sort(timed, [](const auto& a, const auto& b) {
    return step_s(*a.first, a.second) > step_s(*b.first, b.second);
  });
  return Joining(std::move(timed), name_counts(tables)).join();
}

}  // namespace flexspline::data
