// What fit writes is all that simulate needs: by the program, from recordings to recordings.
#include <cmath>

#include <nlohmann/json.hpp>

#include "flexspline/data/dataset.hpp"
#include "flexspline/data/model_toml.hpp"
#include "program_fixture.hpp"

namespace flexspline::studies {
namespace {

using testing::HasSubstr;

class FittedRig : public Program {
 protected:
  /// A bench without a hidden effect, whose recordings are not made by what is fitted.
  std::string recorded(const std::string& rig) const {
    std::string bench =
        "schema = \"flexspline-bench/1\"\nrig = \"" + rig + "\"\nseed = 11\neffects = []\n";
    const bool locked = rig == "locked";
    for (const auto& [amplitude, frequency] : {std::pair{1.0, 0.5}, {2.0, 0.8}, {1.0, 1.5}}) {
      bench += "[[excitation]]\nmotion = \"sine\"\namplitude = { value = " +
               std::to_string(locked ? 0.1 * amplitude : 10.0 * amplitude) +
               ", unit = \"deg\" }\nfrequency = { value = " +
               std::to_string(locked ? 0.1 * frequency : frequency) +
               ", unit = \"Hz\" }\nsamples = 400\n";
    }
    folder_.write(rig + ".toml", bench);
    EXPECT_EQ(run_program({"conceal", path(rig + ".toml"), "--out", path(rig)}).code, 0);
    return path(rig + "/dataset");
  }

  RecordingSet simulated(const std::string& set, const std::string& direction) const {
    const Ended ended =
        run_program({"simulate", path("fit/model.toml"), "--like", set, "--direction", direction,
                     "--extrapolate", "--out", path("simulated-" + direction)});
    EXPECT_EQ(ended.code, 0) << ended.said;
    auto loaded = data::load_dataset(path("simulated-" + direction));
    EXPECT_TRUE(loaded) << loaded.error().message();
    return loaded ? *loaded : RecordingSet{};
  }
};

/// Rms of the difference over that of the recorded, over all recordings but their ends.
double apart(const RecordingSet& recorded, const RecordingSet& simulated, Quantity quantity) {
  double squares = 0.0;
  double power = 0.0;
  for (const Recording& one : recorded.recordings) {
    const auto other = std::ranges::find(simulated.recordings, one.id, &Recording::id);
    const auto& a = *one.find(quantity);
    const auto& b = *other->find(quantity);
    for (std::size_t i = 20; i + 20 < a.size(); ++i) {
      squares += std::pow(a[i] - b[i], 2);
      power += a[i] * a[i];
    }
  }
  return std::sqrt(squares / power);
}

class OfARig : public FittedRig, public testing::WithParamInterface<const char*> {};

TEST_P(OfARig, IsSimulatedWithNothingElse) {
  const std::string set = recorded(GetParam());
  const Ended fit = run_program({"fit", set, "--estimator", "static_regression", "--holdout",
                                 "none", "--out", path("fit"), "--jobs", "1"});
  ASSERT_EQ(fit.code, 0) << fit.said;
  EXPECT_THAT(fit.result, HasSubstr("motor_coulomb"));
  const std::string model = read_text(path("fit/model.toml"));
  EXPECT_THAT(model, HasSubstr(std::string("rig = \"") + GetParam() + "\""));
  EXPECT_THAT(model, HasSubstr("gear_ratio = \"given\""));
  EXPECT_THAT(model, HasSubstr("motor_coulomb = \"fitted\""));
  const auto estimate = nlohmann::json::parse(read_text(path("fit/estimate.json")));
  EXPECT_EQ(estimate.at("rig").at("origin").at("f"), "fitted");
  const auto recorded_set = data::load_dataset(set);
  ASSERT_TRUE(recorded_set);
  const RecordingSet torques = simulated(set, "torque");
  EXPECT_LT(apart(*recorded_set, torques, Quantity::transmitted_torque), 0.03);
  EXPECT_LT(apart(*recorded_set, torques, Quantity::motor_torque), 0.05);
  const RecordingSet motions = simulated(set, "torsion");
  // Without a position loop what friction misses is integrated twice.
  EXPECT_LT(apart(*recorded_set, motions, Quantity::motor_angle), 0.25);
}

INSTANTIATE_TEST_SUITE_P(Rigs, OfARig, testing::Values("locked", "free"));

TEST_F(FittedRig, OfAServoHoldsItsWindingAndWeight) {
  // A pendulum that a voltage drives: k (V - k w)/R, on an angle made by an integration of its own.
  std::string table = "t,q,u,v\n";
  const double k = 0.3, r = 4.0, j = 0.006, b = 0.01, moment = 0.49, c = 0.01, volts = 12.0;
  double q = 0.0, w = 0.0;
  const auto duty = [](double t) { return 0.45 * std::sin(2.1 * t) + 0.15 * std::sin(5.3 * t); };
  const int fine = 200;
  for (int i = 0; i < 1500; ++i) {
    const double t = 0.01 * i;
    table += std::to_string(t) + "," + std::to_string(q) + "," + std::to_string(duty(t)) + ",12\n";
    for (int s = 0; s < fine; ++s) {
      const double at = t + 0.01 * s / fine;
      const double torque = k * (volts * duty(at) - k * w) / r - b * w - c * std::tanh(w / 0.01) -
                            moment * std::sin(q);
      w += 0.01 / fine * torque / j;
      q += 0.01 / fine * w;
    }
  }
  std::filesystem::create_directory(path("servo"));
  folder_.write("servo/table.csv", table);
  folder_.write("servo/dataset.toml",
                "schema = \"flexspline-dataset/1\"\nname = \"servo\"\nrig = \"servo\"\n"
                "license = \"CC0-1.0\"\n[constants]\nload_mass_kg = 0.5\narm_length_m = 0.1\n"
                "[channels]\nt = { quantity = \"time\", unit = \"s\" }\n"
                "q = { quantity = \"load_angle\", unit = \"rad\" }\n"
                "u = { quantity = \"duty_cycle\", unit = \"1\" }\n"
                "v = { quantity = \"supply_voltage\", unit = \"V\" }\n"
                "[[recording]]\nid = \"one\"\nfile = \"table.csv\"\n");
  const std::string form =
      std::string(FLEXSPLINE_SOURCE_DIR) + "/studies/models/servo-coulomb.toml";
  const Ended fit = run_program({"fit", path("servo"), "--model", form, "--out", path("fit")});
  ASSERT_EQ(fit.code, 0) << fit.said;
  const std::string model = read_text(path("fit/model.toml"));
  // Back-EMF and viscous friction, k^2/R + B, brake alike: the file says that k and R alone are not
  // told, and its motion is right all the same.
  EXPECT_THAT(model, HasSubstr("torque_constant = \"not identifiable\""));
  EXPECT_THAT(model, HasSubstr("motor_inertia = \"fitted\""));
  const auto file = data::read_rig_model(path("fit/model.toml"));
  ASSERT_TRUE(file) << file.error().message();
  EXPECT_NEAR(file->drive.motor_inertia, j - 0.005, 5e-5);
  EXPECT_NEAR(file->drive.torque_constant / file->drive.resistance, k / r, 0.01 * k / r);
  EXPECT_THAT(model, HasSubstr("gravity_load"));
  const auto set = data::load_dataset(path("servo"));
  ASSERT_TRUE(set);
  EXPECT_LT(apart(*set, simulated(path("servo"), "torsion"), Quantity::load_angle), 0.02);
}

}  // namespace
}  // namespace flexspline::studies
