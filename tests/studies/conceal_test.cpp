#include <cmath>
#include <set>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "conceal_fixture.hpp"
#include "flexspline/data/artefact.hpp"
#include "flexspline/data/commitment.hpp"

namespace flexspline::studies {
namespace {

using nlohmann::ordered_json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

const std::vector<data::HiddenEffect> kBacklash = {{"backlash", 0.05}};
const std::vector<data::HiddenEffect> kGain = {{"torque_sensor_gain", 0.04}};

std::vector<std::string> files_in(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) names.insert(relative(entry.path(), folder).string());
  }
  return {names.begin(), names.end()};
}

TEST(Conceal, DescriptionIsTheSameWhateverIsHidden) {
  const ScratchFolder folder;
  std::vector<std::string> descriptions;
  for (const auto& effects : {std::vector<data::HiddenEffect>{}, kBacklash, kGain}) {
    const auto where = folder.path() / std::to_string(descriptions.size());
    const auto written = write_concealed(where, concealed_case(small_plan(effects)), "salt-salt");
    ASSERT_TRUE(written.has_value()) << written.error().message();
    descriptions.push_back(read_text(where / "dataset" / "dataset.toml"));
  }
  EXPECT_EQ(descriptions[1], descriptions[0]);
  EXPECT_EQ(descriptions[2], descriptions[0]);
  EXPECT_THAT(descriptions[0], HasSubstr("name = \"case\""));
}

TEST(Conceal, KeepsTheAnswerBesideTheDataSetAndUnderSeal) {
  const ScratchFolder folder;
  const auto concealed = concealed_case(small_plan(kBacklash));
  ASSERT_TRUE(write_concealed(folder.path(), concealed, "salt-salt").has_value());
  for (const std::string& file : files_in(folder.path())) {
    if (file == "answer.sealed.json") continue;
    const std::string text = read_text(folder.path() / file);
    EXPECT_THAT(text, Not(HasSubstr("backlash"))) << file;
    EXPECT_THAT(text, Not(HasSubstr("salt-salt"))) << file;
  }
  const auto answer =
      data::unseal(folder.path() / "commitment.json", folder.path() / "answer.sealed.json");
  ASSERT_TRUE(answer.has_value()) << answer.error().message();
  EXPECT_EQ(answer->at("effects"), ordered_json({"backlash"}));
  EXPECT_EQ(answer->at("coordinate"), ordered_json({"torsion"}));
  EXPECT_NEAR(answer->at("size")[0].get<double>(), 0.05, 0.001) << "2 % of its size";
  const auto read = data::load_dataset(folder.path() / "dataset");
  ASSERT_TRUE(read.has_value()) << read.error().message();
  EXPECT_EQ(answer->at("dataset_sha256"), read->sha256);
}

TEST(Conceal, AnswerHasTheKeysOfPracticeCases) {
  const auto json = to_json(concealed_case(small_plan({})).answer);
  for (const char* key :
       {"rig", "effects", "size", "coordinate", "info", "noise_std_nm", "twins", "tau_max"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  EXPECT_TRUE(json.at("effects").empty());
}

TEST(Conceal, AnswerReadsBack) {
  auto answer = concealed_case(small_plan({{"unknown:cross", 0.03}, {"backlash", 0.05}})).answer;
  const auto read = answer_from_json(to_json(answer));
  ASSERT_TRUE(read.has_value()) << read.error().message();
  ASSERT_EQ(read->effects.size(), 2U);
  EXPECT_EQ(read->effects[1].id, "unknown:cross") << "by id";
  EXPECT_EQ(read->effects[1].coordinate, "") << "outside every catalogue";
  EXPECT_EQ(read->effects[0].size_fraction, answer.effects[0].size_fraction);
  EXPECT_EQ(read->noise_std, answer.noise_std);
  EXPECT_EQ(read->best_rmse, answer.best_rmse);
  EXPECT_EQ(read->at_output, answer.at_output);
  EXPECT_FALSE(answer_from_json(ordered_json::object()).has_value());
}

TEST(Conceal, IsDeterministicAndAnotherSeedIsAnotherDrive) {
  const auto one = concealed_case(small_plan(kBacklash));
  EXPECT_EQ(concealed_case(small_plan(kBacklash)).recordings.sha256, one.recordings.sha256);
  EXPECT_EQ(to_json(concealed_case(small_plan(kBacklash)).answer), to_json(one.answer));
  EXPECT_NE(concealed_case(small_plan(kBacklash, 6)).recordings.sha256, one.recordings.sha256);
}

TEST(Conceal, BestErrorIsTheNoiseThatFell) {
  ConcealPlan plan = small_plan(kBacklash);
  plan.nuisances["torque_noise"] = 0.01;
  const auto noisy = concealed_case(plan).answer;
  EXPECT_NEAR(noisy.noise_std, 0.01 * noisy.peak_torque, 1e-12);
  // 400 samples, some of them correlated: the rms is within a fifth of what it was set to.
  EXPECT_NEAR(noisy.best_rmse / noisy.noise_std, 1.0, 0.2);
  plan.nuisances["torque_noise"] = 0.0;
  EXPECT_EQ(concealed_case(plan).answer.best_rmse, 0.0);
}

TEST(Conceal, NamesStructuralTwinsWithTheAnswer) {
  EXPECT_THAT(concealed_case(small_plan(kGain)).answer.twins, ElementsAre("torque_constant_error"));
  EXPECT_TRUE(twins_of("torque_sensor_gain", Rig::free).empty()) << "the load is known there";
  EXPECT_THAT(twins_of("motor_torque_offset", Rig::free), ElementsAre("direction_asymmetry"));
  for (const StructuralTwin& row : structural_twins()) EXPECT_FALSE(row.reason.empty());
}

TEST(Conceal, DrawsEveryKind) {
  std::set<std::size_t> counts;
  bool unknown = false;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    ConcealPlan plan = small_plan({}, seed);
    plan.draw = ConcealDraw{.none = 1, .one = 1, .two = 1, .unknown = 1, .effects = {}};
    const auto effects = concealed_case(plan).answer.effects;
    counts.insert(effects.size());
    for (const auto& effect : effects) {
      unknown = unknown || effect.id.starts_with("unknown:");
      EXPECT_GT(effect.size_fraction, 0.98 * 0.02);
      EXPECT_LT(effect.size_fraction, 1.02 * 0.10);
    }
  }
  EXPECT_THAT(counts, ElementsAre(0U, 1U, 2U));
  EXPECT_TRUE(unknown);
}

}  // namespace
}  // namespace flexspline::studies
