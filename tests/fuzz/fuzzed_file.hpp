#pragma once

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

#include "flexspline/data/table_reader.hpp"
#include "tables/contained.hpp"
#ifdef FLEXSPLINE_FUZZ_GUIDED
#include "guided/seen_child.hpp"
#endif

namespace flexspline::fuzz {

/// A folder of this process, with one file that each input replaces.
inline std::filesystem::path folder() {
  static const std::filesystem::path path = [] {
    std::string name = (std::filesystem::temp_directory_path() / "flexspline-fuzz-XXXXXX").string();
    return std::filesystem::path(mkdtemp(name.data()));
  }();
  return path;
}

inline std::filesystem::path write(const std::string& name, const std::uint8_t* bytes,
                                   std::size_t size) {
  const std::filesystem::path path = folder() / name;
  std::ofstream(path, std::ios::binary | std::ios::trunc)
      .write(reinterpret_cast<const char*>(bytes), static_cast<std::streamsize>(size));
  return path;
}

/// Takes everything and checks the promises that a reader makes to a sink.
class CheckingSink : public data::TableSink {
 public:
  std::vector<std::size_t> begin(const data::TableHead& head) override {
    wanted_ = head.columns.size();
    std::vector<std::size_t> all(wanted_);
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    return all;
  }
  void rows(std::span<const std::vector<double>> columns) override {
    if (columns.size() != wanted_) std::abort();
    for (const auto& column : columns) {
      if (column.size() != columns[0].size()) std::abort();
    }
  }
  void note(const std::string&) override {}

 private:
  std::size_t wanted_ = 0;
};

/// One reader on one input, whatever its first bytes say. A reader by others runs as it does in the
/// program, in a process of its own: its library may crash (HDF5's does), this process may not.
/// Under libFuzzer the parsers of a bag, whose libraries only unpack or keep rows, run in this one:
/// that is stricter, and a hundred times as fast.
inline void read(std::string_view reader, const std::uint8_t* bytes, std::size_t size) {
  const std::filesystem::path path = write("input", bytes, size);
  data::TableRequest request;
  request.limits.rows = 1'000'000;
  request.limits.silence_s = 5.0;  // HDF5 may go round in a circle: it is ended, as in the program
  CheckingSink sink;
  for (const data::TableReaderRow& row : data::table_readers()) {
    if (row.id != reader) continue;
#ifdef FLEXSPLINE_FUZZ_GUIDED
    if (row.by_others && reader != "mcap" && reader != "rosbag2") {
      see_children();
      (void)data::read_contained(row, path, request, sink);
      check_children();
    } else {
      (void)row.read(path, request, sink);
    }
#else
    (void)(row.by_others ? data::read_contained(row, path, request, sink)
                         : row.read(path, request, sink));
#endif
  }
}

}  // namespace flexspline::fuzz
