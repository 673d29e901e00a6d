#include <algorithm>
#include <regex>
#include <set>

#include <fmt/format.h>
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

/// Decisions and the changelog tell how things came to be, tests quote what they refuse, and
/// scripts of CMake are for builders.
bool is_history_or_test(const std::string& file) {
  return file == "CHANGELOG.md" || file.starts_with("docs/decisions/") ||
         file.starts_with("tests/") || file.ends_with(".cmake") || file.ends_with("CMakeLists.txt");
}

/// Programs show what stands in their literals; of everything else a person reads every word.
bool is_program(const std::string& file) {
  static const std::vector<std::string> kinds = {".cpp", ".hpp", ".ts", ".mjs", ".js", ".css"};
  return std::ranges::any_of(kinds, [&](const auto& kind) { return file.ends_with(kind); });
}

/// What is read as one: a paragraph, or literals that stand one after another.
struct Passage {
  std::string place;
  std::string text;
};

/// Without indentation and the signs of a comment.
std::string bare(const std::string& line) {
  static const std::regex margin(R"(^\s*(#|//|%|\*)*\s*)");
  return std::regex_replace(line, margin, "");
}

bool ends_passage(const SourceLine& line) {
  const std::string text = bare(line.text);
  return text.empty() || text.starts_with("```");
}

/// A literal that goes on in the next line: its quotes there and here fall out.
bool joins_literal(std::string& so_far, const std::string& next) {
  if (so_far.empty() || so_far.back() != '"' || !next.starts_with('"')) return false;
  so_far.pop_back();
  so_far += next.substr(1);
  return true;
}

/// Paragraphs of a text, literals of a program; a sentence may go over several lines.
std::vector<Passage> passages_of(const std::vector<SourceLine>& lines) {
  std::vector<Passage> passages;
  std::string file;
  bool ended = true;
  for (const SourceLine& line : lines) {
    if (is_history_or_test(line.file)) continue;
    const bool program = is_program(line.file);
    const std::string text = program ? bare(line.text) : bare(line.text) + " ";
    if (line.file == file && program && joins_literal(passages.back().text, text)) continue;
    if (line.file == file && !program && !ended) {
      passages.back().text += text;
    } else {
      passages.push_back({line.file + ":" + std::to_string(line.number), text});
    }
    ended = ends_passage(line);
    file = line.file;
  }
  return passages;
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
      offences.push_back(fmt::format("'{}'; write: {}", found.str(), instead));
    }
  }
  return offences;
}

TEST(Language, PagesMessagesAndDocumentsUseTheTermsOfTheField) {
  std::string offenders;
  std::set<std::string> read;
  for (const Passage& passage : passages_of(lines_of_text())) {
    const std::string file = passage.place.substr(0, passage.place.rfind(':'));
    read.insert(file);
    const std::string text =
        is_program(file) ? sentences_of(passage.text) : without_code(passage.text);
    for (const std::string& offence : offences_in(text)) {
      offenders += passage.place + ": " + offence + "\n";
    }
  }
  EXPECT_TRUE(offenders.empty()) << offenders;
  // One of each kind that a person reads: a walk that misses a folder finds nothing in it.
  for (const char* file :
       {"README.md", "bootstrap", "CITATION.cff", "core/effects/backlash.cpp",
        "data/schemas/diagnosis.schema.json", "data/templates/study.toml", "docs/diagnosis.md",
        "docs/how-to/read-a-diagnosis.md", "docs/site/template.html", "docs/images/hero.mjs",
        "docs/examples/matlab/read_results.m", "docs/examples/clusters/study.sbatch",
        "estimators/torsion/free_terms.cpp", "python/flexspline/model.py", "studies/paper.toml",
        "reports/assets/src/legend.ts", "reports/page.cpp", "studies/app/commands/doctor.cpp"}) {
    EXPECT_TRUE(read.contains(file)) << file;
  }
}

TEST(Language, ASentenceOverSeveralLinesIsReadAsOne) {
  const std::vector<SourceLine> lines = {{"docs/a.md", 1, "the error in the"},
                                         {"docs/a.md", 2, "middle, and"},
                                         {"docs/a.md", 3, ""},
                                         {"docs/a.md", 4, "middle"},
                                         {"core/a.cpp", 1, "  says(\"of which the \""},
                                         {"core/a.cpp", 2, "       \"effort is\");"},
                                         {"tests/a.cpp", 1, "\"the effort is\""}};
  const auto passages = passages_of(lines);
  ASSERT_EQ(passages.size(), 3u);
  EXPECT_EQ(offences_in(passages[0].text).size(), 1u);
  EXPECT_THAT(offences_in(passages[1].text), IsEmpty());
  EXPECT_EQ(sentences_of(passages[2].text), "of which the effort is\n");
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
