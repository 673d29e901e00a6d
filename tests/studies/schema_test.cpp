#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "flexspline/studies/kind.hpp"
#include "flexspline/studies/study_config.hpp"
#include "source_dir.hpp"
#include "study_file.hpp"

namespace flexspline::studies {
namespace {

nlohmann::json schema() {
  return nlohmann::json::parse(
      read_text(std::string(FLEXSPLINE_SOURCE_DIR) + "/data/schemas/study.schema.json"));
}

/// True where the reader has never heard of the key in a table that begins with `table`.
bool unknown(const std::string& table, const std::string& key) {
  const ScratchFolder folder;
  const auto reading = read_study(folder.write("study.toml", table + key + " = 1\n"));
  for (const data::Finding& finding : reading->errors) {
    if (finding.problem.find("unknown key") != std::string::npos) return true;
  }
  return false;
}

TEST(StudySchema, NamesOnlyKeysThatTheReaderKnows) {
  const auto top = schema().at("properties");
  const auto check = [](const std::string& table, const nlohmann::json& properties) {
    EXPECT_TRUE(unknown(table, "no_such_key"));
    for (const auto& [key, value] : properties.items()) {
      // A kind's own table is known where the study is of that kind.
      const std::string kind =
          find_kind(key) != nullptr ? fmt::format("kind = \"{}\"\n", key) : std::string();
      EXPECT_FALSE(unknown(kind + table, key)) << table << key;
    }
  };
  check("", top);
  check("[bench]\n", top.at("bench").at("properties"));
  for (const char* list : {"grid", "input", "estimator", "contrast"}) {
    check("[[" + std::string(list) + "]]\n", top.at(list).at("items").at("properties"));
  }
}

TEST(StudySchema, IsOfDraft4WhichEditorsRead) {
  EXPECT_EQ(schema().at("$schema"), "http://json-schema.org/draft-04/schema#");
}

}  // namespace
}  // namespace flexspline::studies
