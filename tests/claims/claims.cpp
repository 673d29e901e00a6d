#include "claims.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "source_dir.hpp"

namespace flexspline::claims {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRewrites =
    "; FLEXSPLINE_BLESS=1 in the environment of this test rewrites the page";

std::string read(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

void write(const fs::path& file, const std::string& text) {
  const fs::path temporary = file.string() + ".new";
  std::ofstream(temporary) << text;
  fs::rename(temporary, file);
}

/// A marked block of a page.
struct Block {
  fs::path file;
  std::string page;
  std::size_t first = std::string::npos;
  std::size_t last = std::string::npos;

  bool is_there() const { return last != std::string::npos; }
  std::string text() const { return page.substr(first, last - first); }
};

Block find_block(std::string_view page, std::string_view name) {
  Block block{fs::path(FLEXSPLINE_SOURCE_DIR) / page, ""};
  block.page = read(block.file);
  const std::string begin = fmt::format("<!-- claim:{} begin -->", name);
  block.first = block.page.find(begin);
  if (block.first == std::string::npos) return block;
  block.first += begin.size();
  block.last = block.page.find(fmt::format("<!-- claim:{} end -->", name), block.first);
  return block;
}

bool to_be_rewritten() { return std::getenv("FLEXSPLINE_BLESS") != nullptr; }

/// The text with what holds no numbers blanked out.
std::string only_prose(std::string_view text) {
  std::string prose(text);
  static const std::regex other(R"(`[^`]*`|\]\([^)]*\)|<!--[\s\S]*?-->)");
  for (std::smatch match; std::regex_search(prose, match, other);) {
    const auto at = prose.begin() + match.position();
    std::fill(at, at + match.length(), ' ');
  }
  return prose;
}

bool follows_a_letter(std::string_view text, std::size_t at) {
  if (at == 0) return false;
  const auto before = static_cast<unsigned char>(text[at - 1]);
  return std::isalnum(before) != 0 || before == '_';
}

}  // namespace

std::vector<Token> numbers_in(std::string_view text) {
  const std::string prose = only_prose(text);
  static const std::regex number(R"(\d+(\.\d+)?(e-?\d+)?)");
  std::vector<Token> tokens;
  for (std::sregex_iterator match(prose.begin(), prose.end(), number), end; match != end; ++match) {
    const auto at = static_cast<std::size_t>(match->position());
    if (!follows_a_letter(prose, at)) tokens.push_back({at, match->str()});
  }
  return tokens;
}

std::string printed_like(const std::string& token, double value) {
  const std::size_t exponent = token.find('e');
  const std::size_t point = token.find('.');
  const std::size_t decimals =
      point == std::string::npos ? 0 : std::min(exponent, token.size()) - point - 1;
  if (exponent == std::string::npos) return fmt::format("{:.{}f}", value, decimals);
  std::string text = fmt::format("{:.{}e}", value, decimals);
  return std::regex_replace(text, std::regex("e([+-])0*"),
                            text.find("e-") != std::string::npos ? "e-" : "e");
}

void expect(std::string_view page, std::string_view name, const std::vector<Number>& numbers) {
  Block block = find_block(page, name);
  ASSERT_TRUE(block.is_there()) << page << " has no block claim:" << name;
  const auto tokens = numbers_in(block.text());
  ASSERT_EQ(tokens.size(), numbers.size())
      << page << ", claim:" << name << " prints another count of numbers than is computed";
  for (std::size_t k = tokens.size(); k-- > 0;) {
    if (std::isnan(numbers[k].value)) continue;
    const std::string computed = printed_like(tokens[k].text, numbers[k].value);
    if (to_be_rewritten()) {
      block.page.replace(block.first + tokens[k].at, tokens[k].text.size(), computed);
    } else {
      EXPECT_EQ(tokens[k].text, computed)
          << page << ", claim:" << name << ", " << numbers[k].what << " is "
          << fmt::format("{:.6g}", numbers[k].value) << kRewrites;
    }
  }
  if (to_be_rewritten()) write(block.file, block.page);
}

void expect_text(std::string_view page, std::string_view name, const std::string& text) {
  Block block = find_block(page, name);
  ASSERT_TRUE(block.is_there()) << page << " has no block claim:" << name;
  if (to_be_rewritten()) {
    block.page.replace(block.first, block.last - block.first, text);
    write(block.file, block.page);
  } else {
    EXPECT_EQ(block.text(), text) << page << ", claim:" << name << kRewrites;
  }
}

}  // namespace flexspline::claims
