#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "conceal_fixture.hpp"
#include "flexspline/studies/trial.hpp"
#include "source_dir.hpp"

namespace flexspline::studies {
namespace {

using testing::HasSubstr;

/// A sound file with one piece made bad, and what has to be said of it, where.
struct BadToml {
  const char* name;
  const char* piece;
  const char* instead;
  const char* place;  ///< ":line:column"
  const char* words;
};

std::string name_of(const testing::TestParamInfo<BadToml>& info) { return info.param.name; }

const std::string kBench = R"(schema = "flexspline-bench/1"
rig = "locked"
seed = 7
effects = [{ id = "backlash", size_fraction = 0.05 }]

[[excitation]]
motion = "sine"
amplitude = { value = 0.2, unit = "deg" }
frequency = { value = 0.05, unit = "Hz" }
cycles = 2.5
samples = 400

[nuisances]
torque_noise = { value = 0.4, unit = "%" }
)";

const std::string kTrial = R"(schema = "flexspline-trial/1"
name = "small"
seed = 3
rigs = ["locked", "free"]
cases = 12
time_limit = { value = 1, unit = "min" }

[draw]
none = 0.5
one = 0.5
size_fraction = [0.02, 0.1]
effects = ["backlash", "sensor_delay"]
)";

std::string with(std::string text, const std::string& piece, const std::string& instead) {
  const auto at = text.find(piece);
  EXPECT_NE(at, std::string::npos) << piece;
  return at == std::string::npos ? text : text.replace(at, piece.size(), instead);
}

void expect_one(const std::vector<data::Finding>& findings, const std::string& file,
                const BadToml& bad) {
  ASSERT_EQ(findings.size(), 1U) << (findings.empty() ? "nothing" : findings.back().message());
  EXPECT_THAT(findings[0].message(), HasSubstr(file + bad.place + ": "));
  EXPECT_THAT(findings[0].message(), HasSubstr(bad.words));
}

class BadBench : public testing::TestWithParam<BadToml> {};

TEST_P(BadBench, IsRefusedNamingThePlace) {
  const ScratchFolder folder;
  const auto file = folder.write("bench.toml", with(kBench, GetParam().piece, GetParam().instead));
  const auto reading = read_conceal_plan(file);
  ASSERT_TRUE(reading.has_value());
  EXPECT_FALSE(reading->plan.has_value());
  expect_one(reading->errors, file.string(), GetParam());
}

const BadToml kBadBenches[] = {
    {"syntax", "seed = 7", "seed = = 7", ":3:8", "not TOML"},
    {"schema", "bench/1", "bench/2", ":1:10", "write schema = \"flexspline-bench/1\""},
    {"rig", "\"locked\"", "\"lokced\"", ":2:7", "did you mean 'locked'?"},
    {"key", "seed", "sede", ":3:1", "did you mean 'seed'?"},
    {"no_effects", "effects = [{ id = \"backlash\", size_fraction = 0.05 }]", "", ":1:1",
     "write effects = []"},
    {"word", "[{ id = \"backlash\", size_fraction = 0.05 }]", "\"drawn\"", ":4:11",
     "write \"draw\""},
    {"effect", "\"backlash\"", "\"backlahs\"", ":4:19", "did you mean 'backlash'?"},
    {"effect_of_another_rig", "\"backlash\"", "\"kinematic_error\"", ":4:19",
     "rig 'locked' cannot conceal effect 'kinematic_error'"},
    {"size", "0.05 }]", "0.7 }]", ":4:47", "give a number between 0 and 0.5"},
    {"size_absent", ", size_fraction = 0.05", "", ":4:19", "'effects[1].size_fraction' is missing"},
    {"effect_key", "size_fraction = 0.05", "size_fraction = 0.05, sise = 1", ":4:53",
     "unknown key 'effects[1].sise'"},
    {"effect_twice", "}]", "}, { id = \"backlash\", size_fraction = 0.02 }]", ":4:62",
     "hidden twice"},
    {"motion", "\"sine\"", "\"sin\"", ":7:10", "did you mean 'sine'?"},
    {"amplitude_unit", "unit = \"deg\"", "unit = \"Nm\"", ":8:35", "is a unit of torque"},
    {"amplitude_absent", "amplitude = { value = 0.2, unit = \"deg\" }", "", ":6:1",
     "'excitation[1].amplitude' is missing"},
    {"samples", "samples = 400", "samples = 4", ":11:11", "between 16 and"},
    {"nuisance", "torque_noise", "torque_nois", ":14:1", "did you mean 'torque_noise'?"},
    {"draw_beside_effects", "[nuisances]", "[draw]\none = 1\n[nuisances]", ":13:1",
     "[draw] beside listed effects"},
};

INSTANTIATE_TEST_SUITE_P(Conceal, BadBench, testing::ValuesIn(kBadBenches), name_of);

class BadTrial : public testing::TestWithParam<BadToml> {};

TEST_P(BadTrial, IsRefusedNamingThePlace) {
  const ScratchFolder folder;
  const auto file = folder.write("trial.toml", with(kTrial, GetParam().piece, GetParam().instead));
  const auto reading = read_trial(file);
  ASSERT_TRUE(reading.has_value());
  EXPECT_FALSE(reading->trial.has_value());
  expect_one(reading->errors, file.string(), GetParam());
}

const BadToml kBadTrials[] = {
    {"schema", "trial/1", "study/1", ":1:10", "write schema = \"flexspline-trial/1\""},
    {"name", "name = \"small\"", "", ":1:1", "'name' is missing"},
    {"rig", "\"free\"", "\"fre\"", ":4:8", "did you mean 'free'?"},
    {"rig_twice", "\"free\"", "\"locked\"", ":4:8", "stands there twice"},
    {"no_rig", "[\"locked\", \"free\"]", "[]", ":4:8", "the trial has no rig"},
    {"cases", "12", "0", ":5:9", "between 1 and 10000"},
    {"cases_absent", "cases = 12", "", ":1:1", "'cases' is missing"},
    {"time_limit", "unit = \"min\"", "unit = \"Hz\"", ":6:34", "is a unit of frequency"},
    {"probability", "none = 0.5", "none = -1", ":9:8", "out of range"},
    {"draw_key", "none = 0.5", "non = 0.5", ":9:1", "did you mean 'none'?"},
    {"size_range", "[0.02, 0.1]", "[0.1, 0.02]", ":11:17", "not a range of sizes"},
    {"effect", "\"sensor_delay\"", "\"sensor_dealy\"", ":12:11", "did you mean 'sensor_delay'?"},
    {"no_effect_for_rig", "[\"backlash\", \"sensor_delay\"]", "[\"gravity_load\"]", ":12:11",
     "rig 'locked' can conceal none of these effects"},
    {"no_pair_for_rig",
     "one = 0.5\nsize_fraction = [0.02, 0.1]\neffects = [\"backlash\", "
     "\"sensor_delay\"]",
     "two = 0.5\neffects = [\"backlash\"]", ":11:11",
     "rig 'locked' has no two of these effects that differ"},
};

INSTANTIATE_TEST_SUITE_P(Trial, BadTrial, testing::ValuesIn(kBadTrials), name_of);

TEST(ConcealPlanFile, IsReadInSi) {
  const ScratchFolder folder;
  const auto plan = load_conceal_plan(folder.write("bench.toml", kBench));
  ASSERT_TRUE(plan.has_value()) << plan.error().message();
  EXPECT_EQ(plan->seed, 7U);
  ASSERT_EQ(plan->design.size(), 1U);
  EXPECT_NEAR(plan->design[0].amplitude, 0.2 * 3.141592653589793 / 180.0, 1e-15);
  EXPECT_DOUBLE_EQ(plan->nuisances.at("torque_noise"), 0.004);
  const auto null_plan = load_conceal_plan(folder.write(
      "null.toml", with(kBench, "[{ id = \"backlash\", size_fraction = 0.05 }]", "[]")));
  ASSERT_TRUE(null_plan.has_value()) << null_plan.error().message();
  EXPECT_TRUE(null_plan->effects.empty());
  EXPECT_FALSE(null_plan->draw.has_value());
}

TEST(ConcealPlanFile, ShippedTrialsAreSound) {
  for (const char* name : {"trial.toml", "nulls.toml"}) {
    const auto trial = load_trial(std::string(FLEXSPLINE_SOURCE_DIR) + "/studies/" + name);
    EXPECT_TRUE(trial.has_value()) << trial.error().message();
  }
}

nlohmann::json schema(const std::string& name) {
  return nlohmann::json::parse(
      read_text(std::string(FLEXSPLINE_SOURCE_DIR) + "/data/schemas/" + name + ".schema.json"));
}

bool unknown_key(const std::vector<data::Finding>& findings) {
  return std::ranges::any_of(findings, [](const data::Finding& finding) {
    return finding.problem.find("unknown key") != std::string::npos;
  });
}

TEST(ConcealSchemas, NameOnlyKeysThatTheReadersKnow) {
  const ScratchFolder folder;
  const auto bench = [&](const std::string& text) {
    return unknown_key(read_conceal_plan(folder.write("b.toml", text))->errors);
  };
  const auto trial = [&](const std::string& text) {
    return unknown_key(read_trial(folder.write("t.toml", text))->errors);
  };
  const auto check = [](const auto& unknown, const std::string& table, const auto& properties) {
    EXPECT_TRUE(unknown(table + "no_such_key = 1\n"));
    for (const auto& [key, value] : properties.items()) {
      EXPECT_FALSE(unknown(table + key + " = 1\n")) << table << key;
    }
  };
  const auto bench_keys = schema("bench").at("properties");
  check(bench, "", bench_keys);
  check(bench, "[[excitation]]\n", bench_keys.at("excitation").at("items").at("properties"));
  const auto trial_keys = schema("trial").at("properties");
  check(trial, "", trial_keys);
  for (const char* table : {"draw", "nuisances"}) {
    check(bench, std::string("[") + table + "]\n", bench_keys.at(table).at("properties"));
    check(trial, std::string("[") + table + "]\n", trial_keys.at(table).at("properties"));
  }
}

}  // namespace
}  // namespace flexspline::studies
