#include "import/survey.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tables/unit_words.hpp"

namespace flexspline::data {
namespace {

constexpr std::size_t kMostSamples = 8192;

ColumnSurvey begun(const TableColumn& column) {
  ColumnSurvey one;
  one.column = column;
  one.low = std::numeric_limits<double>::infinity();
  one.high = -one.low;
  if (!column.unit.empty()) return one;
  NameAndUnit apart = split_name(column.name);
  one.unit_in_name = !apart.unit.empty();
  one.column.name = std::move(apart.name);
  one.column.unit = std::move(apart.unit);
  return one;
}

void look_at(ColumnSurvey& one, double value) {
  if (!std::isfinite(value)) return;
  if (one.present++ == 0) {
    one.first = value;
  } else {
    one.falls += value < one.last ? 1 : 0;
    one.repeats += value == one.last ? 1 : 0;
  }
  one.last = value;
  one.low = std::min(one.low, value);
  one.high = std::max(one.high, value);
  one.whole = one.whole && value == std::floor(value);
}

/// Looks at every row, and keeps some of them, evenly.
class SurveySink : public TableSink {
 public:
  SurveySink(std::vector<TableSurvey>& tables, TableSurvey pattern)
      : tables_(tables), pattern_(std::move(pattern)) {}

  std::vector<std::size_t> begin(const TableHead& head) override {
    TableSurvey& table = tables_.emplace_back(pattern_);
    table.path = head.path;
    table.index = index_++;
    table.notes = head.notes;
    std::vector<std::size_t> all;
    for (const TableColumn& column : head.columns) {
      all.push_back(all.size());
      table.columns.push_back(begun(column));
    }
    return all;
  }

  void rows(std::span<const std::vector<double>> columns) override {
    TableSurvey& table = tables_.back();
    for (std::size_t c = 0; c < columns.size(); ++c) {
      for (const double value : columns[c]) look_at(table.columns[c], value);
    }
    const std::size_t count = columns[0].size();
    for (std::size_t i = 0; i < count; ++i) {
      if ((table.rows + i) % table.stride != 0) continue;
      for (std::size_t c = 0; c < columns.size(); ++c) {
        table.columns[c].sample.push_back(columns[c][i]);
      }
      if (table.columns[0].sample.size() >= 2 * kMostSamples) thin(table);
    }
    table.rows += count;
  }

  void note(const std::string& text) override {
    if (!tables_.empty()) tables_.back().notes.push_back(text);
  }

 private:
  static void thin(TableSurvey& table) {
    for (ColumnSurvey& column : table.columns) {
      auto& sample = column.sample;
      for (std::size_t i = 0; 2 * i < sample.size(); ++i) sample[i] = sample[2 * i];
      sample.resize((sample.size() + 1) / 2);
    }
    table.stride *= 2;
  }

  std::vector<TableSurvey>& tables_;
  TableSurvey pattern_;
  std::size_t index_ = 0;
};

}  // namespace

Result<void> TableSurvey::check_same_file() const {
  std::error_code ignored;
  if (std::filesystem::file_size(file, ignored) == bytes &&
      std::filesystem::last_write_time(file, ignored) == changed) {
    return {};
  }
  return failure(ErrorCode::bad_data, file.string() + " changed while it was imported",
                 "wait until the bench has written it, or copy it first");
}

std::string TableSurvey::words() const {
  const std::string name = file.filename().string();
  return path.empty() ? name : fmt::format("{}, table '{}'", name, path);
}

Result<std::vector<TableSurvey>> survey_file(const std::filesystem::path& file,
                                             const TableRequest& request) {
  const auto reader = reader_of(file);
  if (!reader) return tl::unexpected(reader.error());
  std::vector<TableSurvey> tables;
  TableSurvey pattern;
  pattern.file = file;
  std::error_code ignored;
  pattern.bytes = std::filesystem::file_size(file, ignored);
  pattern.changed = std::filesystem::last_write_time(file, ignored);
  pattern.reader = (*reader)->id;
  SurveySink sink(tables, pattern);
  if (auto done = read_tables(file, request, sink); !done) return tl::unexpected(done.error());
  return tables;
}

double usual_step(const TableSurvey& table, std::size_t column) {
  const auto& sample = table.columns[column].sample;
  std::vector<double> steps;
  for (std::size_t i = 1; i < sample.size(); ++i) {
    const double step = sample[i] - sample[i - 1];
    if (step > 0.0) steps.push_back(step / static_cast<double>(table.stride));
  }
  if (steps.empty()) return 0.0;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::ranges::nth_element(steps, middle);
  return *middle;
}

}  // namespace flexspline::data
