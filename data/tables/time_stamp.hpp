#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace flexspline::data {

/// A date, a time of day, or both.
struct TimeStamp {
  std::optional<std::int64_t> day;  ///< since 1970-01-01
  double second = 0.0;              ///< of the day
  bool order_open = false;          ///< 5/3/2024: month and day may be the other way round
};

/// 2024-05-03T12:30:01.5Z, 2024-05-03 12:30:01,5, 03.05.2024 12:30, 5/13/2024, 12:30:01.5, with an
/// offset of the zone or AM and PM. Slashes: month first, unless that is no month.
std::optional<TimeStamp> parse_time_stamp(std::string_view text);

}  // namespace flexspline::data
