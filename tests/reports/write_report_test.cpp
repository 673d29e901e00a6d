#include <cstdlib>
#include <set>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "checksum.hpp"
#include "flexspline/reports/report.hpp"
#include "study_folder.hpp"

namespace flexspline::reports {
namespace {

namespace fs = std::filesystem;

/// Unlike a matcher, this does not print a page of a megabyte when it fails.
bool contains(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

std::set<std::string> section_ids(const StudyFolder& study) {
  std::set<std::string> ids;
  const auto report = nlohmann::json::parse(study.text("report/report.json"));
  for (const auto& section : report.at("sections")) ids.insert(section.at("id"));
  return ids;
}

const std::set<std::string> kAll = {
    "verdict",           "own-loop-section",  "hold-out-section", "full-trajectory-section",
    "functions-section", "left-over-section", "paper-section",    "provenance-section"};

TEST(WriteReport, GivesTheSameBytesWhereverTheSameArtefactsLie) {
  const StudyFolder study;
  ASSERT_TRUE(write_report(study.path()));
  const std::string page = study.text("report/index.html");
  const std::string twin = study.text("report/report.json");
  const fs::path elsewhere = study.path() / "moved";
  for (const char* part : {"inputs", "cases", "paper.json", "study.lock.toml"}) {
    fs::create_directories(elsewhere);
    fs::copy(study.path() / part, elsewhere / part, fs::copy_options::recursive);
  }
  ASSERT_TRUE(write_report(elsewhere));
  EXPECT_EQ(study.text("moved/report/index.html"), page);
  EXPECT_EQ(study.text("moved/report/report.json"), twin);
}

TEST(WriteReport, HoldsEverySectionInOrderAndIsLight) {
  const StudyFolder study;
  const auto page = write_report(study.path());
  ASSERT_TRUE(page) << page.error().message();
  EXPECT_EQ(page->page, study.path() / "report" / "index.html");
  EXPECT_EQ(section_ids(study), kAll);
  const std::string html = study.text("report/index.html");
  std::size_t at = 0;
  for (const char* id :
       {"verdict", "own-loop-section", "hold-out-section", "full-trajectory-section",
        "functions-section", "left-over-section", "paper-section", "provenance-section"}) {
    const std::size_t found = html.find("<section id=\"" + std::string(id));
    ASSERT_NE(found, std::string::npos) << id;
    EXPECT_GT(found, at) << id;
    at = found;
  }
  EXPECT_LE(html.size(), 3'000'000u);
}

TEST(WriteReport, SealsItsTwin) {
  const StudyFolder study;
  ASSERT_TRUE(write_report(study.path()));
  EXPECT_TRUE(checksum_holds(study.text("report/report.json")));
}

TEST(WriteReport, ShowsHostileNamesWithoutRunningThem) {
  const StudyFolder study;
  ASSERT_TRUE(write_report(study.path()));
  const std::string html = study.text("report/index.html");
  const std::string markup = html.substr(0, html.find("<script type"));
  EXPECT_FALSE(contains(markup, "<img"));
  EXPECT_FALSE(contains(markup, "<b>"));
  EXPECT_FALSE(contains(markup, "<script"));
  EXPECT_TRUE(contains(html, "&lt;/script&gt;&lt;img src=x onerror=&quot;window.hacked=1&quot;"));
  EXPECT_FALSE(contains(html, "<img src=x"));
  EXPECT_FALSE(contains(html.substr(markup.size()), "window.hacked"));
}

TEST(WriteReport, ShowsAFailedCaseWithItsReasonAndNoNumbers) {
  const StudyFolder study;
  ASSERT_TRUE(write_report(study.path()));
  EXPECT_TRUE(contains(study.text("tables/hold-out-every-estimator.csv"),
                       "trajectory_one_loop,,,,failed: the "
                       "simulation of a0.2000-f0.01000"));
  EXPECT_TRUE(contains(study.text("report/index.html"), "1 of 16 cases failed"));
}

TEST(WriteReport, RefusesHWithTheEstimatorsReason) {
  const StudyFolder study;
  ASSERT_TRUE(write_report(study.path()));
  EXPECT_TRUE(contains(study.text("report/index.html"),
                       "No h from trajectory_one_loop on h = 1: one loop cannot tell"));
}

TEST(WriteReport, CallsAWeakHWeakAndNotRefused) {
  const StudyFolder study;
  change(study, "cases/h_even--trajectory--r0.json", [](auto& one) {
    one["estimate"]["identifiability"]["verdict"] = "weak";
    one["estimate"]["identifiability"]["says"] = "the class moves h";
  });
  ASSERT_TRUE(write_report(study.path()));
  const std::string html = study.text("report/index.html");
  EXPECT_TRUE(contains(html, "Weak: h from trajectory on h even: the class moves h"));
  EXPECT_FALSE(contains(html, "No h from trajectory on"));
  EXPECT_TRUE(contains(html, "1 of them with a class of h that is not the recordings"));
}

struct Part {
  const char* file;
  std::vector<const char*> lost;  ///< sections that cannot be drawn without it
};

class MissingArtefact : public testing::TestWithParam<Part> {};

TEST_P(MissingArtefact, LeavesOutItsSectionsAlone) {
  const StudyFolder study;
  fs::remove_all(study.path() / GetParam().file);
  const auto page = write_report(study.path());
  ASSERT_TRUE(page) << page.error().message();
  std::set<std::string> expected = kAll;
  for (const char* id : GetParam().lost) expected.erase(id);
  EXPECT_EQ(section_ids(study), expected);
}

INSTANTIATE_TEST_SUITE_P(
    Parts, MissingArtefact,
    testing::Values(Part{"paper.json", {"paper-section"}}, Part{"study.lock.toml", {}},
                    Part{"cases",
                         {"verdict", "own-loop-section", "hold-out-section",
                          "full-trajectory-section", "functions-section"}},
                    Part{"inputs",
                         {"own-loop-section", "hold-out-section", "full-trajectory-section",
                          "functions-section", "left-over-section"}}));

TEST(WriteReport, NamesArtefactsThatCannotBeRead) {
  const StudyFolder study;
  const fs::path spoilt = study.path() / "cases" / "h_one--paper--r0.json";
  std::string text = study.text("cases/h_one--paper--r0.json");
  text.replace(text.find("\"seed\":7"), 8, "\"seed\":8");
  ASSERT_TRUE(write_file(spoilt, text));
  ASSERT_TRUE(write_file(study.path() / "cases" / "cut.json", "{\"schema\": "));
  const auto report = write_report(study.path());
  ASSERT_TRUE(report);
  EXPECT_EQ(report->left_out.size(), 2U);
  const std::string html = study.text("report/index.html");
  EXPECT_TRUE(contains(html, "cases/h_one--paper--r0.json: its checksum does not hold"));
  EXPECT_TRUE(contains(html, "cases/cut.json: from line 1, column 12 on it is not JSON"));
  EXPECT_TRUE(contains(html, "cut short or damaged"));
  EXPECT_LT(html.find("artefacts cannot be read"), html.find("In short")) << "on top of the page";
  EXPECT_TRUE(contains(html, "from 15 cases"));
}

// The lock file says which cases there are: one that is gone or empty is missed.
TEST(WriteReport, MissesCasesThatTheLockNames) {
  const StudyFolder study;
  std::string lock = study.text("study.lock.toml") + "\n[cases]\n";
  for (const auto& entry : fs::directory_iterator(study.path() / "cases")) {
    lock += '"' + entry.path().stem().string() + "\" = \"0\"\n";
  }
  ASSERT_TRUE(write_file(study.path() / "study.lock.toml", lock));
  EXPECT_TRUE(write_report(study.path())->left_out.empty());
  fs::remove(study.path() / "cases" / "h_one--paper--r0.json");
  fs::resize_file(study.path() / "cases" / "h_even--paper--r0.json", 0);
  const auto report = write_report(study.path());
  ASSERT_TRUE(report);
  ASSERT_EQ(report->left_out.size(), 2U);
  EXPECT_EQ(report->left_out.back(), "cases/h_one--paper--r0.json: it is missing");
  EXPECT_TRUE(contains(study.text("report/index.html"), "from 14 cases"));
}

std::set<std::string> figure_ids(const StudyFolder& study) {
  std::set<std::string> ids;
  const auto report = nlohmann::json::parse(study.text("report/report.json"));
  for (const auto& section : report.at("sections")) {
    for (const auto& block : section.at("blocks")) {
      if (block.contains("figure")) ids.insert(block["figure"]["id"]);
    }
  }
  return ids;
}

TEST(WriteReport, DrawsEveryFigureAsAFileOfTheSameBytes) {
  const StudyFolder study;
  ASSERT_TRUE(write_report(study.path()));
  const auto ids = figure_ids(study);
  EXPECT_GE(ids.size(), 10U);
  std::vector<std::string> pictures;
  for (const std::string& id : ids) {
    pictures.push_back(study.text("report/figures/" + id + ".svg"));
    EXPECT_TRUE(pictures.back().starts_with("<svg xmlns=")) << id;
    EXPECT_TRUE(contains(pictures.back(), "<path")) << id;
  }
  ASSERT_TRUE(write_report(study.path()));
  std::size_t at = 0;
  for (const std::string& id : ids) {
    EXPECT_TRUE(study.text("report/figures/" + id + ".svg") == pictures[at++]) << id;
  }
}

/// PATH with nothing on it, until the end of the test.
class WithoutPrograms {
 public:
  WithoutPrograms() : path_(std::getenv("PATH")) { setenv("PATH", "/nowhere", 1); }
  ~WithoutPrograms() { setenv("PATH", path_.c_str(), 1); }

 private:
  std::string path_;
};

TEST(WriteReport, SaysThatNodeIsAbsentAndDrawsThePageAllTheSame) {
  const StudyFolder study;
  ASSERT_TRUE(write_report(study.path()));
  const std::string page = study.text("report/index.html");
  const WithoutPrograms none;
  ASSERT_TRUE(write_report(study.path()));
  EXPECT_TRUE(study.text("report/index.html") == page);
  EXPECT_TRUE(contains(study.text("report/figures/not-drawn.txt"), "apt-get install nodejs"));
  EXPECT_FALSE(fs::exists(study.path() / "report" / "figures" / "own-loop.svg"));
}

TEST(WriteReport, OrdersWhatIsLeftByEveryCoordinate) {
  const StudyFolder study;
  ASSERT_TRUE(write_report(study.path()));
  const std::string twin = study.text("report/report.json");
  for (const char* title : {"by time", "by torsion", "by velocity", "by load", "by order of"}) {
    EXPECT_TRUE(contains(twin, title)) << title;
  }
}

TEST(WriteReport, SetsThePaperBesideOurs) {
  const StudyFolder study;
  ASSERT_TRUE(write_report(study.path()));
  EXPECT_TRUE(contains(study.text("report/index.html"), "What is wrong: "));
  EXPECT_TRUE(contains(study.text("tables/slips.csv"), "where,printed,\"meant, or true\""));
}

TEST(WriteReport, RefusesAFolderWithoutArtefacts) {
  const StudyFolder study;
  const auto page = write_report(study.path() / "nowhere");
  ASSERT_FALSE(page);
  EXPECT_EQ(page.error().code, ErrorCode::input_missing);
}

TEST(WriteReport, SaysWhenItCannotWrite) {
  const StudyFolder study;
  ASSERT_TRUE(write_file(study.path() / "report", "a file where the folder should be"));
  const auto page = write_report(study.path());
  ASSERT_FALSE(page);
  EXPECT_EQ(page.error().code, ErrorCode::cannot_write);
}

}  // namespace
}  // namespace flexspline::reports
