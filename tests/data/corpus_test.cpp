#include <cmath>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "source_dir.hpp"
#include "table_fixture.hpp"

namespace flexspline::data {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

const std::filesystem::path kCorpus =
    std::filesystem::path(FLEXSPLINE_SOURCE_DIR) / "tests/data/corpus";

json expectations() { return json::parse(std::ifstream(kCorpus / "expected.json")); }

std::vector<std::string> names_of_files() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(kCorpus / "files")) {
    names.push_back(entry.path().filename().string());
  }
  std::ranges::sort(names);
  return names;
}

void expect_column(const json& wanted, const TableColumn& column,
                   const std::vector<double>& values) {
  EXPECT_EQ(column.name, wanted.at("name").get<std::string>());
  EXPECT_EQ(column.unit, wanted.at("unit").get<std::string>()) << column.name;
  EXPECT_EQ(column.clock, wanted.at("clock")) << column.name;
  const json& numbers = wanted.at("values");
  ASSERT_EQ(values.size(), numbers.size()) << column.name;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (numbers[i].is_null()) {
      EXPECT_TRUE(std::isnan(values[i])) << column.name << " row " << i;
    } else if (wanted.at("unit") == "s" && column.clock) {
      EXPECT_NEAR(values[i], numbers[i].get<double>(), 1e-9) << column.name << " row " << i;
    } else {
      EXPECT_DOUBLE_EQ(values[i], numbers[i].get<double>()) << column.name << " row " << i;
    }
  }
}

/// The corpus is made by other software: tests/data/corpus/make.
class Corpus : public testing::TestWithParam<std::string> {};

TEST_P(Corpus, ComesOutAsItWentIn) {
  const json wanted = expectations().at(GetParam());
  const std::filesystem::path file = kCorpus / "files" / GetParam();
  KeepingSink sink;
  const auto done = read_tables(file, {}, sink);
  if (wanted.contains("refused")) {
    ASSERT_FALSE(done);
    for (const json& piece : wanted.at("refused")) {
      EXPECT_THAT(done.error().message(), HasSubstr(piece.get<std::string>()));
    }
    return;
  }
  ASSERT_TRUE(done) << done.error().message();
  EXPECT_EQ((*reader_of(file))->id, wanted.at("reader").get<std::string>());
  const json& tables = wanted.at("tables");
  ASSERT_EQ(sink.tables.size(), tables.size()) << sink.notes;
  for (std::size_t t = 0; t < tables.size(); ++t) {
    const ToldTable& table = sink.tables[t];
    EXPECT_EQ(table.head.path, tables[t].at("path").get<std::string>());
    const json& columns = tables[t].at("columns");
    ASSERT_EQ(table.columns.size(), columns.size()) << sink.notes;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      expect_column(columns[c], table.head.columns[c], table.columns[c]);
    }
  }
  for (const json& piece : wanted.at("notes")) {
    EXPECT_THAT(sink.notes, HasSubstr(piece.get<std::string>()));
  }
}

INSTANTIATE_TEST_SUITE_P(Files, Corpus, testing::ValuesIn(names_of_files()), [](const auto& file) {
  std::string name = file.param;
  for (char& letter : name)
    letter = std::isalnum(static_cast<unsigned char>(letter)) ? letter : '_';
  return name;
});

TEST(CorpusList, SaysWhatEveryFileGives) {
  EXPECT_EQ(expectations().size(), names_of_files().size());
  EXPECT_GE(names_of_files().size(), 60U);
}

}  // namespace
}  // namespace flexspline::data
