#include "tables/mat_tables.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace flexspline::data {
namespace {

constexpr std::size_t kMostAcross = 64;
constexpr std::size_t kMostNotes = 32;

std::string joined(const std::string& path, const std::string& name) {
  return path.empty() ? name : path + "/" + name;
}

/// Of a timeseries, DataInfo.Units or Units; of a channel, Unit.
std::string unit_of(const MatVariable& from, std::size_t element) {
  if (const auto unit = from.any_field({"Unit", "Units"}, element)) return unit.text();
  if (const auto info = from.any_field({"DataInfo"}, element)) {
    if (const auto unit = info.any_field({"Units"})) return unit.text();
  }
  return {};
}

std::string text_of(const MatVariable& from, std::string_view name, std::size_t element) {
  const auto field = from.any_field({name}, element);
  return field ? field.text() : std::string();
}

bool is_long(const MatVariable& variable) { return variable && variable.is_vector(); }

}  // namespace

void MatTable::add(TableColumn column, std::vector<double> values) {
  head.columns.push_back(std::move(column));
  columns.push_back(std::move(values));
}

void MatTables::note(std::string text) {
  if (notes_.size() < kMostNotes) notes_.push_back(std::move(text));
}

/// Columns of one length at one place are one table.
MatTable& MatTables::table(const std::string& path, std::size_t rows) {
  for (MatTable& one : tables_) {
    const bool same = one.head.path == path && one.columns[0].size() == rows;
    if (same && one.columns.size() < limits_.columns) return one;
  }
  tables_.push_back({});
  tables_.back().head.path = path;
  return tables_.back();
}

void MatTables::take(const MatVariable& variable) {
  const std::string name = variable.name();
  if (variable.is_struct()) {
    for (std::size_t e = 0; e < std::min(variable.elements(), limits_.tables); ++e) {
      take_struct(variable, e, variable.elements() > 1 ? fmt::format("{}({})", name, e + 1) : name,
                  1);
    }
  } else if (is_long(variable)) {
    auto values = variable.values();
    table("", values.size()).add({name, ""}, std::move(values));
  } else if (variable.is_numeric()) {
    take_matrix(variable, name);
  } else if (variable.text().empty()) {
    note(fmt::format(
        "variable '{}' is of a class that is not read; save its parts as arrays or a struct",
        name));
  }
}

void MatTables::take_matrix(const MatVariable& matrix, const std::string& path) {
  if (matrix.rows() < 2 || matrix.columns() < 2 || matrix.columns() > kMostAcross) return;
  MatTable& to = table(path, matrix.rows());
  for (std::size_t k = 0; k < matrix.columns(); ++k) {
    to.add({fmt::format("{}(:,{})", path.substr(path.rfind('/') + 1), k + 1), ""},
           matrix.column(k));
  }
}

void MatTables::take_struct(const MatVariable& from, std::size_t element, const std::string& path,
                            std::size_t depth) {
  if (depth > limits_.depth) {
    note(fmt::format("'{}' lies deeper than {} structs", path, limits_.depth));
  } else if (!take_dspace(from, element, path) && !take_simulink(from, element, path) &&
             !take_series(from, element, path)) {
    take_fields(from, element, path, depth);
  }
}

/// A timeseries saved as a struct. Its table is called after what holds it, so that several of one
/// time lie side by side.
bool MatTables::take_series(const MatVariable& from, std::size_t element, const std::string& path) {
  const auto time = from.any_field({"Time"}, element);
  const auto data = from.any_field({"Data"}, element);
  if (!is_long(time) || !data || !data.is_numeric()) return false;
  const std::vector<double> clock = time.values();
  const auto slash = path.rfind('/');
  const std::string owner = slash == path.npos ? "" : path.substr(0, slash);
  const std::string given = text_of(from, "Name", element);
  const std::string name = given.empty() ? path.substr(slash == path.npos ? 0 : slash + 1) : given;
  const bool along = data.rows() == clock.size();
  if (!along && !(data.is_vector() && data.columns() == clock.size())) return false;
  const auto same = [&](const MatTable& one) {
    return one.head.path == owner && one.head.columns[0].clock && one.columns[0] == clock;
  };
  auto found = std::ranges::find_if(tables_, same);
  if (found == tables_.end()) {
    std::string unit;
    if (const auto info = from.any_field({"TimeInfo"}, element)) unit = text_of(info, "Units", 0);
    tables_.push_back({});
    tables_.back().head.path = owner;
    tables_.back().add({"Time", unit.empty() ? "seconds" : unit, true}, clock);
    found = tables_.end() - 1;
  }
  const std::size_t across = along ? std::min(data.columns(), kMostAcross) : 1;
  for (std::size_t k = 0; k < across; ++k) {
    found->add({across > 1 ? fmt::format("{}(:,{})", name, k + 1) : name, unit_of(from, element)},
               along ? data.column(k) : data.values());
  }
  return true;
}

/// X: clocks, Y: channels with Name, Data, Unit and the index of their clock.
bool MatTables::take_dspace(const MatVariable& from, std::size_t element, const std::string& path) {
  const auto x = from.any_field({"X"}, element);
  const auto y = from.any_field({"Y"}, element);
  if (!x || !y || !x.is_struct() || !y.is_struct()) return false;
  for (std::size_t clock = 0; clock < std::min(x.elements(), limits_.tables); ++clock) {
    const auto time = x.any_field({"Data"}, clock);
    if (!is_long(time)) continue;
    MatTable one;
    one.head.path = x.elements() > 1 ? fmt::format("{}/X({})", path, clock + 1) : path;
    const std::string unit = text_of(x, "Unit", clock);
    one.add({"Time", unit.empty() ? "s" : unit, true}, time.values());
    for (std::size_t c = 0; c < std::min(y.elements(), limits_.columns - 1); ++c) {
      const auto data = y.any_field({"Data"}, c);
      const auto index = y.any_field({"XIndex"}, c);
      const bool numbered = index && index.is_numeric() && x.elements() > 1;
      if (numbered && index.values()[0] != static_cast<double>(clock + 1)) continue;
      if (!is_long(data) || data.elements() != one.columns[0].size()) continue;
      one.add({text_of(y, "Name", c), text_of(y, "Unit", c)}, data.values());
    }
    tables_.push_back(std::move(one));
  }
  return true;
}

/// "Structure with time": time, and signals with values and label.
bool MatTables::take_simulink(const MatVariable& from, std::size_t element,
                              const std::string& path) {
  const auto time = from.any_field({"time"}, element);
  const auto signals = from.any_field({"signals"}, element);
  if (!is_long(time) || !signals || !signals.is_struct()) return false;
  MatTable one;
  one.head.path = path;
  one.add({"time", "s", true}, time.values());
  const std::size_t rows = one.columns[0].size();
  for (std::size_t s = 0; s < std::min(signals.elements(), limits_.columns - 1); ++s) {
    const auto values = signals.any_field({"values"}, s);
    if (!values || !values.is_numeric() || values.rows() != rows) continue;
    const std::string label = text_of(signals, "label", s);
    for (std::size_t k = 0; k < std::min(values.columns(), kMostAcross); ++k) {
      one.add({values.columns() > 1 ? fmt::format("{}(:,{})", label, k + 1) : label, ""},
              values.column(k));
    }
  }
  tables_.push_back(std::move(one));
  return true;
}

void MatTables::take_fields(const MatVariable& from, std::size_t element, const std::string& path,
                            std::size_t depth) {
  const auto units = from.any_field({"Units", "Unit"}, element);
  for (const std::string& name : from.fields()) {
    const MatVariable one = from.field(name, element);
    if (!one) continue;
    if (is_long(one)) {
      const auto unit = units && units.is_struct() ? units.any_field({name}) : MatVariable(nullptr);
      auto values = one.values();
      table(path, values.size()).add({name, unit ? unit.text() : ""}, std::move(values));
    } else if (one.is_numeric()) {
      take_matrix(one, joined(path, name));
    } else if (one.is_struct()) {
      const std::size_t count = std::min(one.elements(), limits_.tables);
      for (std::size_t e = 0; e < count; ++e) {
        const std::string numbered = count > 1 ? fmt::format("{}({})", name, e + 1) : name;
        take_struct(one, e, joined(path, numbered), depth + 1);
      }
    }
  }
}

/// A struct that holds the time, beside structs of vectors along it, is one table.
void MatTables::join_into_owners() {
  const auto owner_of = [&](const MatTable& inner) {
    return std::ranges::find_if(tables_, [&](const MatTable& one) {
      return &one != &inner && inner.head.path.starts_with(one.head.path + "/") &&
             one.columns[0].size() == inner.columns[0].size() &&
             (one.own == 1 || inner.columns.size() == 1) && one.columns.size() < limits_.columns;
    });
  };
  for (MatTable& one : tables_) one.own = one.columns.size();
  for (auto inner = tables_.begin(); inner != tables_.end();) {
    const auto owner = owner_of(*inner);
    if (owner == tables_.end() || owner->columns.size() + inner->columns.size() > limits_.columns) {
      ++inner;
      continue;
    }
    std::string way = inner->head.path.substr(owner->head.path.size() + 1);
    std::ranges::replace(way, '/', '.');
    for (std::size_t c = 0; c < inner->columns.size(); ++c) {
      inner->head.columns[c].name = way + "." + inner->head.columns[c].name;
      owner->add(std::move(inner->head.columns[c]), std::move(inner->columns[c]));
    }
    inner = tables_.erase(inner);
  }
}

std::vector<MatTable> MatTables::tables() && {
  join_into_owners();
  return std::move(tables_);
}

}  // namespace flexspline::data
