#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "flexspline/reports/diagnosis_view.hpp"
#include "flexspline/reports/report.hpp"
#include "flexspline/reports/trial_view.hpp"
#include "study_folder.hpp"

namespace flexspline::reports {
namespace {

using nlohmann::ordered_json;

bool contains(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

/// The page's text and tables, without the program that draws its figures.
std::string markup_of(const std::string& html) { return html.substr(0, html.find("<script type")); }

std::vector<std::string> section_ids(const StudyFolder& folder) {
  std::vector<std::string> ids;
  const auto report = ordered_json::parse(folder.text("report/report.json"));
  for (const auto& section : report.at("sections")) ids.push_back(section.at("id"));
  return ids;
}

ordered_json figure_of(const StudyFolder& folder, const std::string& id) {
  const auto report = ordered_json::parse(folder.text("report/report.json"));
  for (const auto& section : report.at("sections")) {
    for (const auto& block : section.at("blocks")) {
      if (block.contains("figure") && block["figure"]["id"] == id) return block["figure"];
    }
  }
  return {};
}

TEST(DiagnosisReport, TellsTheStoryInOrderFromTheOneArtefact) {
  const StudyFolder folder("diagnosis_fixture");
  const auto page = write_report(folder.path());
  ASSERT_TRUE(page) << page.error().message();
  EXPECT_EQ(page->page, folder.path() / "index.html");
  EXPECT_EQ(section_ids(folder),
            (std::vector<std::string>{
                "recordings", "verdict", "differs-section", "left-out-section", "tried-section",
                "unseen-section", "confusable-section", "moved-section", "provenance-section"}));
  const std::string html = folder.text("index.html");
  EXPECT_TRUE(contains(html, "<p class=\"verdict\">Presliding hysteresis was left out:"));
  EXPECT_TRUE(contains(html, "explains less than presliding hysteresis"));
  EXPECT_TRUE(contains(html, "a factor of 0.46 (95 %: 0.43 to 0.49)"));
  EXPECT_TRUE(contains(html, "Record a sine of 0.2 deg at 0.5 Hz"));
  EXPECT_TRUE(contains(html, "Most of all b1, which moved from 65.6 to 22.1"));
  EXPECT_TRUE(checksum_holds(folder.text("report/report.json")));
}

TEST(DiagnosisReport, HasASummaryForPrint) {
  const StudyFolder folder("diagnosis_fixture");
  ASSERT_TRUE(write_report(folder.path()));
  EXPECT_TRUE(contains(folder.text("index.html"), "<a href=\"summary.html\">"));
  const std::string sheet = folder.text("summary.html");
  EXPECT_TRUE(contains(sheet, "<p class=\"verdict\">Presliding hysteresis was left out:"));
  EXPECT_TRUE(contains(sheet, "<td>presliding hysteresis</td><td class=\"n\">"));
  EXPECT_TRUE(contains(sheet, " Nm</td>")) << "a size in a unit";
  EXPECT_TRUE(contains(sheet, "Record next: "));
  const bool drawn = contains(sheet, "Figures are drawn by node");
  EXPECT_TRUE(drawn || contains(sheet, "Figure 3."));
}

TEST(DiagnosisReport, GivesTheSameBytesAgain) {
  const StudyFolder folder("diagnosis_fixture");
  ASSERT_TRUE(write_report(folder.path()));
  const std::string page = folder.text("index.html");
  ASSERT_TRUE(write_report(folder.path()));
  EXPECT_TRUE(folder.text("index.html") == page);
}

TEST(DiagnosisReport, BeginsWithTheWorstRecordingAndMarksWhereItDiffers) {
  const StudyFolder folder("diagnosis_fixture");
  ASSERT_TRUE(write_report(folder.path()));
  const ordered_json figure = figure_of(folder, "mismatch");
  EXPECT_EQ(figure["frames"].size(), 4u);
  const ordered_json& first = figure["frames"][0];
  EXPECT_EQ(first["choice"][0], "sine-a0.20-f0.05 (held out)");
  EXPECT_EQ(first["panels"][1]["spans"], ordered_json::parse("[[3.5,7.5],[13.5,17.5]]"));
  const ordered_json& marked = first["panels"][0]["series"].back();
  EXPECT_EQ(marked["role"], "highlight");
  std::size_t inside = 0;
  for (const ordered_json& value : marked["y"]) inside += value.is_null() ? 0 : 1;
  EXPECT_NEAR(static_cast<double>(inside) / static_cast<double>(marked["y"].size()), 8.0 / 40.0,
              0.02);
  EXPECT_FALSE(figure["frames"][1]["panels"][1].contains("spans"));
}

TEST(DiagnosisReport, ShowsHostileStringsWithoutRunningThem) {
  const StudyFolder folder("diagnosis_fixture");
  ASSERT_TRUE(write_report(folder.path()));
  const std::string html = folder.text("index.html");
  EXPECT_FALSE(contains(markup_of(html), "<img"));
  EXPECT_FALSE(contains(markup_of(html), "<b>"));
  EXPECT_FALSE(contains(html, "<img src=x"));
}

TEST(DiagnosisReport, ShowsNumbersThatDoNotExistAsDashes) {
  const StudyFolder folder("diagnosis_fixture");
  ASSERT_TRUE(write_report(folder.path()));
  const std::string markup = markup_of(folder.text("index.html"));
  EXPECT_FALSE(contains(markup, ">nan") || contains(markup, " nan"));
  EXPECT_TRUE(contains(markup, "<td class=\"n\">–</td>"));
}

TEST(DiagnosisReport, DrawsWhatIsLeftWithoutAName) {
  const StudyFolder folder("diagnosis_fixture");
  const auto unnamed = ordered_json::parse(R"({
    "coordinates": ["torsion", "velocity"], "equation": "torsion", "share": 0.8,
    "holdout_ratio": 0.6, "ci95": [0.5, 0.7], "proposed_equation": null, "says": "<b>Left</b>",
    "table": {"unit": "Nm", "torque": [1, 2, 3, 4, 5, 6],
              "axes": [{"coordinate": "torsion", "unit": "deg", "values": [-1, 0, 1]},
                       {"coordinate": "velocity", "unit": "deg/s", "values": [-2, 2]}]}})");
  change(folder, "diagnosis.json", [&](ordered_json& json) { json["unnamed"] = unnamed; });
  ASSERT_TRUE(write_report(folder.path()));
  const ordered_json series = figure_of(folder, "unnamed")["frames"][0]["panels"][0]["series"];
  ASSERT_EQ(series.size(), 2u) << "a line a knot of the second coordinate";
  EXPECT_EQ(series[1]["name"], "velocity 2 deg/s");
  EXPECT_EQ(series[0]["x"], ordered_json::parse("[-1, 0, 1]"));
  EXPECT_EQ(series[1]["y"], ordered_json::parse("[2, 4, 6]"));
  EXPECT_FALSE(contains(markup_of(folder.text("index.html")), "<b>Left"));

  change(folder, "diagnosis.json",
         [](ordered_json& json) { json["unnamed"]["table"]["torque"].erase(0); });
  ASSERT_TRUE(write_report(folder.path()));
  EXPECT_TRUE(figure_of(folder, "unnamed").is_null()) << "numbers that do not fit their axes";
}

TEST(DiagnosisReport, OfAnAdequateBaselineSaysSoAndDrawsOneModel) {
  const StudyFolder folder("diagnosis_fixture");
  change(folder, "diagnosis.json", [](ordered_json& json) {
    json["verdict"] = "adequate";
    json["says"] = "";
    for (const char* list : {"mismatch", "causes", "confusable", "moved", "notes"}) {
      json[list] = ordered_json::array();
    }
    json["next_experiment"] = nullptr;
    json["holdout"]["rmse_after_nm"] = json["holdout"]["rmse_before_nm"];
    for (ordered_json& one : json["series"]) one["after"] = one["before"];
  });
  ASSERT_TRUE(write_report(folder.path()));
  EXPECT_EQ(section_ids(folder), (std::vector<std::string>{
                                     "recordings", "verdict", "differs-section", "left-out-section",
                                     "tried-section", "unseen-section", "provenance-section"}));
  const std::string markup = markup_of(folder.text("index.html"));
  EXPECT_TRUE(contains(markup, "Adequate: the baseline explains"));
  EXPECT_TRUE(contains(markup, "none was accepted"));
  EXPECT_TRUE(contains(markup, "Nothing was added that could change it."));
  EXPECT_FALSE(contains(markup, "dashed line") || contains(markup, "misfit removed"));
  EXPECT_EQ(figure_of(folder, "mismatch")["frames"][0]["panels"][0]["series"].size(), 2u);
}

TEST(DiagnosisReport, OfAPartWithoutANameShowsWhatItBrings) {
  const StudyFolder folder("diagnosis_fixture");
  change(folder, "diagnosis.json", [](ordered_json& json) {
    json["verdict"] = "unexplained";
    json["causes"] = ordered_json::array();
  });
  ASSERT_TRUE(write_report(folder.path()));
  const std::string markup = markup_of(folder.text("index.html"));
  EXPECT_TRUE(contains(markup, "The model has a part without a name"));
  EXPECT_TRUE(contains(markup, "with the missing physics"));
  EXPECT_TRUE(contains(markup, "dashed line"));
  EXPECT_FALSE(contains(markup, "Nothing was added that could change it."));
}

TEST(DiagnosisReport, SpellsAlternativesThatWereNotTriedAsWords) {
  const StudyFolder folder("diagnosis_fixture");
  change(folder, "diagnosis.json", [](ordered_json& json) {
    json["causes"][0]["alternatives"] = {"motor_torque_ripple"};
    json["says"] = "it could be motor_torque_ripple";
  });
  ASSERT_TRUE(write_report(folder.path()));
  EXPECT_TRUE(
      contains(folder.text("index.html"), "<p class=\"verdict\">It could be motor torque ripple."));
}

TEST(DiagnosisReport, HighlightsAStretchThatSeveralMismatchesShareOnce) {
  const StudyFolder folder("diagnosis_fixture");
  change(folder, "diagnosis.json", [](ordered_json& json) {
    json["mismatch"][1]["interval_s"] = {6.0, 9.0};
  });
  ASSERT_TRUE(write_report(folder.path()));
  EXPECT_EQ(figure_of(folder, "mismatch")["frames"][0]["panels"][1]["spans"],
            ordered_json::parse("[[3.5,9.0]]"));
}

TEST(DiagnosisReport, OffersToSimulateOnlyAModelThatIsThere) {
  const StudyFolder folder("diagnosis_fixture");
  ASSERT_TRUE(write_report(folder.path()));
  EXPECT_TRUE(contains(folder.text("index.html"), "flexspline simulate DIR/model.toml"));
  change(folder, "diagnosis.json", [](ordered_json& json) { json["model"] = nullptr; });
  ASSERT_TRUE(write_report(folder.path()));
  EXPECT_FALSE(contains(folder.text("index.html"), "flexspline simulate"));
}

TEST(DiagnosisReport, LetsOneChooseTheEquationWhereThereAreSeveral) {
  const StudyFolder folder("diagnosis_fixture");
  change(folder, "diagnosis.json", [](ordered_json& json) {
    json["series"][1]["recording"] = json["series"][0]["recording"];
    json["series"][1]["equation"] = "motor";
  });
  ASSERT_TRUE(write_report(folder.path()));
  const ordered_json figure = figure_of(folder, "mismatch");
  EXPECT_EQ(figure["pickers"], ordered_json::parse(R"(["recording", "equation"])"));
  EXPECT_EQ(figure["frames"][2]["choice"], ordered_json::parse(R"(["sine-slow", "motor"])"));
}

TEST(DiagnosisReport, DrawsWhatAVelocityOrdersOverTheVelocity) {
  const StudyFolder folder("diagnosis_fixture");
  change(folder, "diagnosis.json",
         [](ordered_json& json) { json["mismatch"][0]["coordinate"] = "velocity"; });
  ASSERT_TRUE(write_report(folder.path()));
  const ordered_json figure = figure_of(folder, "over-velocity");
  ASSERT_FALSE(figure.is_null());
  EXPECT_EQ(figure["frames"][0]["panels"][0]["x"]["label"], "velocity / deg/s");
  EXPECT_EQ(figure["frames"][0]["panels"][0]["series"].size(), 2u);
}

TEST(DiagnosisReport, RefusesADiagnosisThatWasChanged) {
  const StudyFolder folder("diagnosis_fixture");
  std::string text = folder.text("diagnosis.json");
  text.replace(text.find("0.98"), 4, "0.99");
  ASSERT_TRUE(write_file(folder.path() / "diagnosis.json", text));
  const auto page = write_report(folder.path());
  ASSERT_FALSE(page);
  EXPECT_EQ(page.error().code, ErrorCode::bad_data);
  EXPECT_TRUE(contains(page.error().message(), "diagnosis.json: its checksum does not hold"));
}

TEST(TrialReport, ShowsScoresConfusionAndEveryCase) {
  const StudyFolder folder("trial_fixture");
  const auto page = write_report(folder.path());
  ASSERT_TRUE(page) << page.error().message();
  EXPECT_EQ(page->page, folder.path() / "report" / "index.html");
  EXPECT_EQ(section_ids(folder),
            (std::vector<std::string>{"verdict", "confusion-section", "detection-section",
                                      "cases-section", "provenance-section"}));
  const std::string markup = markup_of(folder.text("report/index.html"));
  EXPECT_TRUE(contains(markup, "called adequate in 15 of 15 (95 %: 78.2 to 100 %)"));
  EXPECT_TRUE(contains(markup, "2 of 4 answers are right in full."));
  EXPECT_TRUE(
      contains(folder.text("tables/trial-wrong.csv"),
               "case-0002,locked,viscoelastic creep,3.0,1.8,explained: presliding hysteresis"));
  EXPECT_FALSE(contains(markup, "<img"));
}

// The fixture with groups, printed probabilities and splices, as newer trials have them.
TEST(TrialReport, ShowsWhatAPrintedProbabilityIsWorth) {
  const StudyFolder folder("trial_fixture");
  const ordered_json rate = {{"count", 45}, {"of", 60}, {"rate", 0.75}, {"ci95", {0.63, 0.84}}};
  change(folder, "trial.json", [&rate](ordered_json& trial) {
    trial["reliability"] = ordered_json::array(
        {{{"from", 0.9}, {"to", 0.95}, {"mean_probability", 0.92}, {"right", rate}}});
    trial["by_generator"]["mujoco"]["rates"]["null_ok"] = rate;
    trial["by_disturbance"]["coloured_noise"]["rates"]["false_name"] = rate;
    trial["coverage"]["all"] = rate;
    trial["by_verdict"] = ordered_json::array(
        {{{"verdict", "adequate"}, {"cases", 9}, {"holdout_over_noise_median", 1.1}}});
    trial["splices"]["found_large"] = rate;
  });
  const auto page = write_report(folder.path());
  ASSERT_TRUE(page) << page.error().message();
  const ordered_json panel = figure_of(folder, "reliability")["frames"][0]["panels"][0];
  EXPECT_EQ(panel["series"][0]["x"][0], 92.0);
  EXPECT_EQ(panel["series"][0]["y"][0], 75.0);
  EXPECT_TRUE(contains(folder.text("tables/trial-by-disturbance.csv"), "coloured noise"));
  EXPECT_TRUE(contains(folder.text("tables/trial-by-generator.csv"), "mujoco"));
  EXPECT_TRUE(contains(folder.text("tables/trial-splices.csv"), "45"));
  EXPECT_TRUE(contains(folder.text("tables/trial-by-verdict.csv"), "1.1"));
}

TEST(TrialReport, TicksRightNamesInTheConfusionAndNoOthers) {
  const StudyFolder folder("trial_fixture");
  ASSERT_TRUE(write_report(folder.path()));
  const ordered_json panel = figure_of(folder, "confusion")["frames"][0]["panels"][0];
  const auto& rows = panel["y"]["categories"];
  const auto& columns = panel["x"]["categories"];
  EXPECT_EQ(rows.back(), "nothing");
  EXPECT_EQ(columns.front(), "adequate");
  EXPECT_EQ(columns.back(), "failed");
  std::size_t ticked = 0;
  for (const ordered_json& cell : panel["cells"]) {
    const auto& named = columns.at(cell[0].get<std::size_t>());
    const auto& hidden = rows.at(cell[1].get<std::size_t>());
    const bool right = named == hidden || (hidden == "nothing" && named == "adequate") ||
                       (hidden == "unknown:cross" && named == "no name");
    EXPECT_EQ(cell[3], right ? "right" : "") << hidden << " as " << named;
    ticked += right ? 1 : 0;
  }
  EXPECT_EQ(ticked, 15u);
}

TEST(TrialReport, SharesOfASizeAreThoseOfItsCases) {
  const StudyFolder folder("trial_fixture");
  ASSERT_TRUE(write_report(folder.path()));
  const ordered_json series = figure_of(folder, "detection")["frames"][0]["panels"][0]["series"];
  EXPECT_EQ(series[0]["x"][0], 2.5);
  EXPECT_EQ(series[0]["y"][0], 87.5);
  EXPECT_EQ(series[1]["y"][0], 75.0);
}

TEST(TrialReport, ShowsWhatIsLeftOfAnEffectBesideItsSize) {
  const StudyFolder folder("trial_fixture");
  ASSERT_TRUE(write_report(folder.path()));
  const ordered_json panel = figure_of(folder, "detection")["frames"][0]["panels"][1];
  EXPECT_EQ(panel["series"][0]["x"][1], 0.6);
  EXPECT_EQ(panel["series"][0]["y"][1], 75.0);
  EXPECT_EQ(figure_of(folder, "rates")["frames"][0]["panels"][0]["series"][2]["name"],
            "of those that can be seen");
  EXPECT_TRUE(contains(folder.text("tables/trial-cases.csv"), "backlash,5.0,3.0,explained"));
}

TEST(VerificationReport, SaysWhatDiffersAndWhatMayExplainIt) {
  const StudyFolder folder("verification_fixture");
  const auto page = write_report(folder.path());
  ASSERT_TRUE(page) << page.error().message();
  EXPECT_EQ(page->page, folder.path() / "index.html");
  EXPECT_EQ(section_ids(folder),
            (std::vector<std::string>{"verdict", "explained-section", "checked-section"}));
  EXPECT_TRUE(contains(folder.text("index.html"), "It does not hold. Of 5 artefacts"));
  EXPECT_TRUE(contains(folder.text("tables/changed.csv"), "seed,seeds,[1],[2]"));
  const std::string differences = folder.text("tables/differences.csv");
  EXPECT_TRUE(contains(differences, "estimate/parameters/a1/value,parameter,14.1,14.2,90"));
  EXPECT_TRUE(contains(differences, "cases/gone.json,\"only the other run has it"));
  EXPECT_FALSE(contains(differences, "estimate/cost")) << "rounding is no difference to explain";
  EXPECT_FALSE(contains(markup_of(folder.text("index.html")), "<img"));
}

TEST(VerificationReport, IsQuietWhereEveryBitAgrees) {
  const StudyFolder folder("verification_fixture");
  change(folder, "verification.json", [](ordered_json& artefact) {
    artefact["holds"] = true;
    artefact["changed"] = ordered_json::array();
    artefact["artefacts"] = {artefact["artefacts"][0]};
  });
  ASSERT_TRUE(write_report(folder.path()));
  EXPECT_TRUE(contains(folder.text("index.html"), "<p class=\"verdict\">Nothing is.</p>"));
  EXPECT_TRUE(figure_of(folder, "differences").is_null());
}

TEST(DiagnosisReport, OrdersWhatIsLeftByEveryCoordinate) {
  const StudyFolder folder("diagnosis_fixture");
  ASSERT_TRUE(write_report(folder.path()));
  const ordered_json figure = figure_of(folder, "ordered-residuals");
  ASSERT_FALSE(figure.is_null());
  std::vector<std::string> titles;
  for (const auto& panel : figure["frames"][0]["panels"]) titles.push_back(panel["title"]);
  EXPECT_EQ(titles, (std::vector<std::string>{"by time", "by torsion", "by velocity", "by load",
                                              "by order of the motor"}));
}

}  // namespace
}  // namespace flexspline::reports
