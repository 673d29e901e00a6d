#include <fmt/format.h>

#include "flexspline/data/dataset.hpp"

namespace flexspline::data {
namespace {

void thin(std::vector<double>& values, std::size_t stride) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < values.size(); i += stride) values[kept++] = values[i];
  values.resize(kept);
  values.shrink_to_fit();
}

std::string ordinal(std::size_t number) {
  const std::size_t last = number % 100 / 10 == 1 ? 0 : number % 10;
  const char* ending = last == 1 ? "st" : last == 2 ? "nd" : last == 3 ? "rd" : "th";
  return fmt::format("{}{}", number, ending);
}

}  // namespace

void thin_recordings(RecordingSet& set, std::size_t most) {
  bool any = false;
  for (Recording& recording : set.recordings) {
    const std::size_t rows = recording.time.size();
    if (most == kAllRows || rows <= most) continue;
    const std::size_t stride = (rows + most - 1) / most;
    thin(recording.time, stride);
    for (auto& [quantity, values] : recording.channels) thin(values, stride);
    set.notes.push_back(
        fmt::format("recording {}: every {} of {} rows is used; --rows all uses them all",
                    recording.id, ordinal(stride), rows));
    any = true;
  }
  if (any) set.sha256 = content_hash(set);
}

}  // namespace flexspline::data
