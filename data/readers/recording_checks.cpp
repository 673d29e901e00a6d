#include "readers/recording_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "flexspline/data/rig_channels.hpp"
#include "readers/plausible.hpp"

namespace flexspline::data {
namespace {

constexpr std::size_t kFewestSamples = 16;
constexpr double kPause = 100.0;  // durations of all the rest

using Series = std::vector<double>;

class Checks {
 public:
  Checks(Recording& recording, const std::vector<Channel>& channels, const std::string& file,
         DatasetReading& reading)
      : recording_(recording), channels_(channels), file_(file), reading_(reading) {}

  void check(Rig rig) {
    if (!check_samples()) return;
    for (auto& [quantity, values] : recording_.channels) fill_dropouts(quantity, values);
    check_steps();
    for (const Quantity quantity : rig_channels(rig).vary) {
      if (const Series* values = recording_.find(quantity)) check_varies(quantity, *values);
    }
  }

 private:
  void refuse(std::size_t row, std::string problem, std::string remedy) {
    reading_.errors.push_back({file_, row == 0 ? 0 : static_cast<int>(row) + 1, row == 0 ? 0 : 1,
                               std::move(problem), std::move(remedy)});
  }

  std::string column_of(Quantity quantity) const {
    const auto found = std::ranges::find(channels_, quantity, &Channel::quantity);
    return found == channels_.end() ? std::string(name_of(quantity)) : found->column;
  }

  bool is_valid(std::size_t i) const { return marks_ == nullptr || (*marks_)[i] >= 0.5; }

  bool check_samples() {
    const std::size_t samples = recording_.time.size();
    if (samples < kFewestSamples) {
      refuse(samples, fmt::format("{} samples, where {} are the fewest", samples, kFewestSamples),
             "record for longer");
      return false;
    }
    marks_ = recording_.find(Quantity::valid);
    if (marks_ == nullptr) return true;
    const auto valid =
        static_cast<std::size_t>(std::ranges::count_if(*marks_, [](double v) { return v >= 0.5; }));
    if (valid >= kFewestSamples) return true;
    refuse(0,
           fmt::format("{} of {} samples are valid by column '{}', where {} are the fewest", valid,
                       samples, column_of(Quantity::valid), kFewestSamples),
           "1 marks what counts, 0 what the bench spoiled; leave the recording out if all is");
    return false;
  }

  void fill_dropouts(Quantity quantity, Series& values) {
    const auto absent = std::ranges::count_if(values, [](double v) { return std::isnan(v); });
    if (absent == 0) return;
    const Series& time = recording_.time;
    std::size_t next = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!std::isnan(values[i])) continue;
      for (next = std::max(next, i); next < values.size() && std::isnan(values[next]);) ++next;
      const bool before = i > 0;
      const bool after = next < values.size();
      if (before && after) {
        const double share = (time[i] - time[i - 1]) / (time[next] - time[i - 1]);
        values[i] = values[i - 1] + share * (values[next] - values[i - 1]);
      } else {
        values[i] = before ? values[i - 1] : values[next];
      }
    }
    note(0,
         fmt::format("column '{}' drops out in {} of {} samples, where valid is 0",
                     column_of(quantity), absent, values.size()),
         "they are filled straight between their neighbours, and have no residual");
  }

  void note(int line, const std::string& problem, std::string remedy) {
    reading_.decisions.push_back(fmt::format("recording {}: {}", recording_.id, problem));
    reading_.notes.push_back({file_, line, 1, problem, std::move(remedy)});
  }

  void check_steps() {
    const Series& time = recording_.time;
    double longest = 0.0;
    std::size_t row = 0;
    for (std::size_t i = 1; i < time.size(); ++i) {
      const double step = time[i] - time[i - 1];
      if (step <= longest) continue;
      longest = step;
      row = i + 1;
    }
    const double rest = time.back() - time.front() - longest;
    if (longest > kPause * rest) {
      refuse(row,
             fmt::format("column '{}' jumps by {:.4g} s, where all the rest lasts {:.4g} s",
                         column_of(Quantity::time), longest, rest),
             "correct the time, or cut the recording in two there");
    }
  }

  void check_varies(Quantity quantity, const Series& values) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!is_valid(i)) continue;
      low = std::min(low, values[i]);
      high = std::max(high, values[i]);
    }
    if (high - low > negligible_change(low, high)) return;
    refuse(0,
           fmt::format("column '{}', the {}, is constant: {:.6g} in SI throughout",
                       column_of(quantity), name_of(quantity), low),
           "check its sensor and its column; leave the recording out if nothing moved");
  }

  Recording& recording_;
  const std::vector<Channel>& channels_;
  const std::string& file_;
  DatasetReading& reading_;
  const Series* marks_ = nullptr;
};

}  // namespace

void check_recording(Recording& recording, Rig rig, const std::vector<Channel>& channels,
                     const std::string& file, DatasetReading& reading) {
  Checks(recording, channels, file, reading).check(rig);
}

}  // namespace flexspline::data
