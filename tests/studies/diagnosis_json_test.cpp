#include "flexspline/studies/diagnosis_json.hpp"

#include <numbers>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "flexspline/data/estimate_json.hpp"

namespace flexspline::studies {
namespace {

using nlohmann::ordered_json;

constexpr double kDegree = std::numbers::pi / 180.0;

Diagnosis example() {
  Diagnosis diagnosis;
  diagnosis.dataset = "case-017";
  diagnosis.sha256 = "abc";
  diagnosis.baseline_model = "f, g, h full trajectory";
  diagnosis.baseline_rmse_train = 0.31;
  diagnosis.baseline_rmse_holdout = 0.33;
  diagnosis.noise_std = 0.14;
  diagnosis.verdict = Verdict::explained;
  diagnosis.says = "Presliding hysteresis was left out.";
  diagnosis.mismatch = {{"sine", 12.1, 14.0, "reversal_memory", "torsion", 0.41, "it lags"}};
  Cause cause;
  cause.effect = "presliding_hysteresis";
  cause.probability = 0.98;
  cause.size_fraction = 0.034, cause.size = 1.31, cause.unit = "Nm";
  cause.size_of = "the largest torque across the transmission";
  cause.equation = "z' = ...";
  cause.alternatives = {"viscoelastic_creep"};
  cause.parameters = {{"breakaway", 0.11 * kDegree, 0.004 * kDegree, "rad"},
                      {"stiffness", 800.0, 4.0, "Nm/rad"}};
  cause.parameters[0].ci95_lower = 0.102 * kDegree,
  cause.parameters[0].ci95_upper = 0.118 * kDegree;
  cause.parameters[0].meaning = "way after which it slips";
  cause.parameters[1].no_interval = "of a fixed grid, not fitted";
  cause.evidence = {1e-9, 0.46, -812.0, 2.2, 0.99};
  diagnosis.causes = {cause};
  diagnosis.confusable = {{"presliding_hysteresis", "viscoelastic_creep", 0.71, "both lag"}};
  diagnosis.tried = {{"backlash", 1, 0.2, -10.0, 0.97, "explains less"}};
  diagnosis.moved = {{"b1", 30.0, 10.0, 1.0, "Nm s/rad"}};
  diagnosis.holdout = {0.33, 0.15, 0.46, 0.43, 0.49, 0.14};
  diagnosis.next_experiment =
      NextExperiment{{"a", "b"}, "sine", 0.2 * kDegree, 0.5, 7.0, "Record a sine."};
  diagnosis.series = {{"sine",
                       Split::holdout,
                       "torsion",
                       {0.0, 1.0},
                       {kDegree, 2.0 * kDegree},
                       {0.0, kDegree},
                       {1.0, 2.0},
                       {1.1, 2.1},
                       {1.0, kNotComputed}}};
  diagnosis.notes = {"one recording has no valid sample"};
  diagnosis.mistaken = {{"check_units", "load_inertia", data::Severity::warning, "sine",
                         "torque over acceleration is 57.3 times the inertia", "check the units"}};
  return diagnosis;
}

std::set<std::string> keys_of(const ordered_json& object) {
  std::set<std::string> keys;
  for (const auto& item : object.items()) keys.insert(item.key());
  return keys;
}

void expect_keys(const ordered_json& object, const std::set<std::string>& keys) {
  const std::set<std::string> found = keys_of(object);
  for (const std::string& key : keys) EXPECT_TRUE(found.contains(key)) << key;
}

TEST(DiagnosisJson, HasEveryKeyOfTheContract) {
  const ordered_json json = to_json(example());
  EXPECT_EQ(json.begin().key(), "schema");
  EXPECT_EQ(json["schema"], "flexspline-diagnosis/1");
  expect_keys(json, {"dataset", "baseline", "verdict", "mismatch", "causes", "confusable",
                     "holdout", "next_experiment"});
  EXPECT_EQ(keys_of(json["dataset"]), (std::set<std::string>{"name", "sha256"}));
  expect_keys(json["baseline"], {"model", "rmse_nm", "noise_std_nm"});
  EXPECT_EQ(keys_of(json["baseline"]["rmse_nm"]), (std::set<std::string>{"train", "holdout"}));
  expect_keys(json["mismatch"][0],
              {"recording", "interval_s", "coordinate", "share_of_excess", "says"});
  expect_keys(json["causes"][0], {"effect", "probability", "size_fraction", "size", "unit",
                                  "size_of", "equation", "parameters", "alternatives", "evidence"});
  expect_keys(json["causes"][0]["parameters"][0],
              {"name", "value", "std", "ci95", "unit", "meaning"});
  expect_keys(json["holdout"], {"nested", "recordings", "over_noise"});
  expect_keys(json["causes"][0]["evidence"], {"score_p_value", "holdout_rmse_ratio", "delta_bic"});
  expect_keys(json["confusable"][0], {"effect", "similarity", "why"});
  expect_keys(json["holdout"],
              {"rmse_before_nm", "rmse_after_nm", "ratio", "ci95", "noise_floor_nm"});
  expect_keys(json["next_experiment"],
              {"separates", "excitation", "amplitude_deg", "frequency_hz"});
}

TEST(DiagnosisJson, ShowsAnglesInDegreesAndTorqueInNewtonMetres) {
  const ordered_json json = to_json(example());
  const ordered_json& parameters = json["causes"][0]["parameters"];
  EXPECT_NEAR(parameters[0]["value"].get<double>(), 0.11, 1e-15);
  EXPECT_NEAR(parameters[0]["std"].get<double>(), 0.004, 1e-15);
  EXPECT_EQ(parameters[0]["unit"], "deg");
  EXPECT_NEAR(parameters[1]["value"].get<double>(), 800.0 * kDegree, 1e-12);
  EXPECT_EQ(parameters[1]["unit"], "Nm/deg");
  EXPECT_NEAR(json["moved"][0]["before"].get<double>(), 30.0 * kDegree, 1e-13);
  EXPECT_NEAR(json["next_experiment"]["amplitude_deg"].get<double>(), 0.2, 1e-15);
  EXPECT_NEAR(json["series"][0]["motion"][1].get<double>(), 2.0, 1e-14);
  EXPECT_NEAR(json["series"][0]["rate"][1].get<double>(), 1.0, 1e-14);
  EXPECT_EQ(json["holdout"]["rmse_before_nm"], 0.33);
}

TEST(DiagnosisJson, AParameterHasAnIntervalOrSaysWhyNot) {
  const ordered_json parameters = to_json(example())["causes"][0]["parameters"];
  EXPECT_NEAR(parameters[0]["ci95"][0].get<double>(), 0.102, 1e-12);
  EXPECT_FALSE(parameters[0].contains("no_interval"));
  EXPECT_TRUE(parameters[1]["ci95"].is_null());
  EXPECT_EQ(parameters[1]["no_interval"], "of a fixed grid, not fitted");
}

TEST(DiagnosisJson, NotesHaveACode) {
  const ordered_json notes = to_json(example())["notes"];
  ASSERT_EQ(notes.size(), 2U);
  EXPECT_EQ(notes[0]["code"], "check_units");
  EXPECT_EQ(notes[0]["recording"], "sine");
  EXPECT_NE(notes[0]["says"].get<std::string>().find("57.3"), std::string::npos);
  EXPECT_EQ(notes[1]["code"], "remark");
  EXPECT_EQ(notes[1]["says"], "one recording has no valid sample");
}

TEST(DiagnosisJson, KeepsTheKeysOfALinearSpecimenAndSaysItsUnits) {
  Diagnosis diagnosis = example();
  diagnosis.display = {"mm", "N"};
  const ordered_json json = to_json(diagnosis);
  EXPECT_EQ(json["units"],
            ordered_json({{"motion", "mm"}, {"rate", "mm/s"}, {"effort", "N"}, {"rmse", "N"}}));
  EXPECT_EQ(json["holdout"]["rmse_before_nm"], 0.33);
  EXPECT_TRUE(json["next_experiment"]["amplitude_deg"].is_null());
  EXPECT_NEAR(json["next_experiment"]["amplitude"].get<double>(), 200.0 * kDegree, 1e-12);
  const auto& parameters = json["causes"][0]["parameters"];
  EXPECT_EQ(parameters[0]["unit"], "m");
  EXPECT_EQ(parameters[0]["value"], 0.11 * kDegree);
  EXPECT_EQ(parameters[1]["unit"], "N/m");
  EXPECT_EQ(parameters[1]["value"], 800.0);
  EXPECT_EQ(json["moved"][0]["unit"], "N s/m");
}

TEST(DiagnosisJson, WritesWhatWasNotComputedAsNull) {
  Diagnosis diagnosis;
  diagnosis.mismatch.emplace_back();
  diagnosis.causes.emplace_back().parameters.emplace_back();
  diagnosis.confusable.emplace_back();
  diagnosis.tried.emplace_back();
  diagnosis.moved.emplace_back();
  diagnosis.series.push_back({"a", Split::train, "torsion", {0.0}, {}, {}, {kNotComputed}, {}, {}});
  const ordered_json json = to_json(diagnosis);
  EXPECT_TRUE(json["next_experiment"].is_null());
  for (const char* pointer :
       {"/baseline/noise_std_nm", "/baseline/rmse_nm/train", "/mismatch/0/interval_s/0",
        "/mismatch/0/share_of_excess", "/causes/0/probability", "/causes/0/parameters/0/value",
        "/causes/0/evidence/score_p_value", "/confusable/0/similarity", "/tried/0/delta_bic",
        "/moved/0/after", "/holdout/ratio", "/holdout/ci95/1", "/series/0/measured/0"}) {
    EXPECT_TRUE(json.at(ordered_json::json_pointer(pointer)).is_null()) << pointer;
  }
}

// Angles of a table in degrees, its torque as it is; a formula stays in SI.
TEST(DiagnosisJson, HasWhatIsLeftWithoutANameWhereATableShowsIt) {
  Diagnosis diagnosis = example();
  EXPECT_FALSE(to_json(diagnosis).contains("unnamed"));
  UnnamedPart part;
  part.axes = {{"torsion", "rad", {-kDegree, kDegree}}, {"direction", "1", {-1.0, 1.0}}};
  part.torque = {1.0, 2.0, 3.0, 4.0};
  part.holdout_ratio = 0.4;
  diagnosis.unnamed = part;
  ordered_json json = to_json(diagnosis)["unnamed"];
  expect_keys(json, {"coordinates", "share", "holdout_ratio", "table", "proposed_equation"});
  EXPECT_EQ(json["coordinates"], (ordered_json{"torsion", "direction"}));
  EXPECT_NEAR(json["table"]["axes"][0]["values"][1].get<double>(), 1.0, 1e-15);
  EXPECT_EQ(json["table"]["axes"][0]["unit"], "deg");
  EXPECT_EQ(json["table"]["axes"][1]["values"], (ordered_json{-1.0, 1.0}));
  EXPECT_EQ(json["table"]["torque"], (ordered_json{1.0, 2.0, 3.0, 4.0}));
  EXPECT_TRUE(json["proposed_equation"].is_null());
  EXPECT_TRUE(json["share"].is_null()) << "not computed";
  diagnosis.unnamed->proposed_equation = "tau += 2 phi";
  diagnosis.display = {"mm", "N"};
  json = to_json(diagnosis)["unnamed"];
  EXPECT_EQ(json["proposed_equation"], "tau += 2 phi");
  EXPECT_EQ(json["table"]["axes"][0]["unit"], "m");
  EXPECT_EQ(json["table"]["unit"], "N");
}

TEST(DiagnosisJson, HoldsTheModelToTheLastBitWhereThereIsOne) {
  Diagnosis diagnosis;
  EXPECT_TRUE(to_json(diagnosis)["model"].is_null());
  diagnosis.model = RigModel{};
  EXPECT_EQ(to_json(diagnosis)["model"], data::to_json(*diagnosis.model));
}

struct Conversion {
  const char* from;
  const char* to;
  int radians;  ///< power of rad in the unit
};

class InDegrees : public testing::TestWithParam<Conversion> {};

TEST_P(InDegrees, ConvertsEveryRadianByThePowerItStandsIn) {
  const auto [factor, unit] = in_degrees(GetParam().from);
  EXPECT_EQ(unit, GetParam().to);
  EXPECT_NEAR(factor * std::pow(kDegree, GetParam().radians), 1.0, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(
    Units, InDegrees,
    testing::Values(Conversion{"rad", "deg", 1}, Conversion{"rad/s", "deg/s", 1},
                    Conversion{"Nm/rad", "Nm/deg", -1}, Conversion{"Nm s/rad", "Nm s/deg", -1},
                    Conversion{"Nm/(rad/s)", "Nm/(deg/s)", -1},
                    Conversion{"Nm/(s/rad)", "Nm/(s/deg)", 1},
                    Conversion{"Nm/rad^3", "Nm/deg^3", -3}, Conversion{"rad^-2", "deg^-2", -2},
                    Conversion{"Nm", "Nm", 0}, Conversion{"grad", "grad", 0}, Conversion{"", "", 0},
                    Conversion{"rad^", "deg^", 1}));

}  // namespace
}  // namespace flexspline::studies
