#include <filesystem>
#include <random>

#include <gtest/gtest.h>

#include "dataset_fixture.hpp"
#include "flexspline/core/write_file.hpp"
#include "source_dir.hpp"
#include "table_fixture.hpp"

namespace flexspline::data {
namespace {

const std::filesystem::path kFiles =
    std::filesystem::path(FLEXSPLINE_SOURCE_DIR) / "tests/data/corpus/files";

class CutFiles : public InFolder {
 protected:
  /// Ends well or with an error that names the file; what it tells has the form of a table.
  void read(const std::string& name, const std::string& bytes) const {
    put(name, bytes);
    KeepingSink sink;
    const auto done = read_tables(folder_ / name, {}, sink);
    for (const ToldTable& table : sink.tables) {
      for (const auto& column : table.columns) EXPECT_EQ(column.size(), table.columns[0].size());
    }
    if (!done)
      EXPECT_NE(done.error().message().find(name), std::string::npos) << done.error().message();
    if (!done)
      EXPECT_EQ(done.error().message().find("by signal"), std::string::npos)
          << done.error().message();
  }
};

TEST_F(CutFiles, AtEachFiftiethOfTheirLengthAreReadOrRefused) {
  for (const auto& entry : std::filesystem::directory_iterator(kFiles)) {
    const auto whole = read_file(entry.path());
    ASSERT_TRUE(whole);
    for (std::size_t k = 1; k < 50; ++k) {
      read(entry.path().filename().string(), whole->substr(0, whole->size() * k / 50));
    }
  }
}

/// A crash of a parser by others is an error like any other; ours must not crash at all.
TEST_F(CutFiles, WithBytesChangedAreReadOrRefused) {
  std::mt19937_64 draw(20261122);
  for (const auto& entry : std::filesystem::directory_iterator(kFiles)) {
    const auto whole = read_file(entry.path());
    ASSERT_TRUE(whole);
    for (int k = 0; k < 20 && !whole->empty(); ++k) {
      std::string bytes = *whole;
      for (int n = 0; n < 3; ++n) bytes[draw() % bytes.size()] = static_cast<char>(draw() % 256);
      put("changed", bytes);
      KeepingSink sink;
      const auto done = read_tables(folder_ / "changed", {}, sink);
      if (!done) EXPECT_NE(done.error().message().find("changed"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace flexspline::data
