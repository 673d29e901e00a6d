// Every command that stands in a ```console block of the documents is run, one after another in the
// page's own folder, and its output is held against what the page shows: a line "…" stands for any
// lines, every other has to come out as it stands. With FLEXSPLINE_BLESS set the page is written
// anew: shown lines take the numbers that came out, where nothing but numbers differs.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "claims/claims.hpp"
#include "program.hpp"
#include "source_dir.hpp"
#include "study_file.hpp"

namespace flexspline::studies {
namespace {

namespace fs = std::filesystem;
using Lines = std::vector<std::string>;

const fs::path kSource = FLEXSPLINE_SOURCE_DIR;
constexpr std::string_view kAny = "…";

struct Shown {
  std::string command;
  Lines lines;                  ///< of its output
  std::vector<std::size_t> at;  ///< where they stand in the page
};

Lines lines_of(const std::string& text) {
  Lines lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// The commands of a page's console blocks; a block in a list is indented.
std::vector<Shown> commands_of(const Lines& page) {
  std::vector<Shown> commands;
  bool inside = false;
  std::size_t indent = 0;
  for (std::size_t i = 0; i < page.size(); ++i) {
    const std::size_t from = page[i].find_first_not_of(' ');
    const std::string line = from == std::string::npos ? std::string() : page[i].substr(from);
    if (line.starts_with("```")) {
      inside = !inside && line == "```console";
      indent = from;
      continue;
    }
    if (!inside) continue;
    if (line.starts_with("$ ")) {
      commands.push_back({line.substr(2), {}, {}});
    } else if (!commands.empty()) {
      commands.back().lines.push_back(page[i].size() < indent ? line : page[i].substr(indent));
      commands.back().at.push_back(i);
    }
  }
  return commands;
}

std::string without_numbers(const std::string& line) {
  std::string text = line;
  const auto tokens = claims::numbers_in(line);
  for (auto token = tokens.rbegin(); token != tokens.rend(); ++token) {
    text.replace(token->at, token->text.size(), "#");
  }
  return text;
}

/// The output's line that a shown one stands for, from `next` on: the same, else but for numbers.
std::size_t find_line(const Lines& output, std::size_t next, const std::string& line) {
  for (std::size_t i = next; i < output.size(); ++i) {
    if (output[i] == line) return i;
  }
  for (std::size_t i = next; i < output.size(); ++i) {
    if (without_numbers(output[i]) == without_numbers(line)) return i;
  }
  return output.size();
}

class Documents : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (!exists(program_path())) GTEST_SKIP() << program_path() << " is not built";
    for (const char* name : {"docs", "studies"}) {
      fs::create_directory_symlink(kSource / name, folder_.path() / name);
    }
  }

  /// What a command says, results and messages.
  Lines output_of(const std::string& command) const {
    const std::string program = program_path().string();
    const std::string rest = command.substr(std::string("flexspline").size());
    const std::string said = (folder_.path() / "said.txt").string();
    const int code = std::system(("cd " + folder_.path().string() + " && " + program + rest + " >" +
                                  said + " 2>" + said + ".err")
                                     .c_str());
    EXPECT_EQ(code, 0) << command << "\n" << read_text(said + ".err");
    return lines_of(read_text(said));
  }

  void compare(const Shown& shown, Lines& page) const {
    const Lines output = output_of(shown.command);
    std::size_t next = 0;
    bool any = false;
    for (std::size_t k = 0; k < shown.lines.size(); ++k) {
      const std::string& line = shown.lines[k];
      if (line == kAny) {
        any = true;
        continue;
      }
      const std::size_t found = find_line(output, next, line);
      if (found == output.size() || (!any && found != next)) {
        ADD_FAILURE() << GetParam() << ": " << shown.command << "\n  does not say: " << line;
        continue;
      }
      if (std::getenv("FLEXSPLINE_BLESS") != nullptr) {
        std::string& there = page[shown.at[k]];
        there = there.substr(0, there.size() - line.size()) + output[found];
      } else {
        EXPECT_EQ(output[found], line) << GetParam() << ": " << shown.command;
      }
      next = found + 1;
      any = false;
    }
  }

  ScratchFolder folder_;
};

TEST_P(Documents, CommandsSayWhatThePageShows) {
  const fs::path file = kSource / "docs" / GetParam();
  Lines page = lines_of(read_text(file));
  const auto commands = commands_of(page);
  ASSERT_FALSE(commands.empty()) << "nothing to run";
  for (const Shown& one : commands) {
    if (one.command.starts_with("flexspline ")) compare(one, page);
  }
  if (std::getenv("FLEXSPLINE_BLESS") == nullptr) return;
  std::ofstream out(file);
  for (const std::string& line : page) out << line << "\n";
}

std::vector<std::string> pages() {
  std::vector<std::string> list;
  for (const auto& entry : fs::recursive_directory_iterator(kSource / "docs")) {
    if (entry.path().extension() != ".md") continue;
    if (commands_of(lines_of(read_text(entry.path()))).empty()) continue;
    list.push_back(fs::relative(entry.path(), kSource / "docs").string());
  }
  std::ranges::sort(list);
  return list;
}

INSTANTIATE_TEST_SUITE_P(Pages, Documents, testing::ValuesIn(pages()), [](const auto& one) {
  return std::regex_replace(one.param, std::regex("[^A-Za-z0-9]"), "_");
});

}  // namespace
}  // namespace flexspline::studies
