#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "source_tree.hpp"

namespace flexspline::house {
namespace {

using ::testing::IsEmpty;

/// Phrases that a reader of the field has to guess at, and what to write instead. Everyday uses of
/// the same words ("a row left out by the reader") are not meant, so each pattern holds its
/// context.
const std::vector<std::pair<std::string, std::string>>& oblique_phrases() {
  static const std::vector<std::pair<std::string, std::string>> phrases = {
      {R"(\bin the middle\b)", "median"},
      {R"(\bnobody (was|is|knows|can)\b|\bno fit had seen\b)", "held-out; unknown"},
      {R"(\bwhat it was given\b|\bwas given to train\b)", "training recordings"},
      {R"(\berrs (by|in|at)\b|\b(is|are) off by\b)", "has an error of"},
      {R"(\bcom(e|es|ing) home\b)", "converges"},
      {R"(\bof starts\b|\bevery start\b|\ba start (that|is|fails)\b)", "initial guess, multistart"},
      {R"(\beffort\b)", "torque, force"},
      {R"(\bnet gain\b)", "penalised gain"},
      {R"(\bworth\b)", "likelihood-ratio statistic; accuracy"},
      {R"(\btaken up by\b|\btakes? up by\b)", "absorbed by"},
      {R"(\btwins?\b|\brivals?\b)", "confounded, alternative"},
      {R"(\bin the shadow\b|\bform error\b)", "model discrepancy"},
      {R"(\bremainder\b|\bwhat is left over\b)", "residual, lack of fit"},
      {R"(\borders the residual\b|\bis ordered by\b)", "explains residual variance"},
      {R"(\btells? (it|them|[a-z_{}]+) (from|apart)\b|\bcannot tell\b)", "separates; identifiable"},
      {R"(\bbelief\b)", "model weight"},
      {R"(\bstrokes?\b)", "constant-velocity segments"},
      {R"(\bspelled\b)", "report text"},
      {R"(\breversal memory\b)", "distance since the last reversal"},
      {R"(\blate torque\b)", "torque measurement delay"},
      {R"(\bneedless\b|\busurp)", "redundant, displaces"},
      {R"(\bby [^ ]+ sigma\b)", "separates (z = ...)"},
      {R"((\bwhat|[Ss]omething|[Nn]othing) (was|is|were) left out\b|\bLeft out: )", "missing"},
      {R"(\bdrawn (bench|drive)(es|s)?\b)", "simulated test cases"},
      {R"(\bnoise colou?rs?\b|\bcolou?r of (the )?noise\b)", "noise model"},
      {R"(\bwind-up\b)", "low-stiffness region, soft wind-up"},
      {R"(\bbefore its recording began\b)", "initial transient"},
  };
  return phrases;
}

bool is_prose(const SourceLine& line) {
  return line.file.ends_with(".md") && line.file != "CHANGELOG.md" &&
         !line.file.starts_with("docs/decisions/");
}

bool is_program(const SourceLine& line) {
  const bool code = line.file.ends_with(".cpp") || line.file.ends_with(".hpp");
  return code && !line.file.starts_with("tests/");
}

/// Sentences among the literals of a line: one word alone is a name of an artefact, not text.
std::string sentences_of(const std::string& code) {
  static const std::regex literal(R"re("((?:[^"\\]|\\.)*)")re");
  std::string text;
  for (std::sregex_iterator at(code.begin(), code.end(), literal), end; at != end; ++at) {
    const std::string found = (*at)[1];
    if (found.find(' ') != std::string::npos) text += found + "\n";
  }
  return text;
}

/// Without what a document sets in code type: keys and commands keep their names.
std::string without_code(const std::string& text) {
  static const std::regex code(R"(`[^`]*`|"[a-z_]+")");
  return std::regex_replace(text, code, "");
}

std::vector<std::string> offences_in(const std::string& text) {
  static const auto patterns = [] {
    std::vector<std::pair<std::regex, std::string>> compiled;
    for (const auto& [pattern, instead] : oblique_phrases()) {
      compiled.emplace_back(std::regex(pattern), instead);
    }
    return compiled;
  }();
  std::vector<std::string> offences;
  for (const auto& [pattern, instead] : patterns) {
    std::smatch found;
    if (std::regex_search(text, found, pattern)) {
      offences.push_back("'" + found.str() + "'; write: " + instead);
    }
  }
  return offences;
}

TEST(Language, PagesMessagesAndDocumentsUseTheTermsOfTheField) {
  std::string offenders;
  int read = 0;
  for (const SourceLine& line : lines_of_text()) {
    if (!is_prose(line) && !is_program(line)) continue;
    ++read;
    const std::string text = is_prose(line) ? without_code(line.text) : sentences_of(line.text);
    for (const std::string& offence : offences_in(text)) {
      offenders += line.file + ":" + std::to_string(line.number) + ": " + offence + "\n";
    }
  }
  EXPECT_TRUE(offenders.empty()) << offenders;
  EXPECT_GT(read, 10000) << "the walk found no text";
}

TEST(Language, ThePatternsCatchWhatTheyAreFor) {
  EXPECT_EQ(offences_in("a sine tells presliding from load by 93 sigma").size(), 2u);
  EXPECT_EQ(offences_in("What was left out is unknown: nothing was left out.").size(), 1u);
  EXPECT_THAT(offences_in("rows that the reader left out, and starts of a file"), IsEmpty());
  EXPECT_EQ(sentences_of(R"(json["effort"] = text("no effort here");)"), "no effort here\n");
  EXPECT_EQ(without_code("the key `effort` is old"), "the key  is old");
}

}  // namespace
}  // namespace flexspline::house
