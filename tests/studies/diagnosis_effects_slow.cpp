// What a model says of an effect is what the bench had: unit, sign and site of every counterpart.
#include <cmath>

#include <gtest/gtest.h>

#include "flexspline/data/hidden_bench.hpp"
#include "flexspline/data/model_toml.hpp"
#include "flexspline/studies/diagnosis.hpp"
#include "printed_name.hpp"

namespace flexspline::studies {
namespace {

/// An effect of the model whose parameter is that of the bench.
struct TruthCase {
  Rig rig = Rig::free;
  std::string hidden;
  std::string truth;   ///< the bench's parameter
  std::string effect;  ///< the model's
  std::string parameter;
  double share = 0.1;  ///< by which they may differ
};

std::ostream& operator<<(std::ostream& out, const TruthCase& one) {
  return out << name_of(one.rig) << "_" << one.hidden;
}

double true_value(const data::HiddenAnswer& answer, const std::string& name) {
  for (const auto& parameter : answer.effects.front().parameters) {
    if (parameter.name == name) return parameter.value;
  }
  return std::nan("");
}

/// The first of an effect's elements; parts of one friction that saturate at several speeds added.
double model_value(const ModelSpec& model, const TruthCase& one) {
  double sum = 0.0;
  for (const EffectSpec& effect : model.effects) {
    if (effect.effect != one.effect) continue;
    for (const auto& [name, value] : effect.parameters) {
      if (name != one.parameter) continue;
      sum += value;
      break;
    }
  }
  return sum;
}

class EffectOfADiagnosis : public testing::TestWithParam<TruthCase> {};

TEST_P(EffectOfADiagnosis, HasTheParameterOfTheBench) {
  const TruthCase& one = GetParam();
  const auto made =
      data::run_hidden_bench(data::draw_hidden_bench(one.rig, 4), {{one.hidden, 0.06}});
  ASSERT_TRUE(made) << made.error().message();
  const auto diagnosis = diagnose(made->measured, {}, {.nested = false});
  ASSERT_TRUE(diagnosis) << diagnosis.error().message();
  for (const std::string& note : diagnosis->notes) SCOPED_TRACE(note);
  ASSERT_TRUE(diagnosis->model);
  const double truth = true_value(made->answer, one.truth);
  const double found = model_value(diagnosis->model->drive.torsion, one);
  EXPECT_NEAR(found, truth, one.share * std::abs(truth)) << diagnosis->says;
  const auto text = data::model_toml(*diagnosis->model);
  EXPECT_TRUE(data::parse_rig_model(text, "model.toml"));
}

INSTANTIATE_TEST_SUITE_P(
    Truth, EffectOfADiagnosis,
    testing::Values(
        TruthCase{Rig::free, "gravity_load", "mass_moment", "gravity_load", "moment"},
        TruthCase{Rig::free, "motor_torque_offset", "offset", "motor_torque_offset", "offset"},
        TruthCase{Rig::free, "torque_sensor_gain", "error", "torque_sensor_gain", "error"},
        TruthCase{Rig::free, "sensor_crosstalk", "amplitude_order_2", "sensor_crosstalk",
                  "amplitude"},
        TruthCase{Rig::free, "encoder_skew", "delay", "encoder_skew", "delay"},
        TruthCase{Rig::free, "encoder_eccentricity", "amplitude_at_motor", "motor_encoder_eccentricity",
                  "amplitude"},
        TruthCase{Rig::free, "sensor_delay", "delay", "sensor_delay", "delay"},
        TruthCase{Rig::free, "kinematic_error", "amplitude_order_2", "kinematic_error",
                  "amplitude"},
        TruthCase{Rig::free, "motor_torque_ripple", "amplitude", "motor_torque_ripple",
                  "cogging_sine"},
        TruthCase{Rig::free, "current_lag", "time_constant", "current_lag", "time_constant"},
        TruthCase{Rig::free, "load_dependent_friction", "coefficient", "load_dependent_friction",
                  "coefficient"},
        TruthCase{Rig::locked, "inertia_torque", "inertia", "inertia_torque", "inertia"},
        TruthCase{Rig::locked, "backlash", "half_gap", "lost_motion", "half_gap"},
        TruthCase{Rig::locked, "torque_sensor_offset", "offset", "torque_sensor_offset", "offset"}),
    PrintedName());

}  // namespace
}  // namespace flexspline::studies
