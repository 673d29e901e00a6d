// A diagnosis' model is what it says it is: simulated along the recordings it gives the diagnosis'
// own prediction, from a file as from memory.
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "flexspline/core/rig_residuals.hpp"
#include "flexspline/core/simulate.hpp"
#include "flexspline/data/dataset.hpp"
#include "flexspline/data/hidden_bench.hpp"
#include "flexspline/data/model_toml.hpp"
#include "flexspline/studies/diagnosis.hpp"
#include "printed_name.hpp"
#include "study_file.hpp"

namespace flexspline::studies {
namespace {

struct ModelCase {
  Rig rig = Rig::locked;
  std::string hidden = {};  ///< empty: nothing
  double size = 0.05;
  std::string expected = {};  ///< effect of the model; empty: any
  double apart = 0.1;         ///< of simulation and prediction, over the noise
  std::uint64_t seed = 3;
};

std::ostream& operator<<(std::ostream& out, const ModelCase& one) {
  return out << name_of(one.rig) << "_" << (one.hidden.empty() ? "nothing" : one.hidden);
}

struct Diagnosed {
  RecordingSet set;
  Diagnosis diagnosis;
};

Diagnosed diagnosed(const ModelCase& one) {
  std::vector<data::HiddenEffect> hidden;
  if (!one.hidden.empty()) hidden.push_back({one.hidden, one.size});
  auto made = data::run_hidden_bench(data::draw_hidden_bench(one.rig, one.seed), hidden);
  EXPECT_TRUE(made) << (made ? "" : made.error().message());
  if (!made) return {};
  auto diagnosis = diagnose(made->measured, {}, {.nested = false});
  EXPECT_TRUE(diagnosis) << (diagnosis ? "" : diagnosis.error().message());
  return {std::move(made->measured), diagnosis ? *std::move(diagnosis) : Diagnosis{}};
}

double constant(const RecordingSet& set, const std::string& key) {
  const auto found = set.constants.find(key);
  return found == set.constants.end() ? 1.0 : found->second;
}

/// The torsion of a recording, smoothed as a diagnosis smooths it.
Motion motion_of(const RecordingSet& set, const Recording& recording) {
  const auto channels = drive_channels(set.rig, {}, recording, resolution_on(set.rig));
  EXPECT_TRUE(channels);
  const DriveChannels& c = *channels;
  if (set.rig == Rig::specimen) return {c.time, c.torsion, c.torsion_rate, c.torsion_acceleration};
  const double ratio = constant(set, "gear_ratio");
  Motion motion{c.time, c.motor_angle, c.motor_speed, c.motor_acceleration};
  for (std::size_t i = 0; i < c.time.size(); ++i) {
    const bool turns = !c.load_angle.empty();
    motion.position[i] = c.motor_angle[i] / ratio - (turns ? c.load_angle[i] : 0.0);
    motion.velocity[i] = c.motor_speed[i] / ratio - (turns ? c.load_speed[i] : 0.0);
    motion.acceleration[i] =
        c.motor_acceleration[i] / ratio - (turns ? c.load_acceleration[i] : 0.0);
  }
  return motion;
}

/// Rms of simulation less prediction over the noise, by recording, of those that the model was
/// fitted to: the others are predicted by fits that did not see them. Ends left out, where a
/// spline's derivatives are loose.
std::map<std::string, double> apart(const Diagnosed& d, const ModelSpec& model) {
  constexpr std::size_t kEnd = 6;
  std::map<std::string, double> list;
  for (const DiagnosedSeries& series : d.diagnosis.series) {
    EXPECT_EQ(series.equation, "torsion");
    if (series.split == Split::holdout) continue;
    const auto recording = std::ranges::find(d.set.recordings, series.recording, &Recording::id);
    const auto torque = simulate_torque(model, motion_of(d.set, *recording));
    EXPECT_TRUE(torque) << (torque ? "" : torque.error().message());
    if (!torque) return {};
    std::map<double, double> at;
    for (std::size_t i = kEnd; i + kEnd < torque->size(); ++i) {
      at[recording->time[i]] = (*torque)[i];
    }
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t k = 0; k < series.time.size(); ++k) {
      const auto found = at.find(series.time[k]);
      if (found == at.end()) continue;
      sum += std::pow(found->second - series.after[k], 2);
      count += 1.0;
    }
    EXPECT_GT(count, 100.0);
    list[series.recording] = std::sqrt(sum / count) / d.diagnosis.noise_std;
  }
  return list;
}

/// The torsion law without the friction of the motor, which a torsion does not drive.
ModelSpec torsion_law(ModelSpec model) {
  std::erase_if(model.effects, [](const EffectSpec& effect) {
    const auto row = find_effect(effect.effect);
    return !effect.across && row && (*row)->site == Site::motor;
  });
  return model;
}

bool has_effect(const ModelSpec& model, const std::string& id) {
  return std::ranges::any_of(model.effects, [&](const EffectSpec& e) { return e.effect == id; });
}

class DiagnosedModel : public testing::TestWithParam<ModelCase> {};

TEST_P(DiagnosedModel, SimulatesItsPredictionFromAFile) {
  const Diagnosed d = diagnosed(GetParam());
  for (const std::string& note : d.diagnosis.notes) SCOPED_TRACE(note);
  ASSERT_TRUE(d.diagnosis.model);
  if (!GetParam().expected.empty()) {
    EXPECT_TRUE(has_effect(d.diagnosis.model->drive.torsion, GetParam().expected))
        << d.diagnosis.says;
  }
  ScratchFolder folder;
  const auto file = folder.path() / "model.toml";
  ASSERT_TRUE(data::write_model(file, *d.diagnosis.model));
  const auto model = data::read_rig_model(file);
  ASSERT_TRUE(model) << model.error().message();
  EXPECT_EQ(data::model_toml(*model), data::model_toml(*d.diagnosis.model));
  const auto differences = apart(d, torsion_law(model->drive.torsion));
  EXPECT_FALSE(differences.empty());
  for (const auto& [recording, difference] : differences) {
    EXPECT_LT(difference, GetParam().apart) << recording;
  }
}

TEST(ModelOfADiagnosis, IsTakenBySimulate) {
  const auto program = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "flexspline";
  if (!exists(program)) GTEST_SKIP() << program << " is not built";
  const Diagnosed d = diagnosed({.hidden = "backlash"});
  ASSERT_TRUE(d.diagnosis.model);
  ScratchFolder folder;
  const std::string path = folder.path().string();
  ASSERT_TRUE(data::write_model(folder.path() / "model.toml", *d.diagnosis.model));
  ASSERT_TRUE(data::write_dataset(folder.path() / "recorded", d.set));
  const std::string line = program.string() + " simulate " + path + "/model.toml --like " + path +
                           "/recorded --out " + path + "/simulated > /dev/null";
  EXPECT_EQ(std::system(line.c_str()), 0);
  const auto simulated = data::load_dataset(folder.path() / "simulated");
  ASSERT_TRUE(simulated) << simulated.error().message();
  EXPECT_EQ(simulated->recordings.size(), d.set.recordings.size());
}

TEST(ModelOfADiagnosis, IsAServosToo) {
  const Diagnosed d = diagnosed({.rig = Rig::servo});
  ASSERT_TRUE(d.diagnosis.model);
  EXPECT_EQ(d.diagnosis.model->rig, Rig::servo);
  EXPECT_GT(d.diagnosis.model->drive.load_mass, 0.0);
}

INSTANTIATE_TEST_SUITE_P(
    Torsion, DiagnosedModel,
    testing::Values(ModelCase{},
                    ModelCase{.hidden = "inertia_torque", .expected = "inertia_torque"},
                    ModelCase{.hidden = "presliding_hysteresis",
                              .expected = "presliding_hysteresis"},
                    ModelCase{.hidden = "backlash", .expected = "lost_motion", .apart = 0.4},
                    ModelCase{.hidden = "torque_sensor_offset", .expected = "torque_sensor_offset"},
                    ModelCase{.hidden = "sensor_delay", .expected = "sensor_delay", .apart = 0.4},
                    ModelCase{.hidden = "viscoelastic_creep", .expected = "viscoelastic_creep"},
                    ModelCase{.rig = Rig::specimen,
                              .hidden = "presliding_hysteresis",
                              .expected = "presliding_hysteresis"}),
    PrintedName());

}  // namespace
}  // namespace flexspline::studies
