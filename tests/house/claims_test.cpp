// Numbers that the pages print: how they are found, and that each marked block has its test.
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "claims/claims.hpp"
#include "source_dir.hpp"

namespace flexspline::claims {
namespace {

namespace fs = std::filesystem;

std::string read(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

std::vector<std::string> texts(std::string_view text) {
  std::vector<std::string> list;
  for (const Token& token : numbers_in(text)) list.push_back(token.text);
  return list;
}

TEST(Claims, FindNumbersInProseAlone) {
  EXPECT_THAT(texts("| h = 1 | 0.33 / 26, 1e-6 of [4](page5.md) | `x7` <!-- 8 --> a9, +-2.50 % |"),
              testing::ElementsAre("1", "0.33", "26", "1e-6", "4", "2.50"));
}

TEST(Claims, AreComparedToThePrintedDigits) {
  EXPECT_EQ(printed_like("0.33", 0.3349), "0.33");
  EXPECT_EQ(printed_like("26", 26.5001), "27");
  EXPECT_EQ(printed_like("2e-7", 2.4e-7), "2e-7");
  EXPECT_EQ(printed_like("1.5e3", 1540.0), "1.5e3");
}

std::string all_tests() {
  std::string all;
  for (const auto& one :
       fs::recursive_directory_iterator(fs::path(FLEXSPLINE_SOURCE_DIR) / "tests")) {
    if (one.path().extension() != ".cpp") continue;
    const std::string text = read(one.path());
    if (text.find("claims/claims.hpp") != std::string::npos) all += text;
  }
  return all;
}

std::vector<fs::path> pages() {
  std::vector<fs::path> list{fs::path(FLEXSPLINE_SOURCE_DIR) / "README.md"};
  for (const auto& one :
       fs::recursive_directory_iterator(fs::path(FLEXSPLINE_SOURCE_DIR) / "docs")) {
    if (one.path().extension() == ".md") list.push_back(one.path());
  }
  return list;
}

TEST(Claims, EveryMarkedBlockHasItsTest) {
  const std::string tests = all_tests();
  const std::regex mark("<!-- claim:([a-z0-9-]+) begin -->");
  int found = 0;
  for (const fs::path& page : pages()) {
    const std::string text = read(page);
    for (std::sregex_iterator match(text.begin(), text.end(), mark), end; match != end; ++match) {
      const std::string name = (*match)[1];
      ++found;
      EXPECT_NE(text.find(fmt::format("<!-- claim:{} end -->", name)), std::string::npos)
          << page << ": claim:" << name << " has no end";
      EXPECT_NE(tests.find('"' + name + '"'), std::string::npos)
          << page << ": no test computes claim:" << name;
    }
  }
  EXPECT_GT(found, 0);
}

}  // namespace
}  // namespace flexspline::claims
