#include <algorithm>
#include <cmath>
#include <string_view>

#include "flexspline/data/dataset.hpp"
#include "fuzzed_file.hpp"

// The table of a data set, as every command reads it that takes recordings.
namespace flexspline::fuzz {
namespace {

constexpr std::string_view kDescription = R"(schema = "flexspline-dataset/1"
name = "fuzzed"
license = "CC0-1.0"
rig = "servo"
[constants]
gear_ratio = 50
[channels]
t = { quantity = "time", unit = "s" }
q = { quantity = "load_angle", unit = "deg" }
tau = { quantity = "motor_torque", unit = "mNm" }
on = { quantity = "drive_enabled" }
ok = { quantity = "valid" }
[[recording]]
id = "a"
file = "a.csv"
)";

void expect(bool holds) {
  if (!holds) std::abort();
}

const std::uint8_t* bytes_of(std::string_view text) {
  return reinterpret_cast<const std::uint8_t*>(text.data());
}

data::DatasetReading reading_of(std::string_view table) {
  write("a.csv", bytes_of(table), table.size());
  data::DatasetReading reading = data::read_dataset(folder());
  expect(reading.set.has_value() == reading.errors.empty());
  return reading;
}

void expect_sound(const Recording& recording) {
  const auto* valid = recording.find(Quantity::valid);
  for (const auto& [quantity, values] : recording.channels) {
    expect(values.size() == recording.time.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      expect(std::isfinite(values[i]) || (valid != nullptr && (*valid)[i] == 0.0));
    }
  }
  expect(std::ranges::all_of(recording.time, [](double t) { return std::isfinite(t); }));
  expect(std::ranges::is_sorted(recording.time, std::less_equal{}));
}

/// The same table with each cell in quotes, which the reader takes by its slow way.
std::string quoted(std::string_view table) {
  const char separator = table.substr(0, table.find('\n')).find(';') != table.npos ? ';' : ',';
  std::string text;
  while (!table.empty()) {
    std::string_view line = table.substr(0, table.find('\n'));
    const bool ended = line.size() < table.size();
    table.remove_prefix(line.size() + (ended ? 1 : 0));
    if (line.find_first_not_of(" \t\r") != line.npos) {
      text += '"';
      for (const char letter : line) {
        if (letter == separator) {
          text += "\"";
          text += separator;
          text += "\"";
        } else {
          text += letter;
        }
      }
      text += '"';
    }
    if (ended) text += '\n';
  }
  return text;
}

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

void expect_same(const Recording& a, const Recording& b) {
  expect(a.time == b.time && a.channels.size() == b.channels.size());
  for (const auto& [quantity, values] : a.channels) {
    expect(std::ranges::equal(values, b.channels.at(quantity), same));
  }
}

}  // namespace
}  // namespace flexspline::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace flexspline;
  static const bool described = [] {
    fuzz::write("dataset.toml", fuzz::bytes_of(fuzz::kDescription), fuzz::kDescription.size());
    return true;
  }();
  static_cast<void>(described);
  const std::string_view table(reinterpret_cast<const char*>(bytes), size);
  const auto reading = fuzz::reading_of(table);
  if (!reading.set) return 0;
  fuzz::expect_sound(reading.set->recordings.at(0));
  // A tab separates only where there is no other mark, and a byte-order mark stands before quotes.
  if (table.find_first_of("\"\t\xEF") != table.npos) return 0;
  const auto again = fuzz::reading_of(fuzz::quoted(table));
  fuzz::expect(again.set.has_value());
  fuzz::expect_same(reading.set->recordings.at(0), again.set->recordings.at(0));
  return 0;
}
