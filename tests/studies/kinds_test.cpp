#include "flexspline/studies/kind.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "comparison/band_figures.hpp"
#include "flexspline/core/case_store.hpp"
#include "flexspline/data/bench.hpp"
#include "flexspline/data/dataset.hpp"
#include "flexspline/studies/results.hpp"
#include "flexspline/studies/run.hpp"
#include "flexspline/studies/verify.hpp"
#include "source_dir.hpp"
#include "study_file.hpp"

namespace flexspline::studies {
namespace {

const std::string kQuietBench =
    "[bench]\ntorque_noise_white = { value = 0.2, unit = \"%\" }\ncycles = 3\nsamples_per_cycle = "
    "100\n";
const std::string kLoops =
    "[[grid]]\nid = \"loops\"\nloops = { values = [[0.2, 0.005], [0.1, 0.005], [0.2, 0.0025]], "
    "units = [\"deg\", \"Hz\"] }\n";
const std::string kUnity = "[[input]]\nid = \"unity\"\ntruth = \"unity\"\n";
const std::string kPooled =
    "[[estimator]]\nid = \"pooled\"\nmethod = \"midpoint_pooled\"\ntrain = \"loops\"\n";

class Kinds : public testing::Test {
 protected:
  /// Runs a study of a kind and gives its answer; folder is the study's name.
  KindAnswer answer_of(const std::string& text, const std::string& name = "out") {
    study_ = load_study(folder_.write("study.toml", kHead + text));
    EXPECT_TRUE(study_) << study_.error().message();
    plan_ = plan_study(*study_, "build");
    EXPECT_TRUE(plan_) << plan_.error().message();
    RunSettings settings;
    settings.folder = folder_.path() / name;
    settings.jobs = 2;
    settings.build_id = "build";
    const auto summary = run_study(*plan_, settings);
    EXPECT_TRUE(summary) << summary.error().message();
    EXPECT_TRUE(summary->failed.empty()) << summary->failed.front();
    const auto rows = StudyRows::open(*plan_, settings.folder);
    EXPECT_TRUE(rows) << rows.error().message();
    EXPECT_TRUE(write_results(*rows, {}, settings.folder));
    EXPECT_TRUE(write_answer(*rows, settings.folder));
    const auto kind = std::ranges::find(kinds(), study_->kind, &KindRow::id);
    return kind->answer(*rows);
  }
  static double number(const std::variant<std::string, double>& cell) {
    return std::get<double>(cell);
  }
  static std::string word(const std::variant<std::string, double>& cell) {
    return std::get<std::string>(cell);
  }
  void write_set(const std::string& name, double offset) const {
    RecordingSet set;
    set.name = name;
    set.rig = Rig::specimen;
    for (const double amplitude : {0.01, 0.006}) {
      Recording one;
      one.id = amplitude > 0.008 ? "large" : "small";
      one.excitation = "sine";
      std::vector<double> torsion, torque;
      for (int i = 0; i < 400; ++i) {
        const double angle = 2.0 * 3.141592653589793 * i / 100.0;
        const double phi = amplitude * std::sin(angle);
        one.time.push_back(0.01 * i);
        torsion.push_back(phi);
        torque.push_back(2000.0 * phi + 200.0 * amplitude * std::cos(angle) + offset +
                         0.01 * std::sin(37.0 * i));
      }
      one.channels[Quantity::torsion] = torsion;
      one.channels[Quantity::torque] = torque;
      set.recordings.push_back(one);
    }
    ASSERT_TRUE(data::write_dataset(folder_.path() / name, set));
  }
  std::string model_study(const std::string& kind, const std::string& table) const {
    folder_.write(
        "model.toml",
        "schema = \"flexspline-model/1\"\n[f]\nlaw = \"odd_polynomial\"\nscale = 0.01\n"
        "coefficients = [15.0]\n[g_inverse]\nlaw = \"odd_polynomial\"\nscale = 0.1\n"
        "coefficients = [1.0]\n[[effect]]\neffect = \"torque_sensor_offset\"\nparameters = "
        "[{ name = \"offset\", value = 0.5 }]\n");
    return "kind = \"" + kind + "\"\n" + table +
           "[[input]]\nid = \"set\"\ndataset = \"set\"\n[[estimator]]\nid = \"m\"\nmethod = "
           "\"model_file\"\nmodel = \"model.toml\"\n";
  }

  ScratchFolder folder_;
  Result<StudyConfig> study_ = StudyConfig{};
  Result<StudyPlan> plan_ = StudyPlan{};
};

// Where everything that a method assumes holds, the loop that spans the conditions suffices.
TEST_F(Kinds, GeneralisationFindsTheSmallestSetThatSuffices) {
  const KindAnswer answer = answer_of(
      "kind = \"generalisation\"\n[generalisation]\nlargest_set = 2\nerror = { value = 1, unit = "
      "\"%\" }\n" +
      kQuietBench + kLoops + kUnity +
      "[[estimator]]\nid = \"pooled\"\nmethod = \"midpoint_pooled\"\n");
  EXPECT_EQ(plan_->size(), 3U + 3U) << "three single loops and three pairs";
  ASSERT_EQ(answer.figures.size(), 1U);
  ASSERT_EQ(answer.figures[0].panels[0].cells.size(), 3U);
  ASSERT_EQ(answer.tables[0].rows.size(), 1U);
  EXPECT_EQ(number(answer.tables[0].rows[0][1]), 1.0);
  EXPECT_EQ(word(answer.tables[0].rows[0][2]), "a0.2000-f0.00500") << "largest and fastest";
  EXPECT_EQ(word(answer.tables[0].rows[0][4]), "yes");
}

// Least squares: the error is proportional to the noise.
TEST_F(Kinds, RobustnessIsProportionalToWhiteNoise) {
  const KindAnswer answer = answer_of(
      "kind = \"robustness\"\nreplicates = 8\n[robustness]\nerror = { value = 1000, unit = \"%\" "
      "}\n"
      "torque_noise_white = [0.5, 4.0]\nmissing_samples = [30.0]\ntime_jitter = [5.0]\n[bench]\n"
      "cycles = 3\nsamples_per_cycle = 100\n" +
      kLoops + "[[input]]\nid = \"table_i\"\ntruth = \"table_i\"\nholdout = \"loops\"\n" + kPooled);
  ASSERT_EQ(answer.figures.size(), 3U);
  const auto white =
      std::ranges::find(answer.figures, "robustness-torque-noise-white", &AnswerFigure::id);
  ASSERT_NE(white, answer.figures.end());
  const AnswerSeries& line = white->panels[0].series[0];
  ASSERT_EQ(line.x, (std::vector<double>{0.5, 4.0}));
  EXPECT_NEAR(line.y[1] / line.y[0], 8.0, 3.0);
  EXPECT_NE(answer.says.find("No estimator passes"), std::string::npos);
  EXPECT_EQ(plan_->size(), 8U * (1 + 2 + 1 + 1));
}

// A second loop of the same kind tells something, and less than a bit: bands shrink by no more than
// the root of two but for chance.
TEST_F(Kinds, ExcitationOfTheSameAgainTellsLittle) {
  const KindAnswer answer = answer_of(
      "kind = \"excitation\"\nreplicates = 4\n[excitation]\nrecorded = \"first\"\ncandidates = "
      "\"more\"\nlargest_speed = { value = 0.01, unit = \"deg/s\" }\n" +
      kQuietBench +
      "[[grid]]\nid = \"first\"\nloops = { values = [[0.2, 0.005]], units = [\"deg\", \"Hz\"] }\n"
      "[[grid]]\nid = \"more\"\nloops = { values = [[0.2, 0.00501], [0.2, 0.05]], units = "
      "[\"deg\", "
      "\"Hz\"] }\n" +
      kUnity + "[[estimator]]\nid = \"pooled\"\nmethod = \"midpoint_pooled\"\n");
  const auto& rows = answer.tables[0].rows;
  const auto f = std::ranges::find_if(rows, [](const auto& row) { return word(row[1]) == "f"; });
  ASSERT_NE(f, rows.end());
  EXPECT_GT(number((*f)[4]), 0.0);
  EXPECT_LT(number((*f)[4]), 0.75);
  for (const auto& row : rows) EXPECT_LT(number(row[3]), 0.01) << "beyond the rig's speed";
}

// The same loop once more tells as much as the first one did. Of a viscous gear, slip can imitate
// the losses at one rate and not at two.
TEST_F(Kinds, ExcitationSeparatesCausesByAnotherRate) {
  const std::string models = std::string(FLEXSPLINE_SOURCE_DIR) + "/studies/models/locked-gear-";
  const auto cause = [&](const std::string& id) {
    return "[[estimator]]\nid = \"" + id + "\"\nmethod = \"model_file\"\nmodel = \"" + models + id +
           ".toml\"\n";
  };
  const KindAnswer answer = answer_of(
      "kind = \"excitation\"\nreplicates = 4\n[excitation]\nrecorded = \"first\"\ncandidates = "
      "\"more\"\ndiscriminate = [\"slip\", \"viscosity\"]\n[bench]\ntorque_noise_white = { value = "
      "2, "
      "unit = \"%\" }\ncycles = 3\nsamples_per_cycle = 100\n"
      "[[grid]]\nid = \"first\"\nloops = { values = [[0.2, 0.005]], units = [\"deg\", \"Hz\"] }\n"
      "[[grid]]\nid = \"more\"\nloops = { values = [[0.2, 0.00501], [0.2, 0.001]], units = "
      "[\"deg\", \"Hz\"] }\n" +
      kUnity + cause("slip") + cause("viscosity"));
  const auto table = std::ranges::find(answer.tables, "discrimination", &AnswerTable::id);
  ASSERT_NE(table, answer.tables.end());
  ASSERT_EQ(table->rows.size(), 2U);
  const double alone = number(table->rows[0][3]);
  const double again = number(table->rows[0][4]);
  const double another_rate = number(table->rows[1][4]);
  EXPECT_LT(alone, -3.84) << "for viscosity";
  EXPECT_NEAR(again / alone, 2.0, 0.4);
  EXPECT_LT(another_rate, 1.3 * again);
  EXPECT_EQ(word(table->rows[1][5]), "viscosity");
}

// The share is the number of fits whose band holds the truth, counted again from the artefacts.
TEST_F(Kinds, CoverageCountsBandsThatHoldTheTruth) {
  const KindAnswer answer = answer_of(
      "kind = \"coverage\"\nreplicates = 40\n[coverage]\nranks = 5\n[bench]\ntorque_noise_white = "
      "{ "
      "value = 1, unit = \"%\" }\ncycles = 3\nsamples_per_cycle = 100\n" +
      kGrid + "[[input]]\nid = \"table_i\"\ntruth = \"table_i\"\n" + kEstimator);
  const auto truth = (*data::find_truth("table_i"))->make();
  const auto store = CaseStore::open(folder_.path() / "out");
  ASSERT_TRUE(store);
  constexpr double kDegree = 3.141592653589793 / 180.0;
  const double shares[] = {-0.8, -0.4, 0.4, 0.8};
  double covered = 0.0;
  for (std::size_t k = 0; k < 40; ++k) {
    const auto artefact = nlohmann::json::parse(store->read(plan_->at(k).key)->artefact);
    const auto& band = artefact["estimate"]["bands"][0];
    ASSERT_EQ(band["function"], "f");
    const auto x = band["argument"].get<std::vector<double>>();
    const double where = 0.2 * shares[(k + 1) % 4];  // deg
    const auto after = std::ranges::upper_bound(x, where) - x.begin();
    const auto i = static_cast<std::size_t>(after);
    const double u = (where - x[i - 1]) / (x[i] - x[i - 1]);
    const auto at = [&](const char* name) {
      const auto y = band[name].get<std::vector<double>>();
      return (1.0 - u) * y[i - 1] + u * y[i];
    };
    // Symmetric about the value, as a rank within a normal distribution takes it.
    const double half = 0.5 * (at("upper") - at("lower"));
    if (std::abs(truth.stiffness(where * kDegree) - at("value")) <= half) covered += 1.0;
  }
  const auto& rows = answer.tables[0].rows;
  const auto f = std::ranges::find_if(rows, [](const auto& row) { return word(row[1]) == "f"; });
  ASSERT_NE(f, rows.end());
  EXPECT_EQ(number((*f)[2]), 40.0);
  EXPECT_NEAR(number((*f)[3]), 100.0 * covered / 40.0, 1e-9);
  EXPECT_LT(number((*f)[4]), number((*f)[3]));
  EXPECT_GT(number((*f)[5]), number((*f)[3]));
}

/// An estimate of f = 0 on a truth that is a draw of its own band.
std::vector<double> pits_of(double truth_at, double std) {
  PreparedInput input;
  input.truth.emplace();
  input.truth->stiffness = [truth_at](double) { return truth_at; };
  input.truth->damping = [](double) { return 0.0; };
  StudyRecording recording;
  recording.record.id = "a";
  recording.record.amplitude = 1.0;
  recording.record.frequency_hz = 1.0;
  input.recordings.push_back(recording);
  Estimate estimate;
  const double half = 1.959963984540054 * std;
  estimate.bands.push_back({"f", {-1.0, 1.0}, {0.0, 0.0}, {-half, -half}, {half, half}, -1.0, 1.0});
  CaseRow row;
  add_band_figures(estimate, input, {"a"}, row);
  return row.lists["pit_f"];
}

// Phi((truth - value) / std): of draws from the band's own distribution the ranks are level.
TEST(BandFigures, RanksOfDrawsFromTheBandAreLevel) {
  EXPECT_NEAR(pits_of(0.0, 2.0).at(0), 0.5, 1e-12);
  EXPECT_NEAR(pits_of(3.919927969080108, 2.0).at(0), 0.975, 1e-9);
  EXPECT_NEAR(pits_of(-3.919927969080108, 2.0).at(0), 0.025, 1e-9);
  std::mt19937 bits(3);
  std::normal_distribution<double> draw(0.0, 2.0);
  std::vector<int> counts(10, 0);
  for (int k = 0; k < 4000; ++k) {
    ++counts[std::min<std::size_t>(9,
                                   static_cast<std::size_t>(10.0 * pits_of(draw(bits), 2.0)[0]))];
  }
  double chi = 0.0;
  for (const int count : counts) chi += std::pow(count - 400.0, 2) / 400.0;
  EXPECT_LT(chi, 27.9) << "0.999 of chi squared with 9 degrees of freedom";
}

// The loop's area is the damping's alone, to first order in proportion.
TEST_F(Kinds, SensitivityOfTheAreaIsTheDampings) {
  const KindAnswer answer = answer_of(
      "kind = \"sensitivity\"\n[sensitivity]\nsamples = 32\noutputs = [\"loop_area\"]\nkeys = [\n{ "
      "key "
      "= \"input.unity.strength.damping\", from = 0.5, to = 1.5 },\n{ key = "
      "\"input.unity.strength.stiffness\", from = 0.5, to = 1.5 } ]\n[bench]\ncycles = 3\n"
      "samples_per_cycle = 100\n" +
      kGrid + kUnity + kEstimator);
  EXPECT_EQ(plan_->size(), 32U * 4U);
  const auto& rows = answer.tables[0].rows;
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_NEAR(number(rows[0][3]), 1.0, 0.2);
  EXPECT_NEAR(number(rows[0][5]), 1.0, 0.2);
  EXPECT_NEAR(number(rows[1][5]), 0.0, 0.02);
}

// Linear least squares have one minimum, wherever they start.
TEST_F(Kinds, MultistartOfALinearModelHasOneMinimum) {
  write_set("set", 0.7);
  const KindAnswer answer = answer_of(model_study("multistart", "[multistart]\nstarts = 6\n"));
  const auto& row = answer.tables[0].rows.at(0);
  EXPECT_EQ(number(row[1]), 6.0);
  EXPECT_EQ(number(row[3]), 6.0);
  EXPECT_EQ(number(row[7]), 1.0);
}

// The torque has an offset: the rung that has it predicts best, and finds its size.
TEST_F(Kinds, ModelLadderClimbsToTheEffectThatIsThere) {
  write_set("set", 0.7);
  const KindAnswer answer = answer_of(model_study("model_ladder", "[model_ladder]\neffects = 1\n"));
  EXPECT_NE(answer.says.find("torque_sensor_offset predicts"), std::string::npos) << answer.says;
  const auto& rows = answer.tables[0].rows;
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(word(rows[0][1]), "baseline");
  EXPECT_GT(number(rows[0][6]), 100.0) << "BIC above the best";
  EXPECT_EQ(number(rows[1][6]), 0.0);
  bool found = false;
  for (const auto& row : answer.tables[1].rows) {
    if (word(row[2]).find("offset") == std::string::npos) continue;
    found = true;
    EXPECT_NEAR(number(row[3]), 0.7, 0.01);
  }
  EXPECT_TRUE(found);
}

// Residuals r = offset + …, all else orthogonal to a constant over whole periods: held away from
// its estimate the offset costs n/2 (value - estimate)^2, and the profile is the covariance's
// parabola.
TEST_F(Kinds, ProfileOfALinearModelIsTheParabolaOfItsCovariance) {
  write_set("set", 0.7);
  const KindAnswer answer = answer_of(model_study(
      "profile", "[profile]\npoints = 3\nparameters = [\"torque_sensor_offset.offset\"]\n"));
  EXPECT_EQ(plan_->size(), 1U + 6U);
  const auto store = CaseStore::open(folder_.path() / "out");
  ASSERT_TRUE(store);
  const auto estimate = [&](std::size_t number) {
    return nlohmann::json::parse(store->read(plan_->at(number).key)->artefact)["estimate"];
  };
  const auto free = estimate(0);
  const auto offset = [](const nlohmann::json& of) {
    for (const auto& one : of["parameters"]) {
      if (one["name"] == "torque_sensor_offset.offset") return one["value"].get<double>();
    }
    return std::nan("");
  };
  for (std::size_t k = 1; k <= 6; ++k) {
    const auto held = estimate(k);
    const double away = offset(held) - offset(free);
    const double law = 0.5 * 400.0 * away * away;
    EXPECT_NEAR(held["cost"].get<double>() - free["cost"].get<double>(), law, 0.02 * law) << k;
  }
  const auto& row = answer.tables[0].rows.at(0);
  EXPECT_EQ(word(row[1]), "torque_sensor_offset.offset");
  const double half = number(row[7]) - number(row[3]);
  EXPECT_NEAR(number(row[5]) - number(row[3]), half, 0.02 * half);
  EXPECT_NEAR(number(row[3]) - number(row[4]), half, 0.02 * half);
}

// By one worker or two, by what the file or the lock says: bitwise.
TEST_F(Kinds, AStudyOfAKindIsReadBackFromItsLockAndVerifiesBitwise) {
  answer_of("kind = \"generalisation\"\n[generalisation]\nlargest_set = 1\n" + kQuietBench +
            kLoops + kUnity + "[[estimator]]\nid = \"pooled\"\nmethod = \"midpoint_pooled\"\n");
  const auto locked = read_locked_study(folder_.path() / "out" / "study.lock.toml");
  ASSERT_TRUE(locked) << locked.error().message();
  const auto plan = plan_study(*locked, "build");
  ASSERT_TRUE(plan);
  RunSettings settings;
  settings.folder = folder_.path() / "again";
  settings.jobs = 1;
  settings.build_id = "build";
  ASSERT_TRUE(run_study(*plan, settings));
  const auto rows = StudyRows::open(*plan, settings.folder);
  ASSERT_TRUE(rows);
  ASSERT_TRUE(write_answer(*rows, settings.folder));
  const auto verified = verify_folders(folder_.path() / "out", settings.folder);
  ASSERT_TRUE(verified) << verified.error().message();
  EXPECT_EQ(verified->level, Agreement::bitwise) << verified->says;
  EXPECT_EQ(verified->artefacts.size(), 3U + 1U + 1U) << "cases, input, kind.json";
}

TEST_F(Kinds, WhatAKindCannotDoIsRefused) {
  const auto refused = [&](const std::string& text, const std::string& says) {
    const auto reading = read_study(folder_.write("bad.toml", kHead + text));
    ASSERT_TRUE(reading);
    ASSERT_FALSE(reading->errors.empty()) << text;
    EXPECT_NE(reading->errors.front().message().find(says), std::string::npos)
        << reading->errors.front().message();
  };
  refused("kind = \"coverag\"\n" + kGrid + kInput + kEstimator, "did you mean 'coverage'");
  refused("kind = \"coverage\"\n" + kGrid + kInput + kEstimator, "replicates");
  refused("kind = \"robustness\"\n" + kGrid + kInput + kEstimator, "no disturbance");
  refused("kind = \"multistart\"\n" + kGrid + kInput + kEstimator, "no model file");
  refused(
      "kind = \"excitation\"\n[excitation]\nrecorded = \"point\"\ncandidates = \"loops\"\n"
      "discriminate = [\"paper\"]\n" +
          kGrid + kLoops + kUnity + kEstimator,
      "two causes");
  refused("kind = \"profile\"\n" + kGrid + kInput + kEstimator, "no model file");
  refused("kind = \"trial\"\n" + kGrid + kInput + kEstimator, "flexspline-trial/1");
  refused("kind = \"generalisation\"\n[generalisation]\ngrid = \"pont\"\n" + kGrid + kInput +
              kEstimator,
          "did you mean 'point'");
  refused(
      "kind = \"generalisation\"\n[generalisation]\nlarget_set = 2\n" + kGrid + kInput + kEstimator,
      "did you mean 'largest_set'");
}

}  // namespace
}  // namespace flexspline::studies
