// A diagnosis writes the whole rig: read back, it says what the diagnosis said.
#include <cmath>
#include <numbers>

#include "diagnosis/model/cancelling.hpp"
#include "diagnosis/model/specification.hpp"
#include "diagnosis_checks.hpp"
#include "flexspline/core/signals.hpp"
#include "flexspline/core/simulate.hpp"
#include "flexspline/core/simulate_rig.hpp"
#include "flexspline/core/torsion_record.hpp"
#include "flexspline/data/model_toml.hpp"
#include "numbered_sine.hpp"

namespace flexspline::studies {
namespace {

RigModel through_a_file(const RigModel& model) {
  const auto back = data::parse_rig_model(data::model_toml(model), "model.toml");
  EXPECT_TRUE(back) << back.error().message();
  return back ? *back : RigModel{};
}

double rms(const std::vector<double>& a, const std::vector<double>& b, std::size_t skip) {
  double sum = 0.0;
  for (std::size_t i = skip; i + skip < a.size(); ++i) sum += std::pow(a[i] - b[i], 2);
  return std::sqrt(sum / static_cast<double>(a.size() - 2 * skip));
}

/// Of the recorded torque of one name, over all recordings, by a model file.
double error_of(const RigModel& model, const RecordingSet& set, Quantity quantity) {
  double squares = 0.0;
  for (const Recording& one : set.recordings) {
    const auto predicted = torques_along(model, one);
    EXPECT_TRUE(predicted) << predicted.error().message();
    if (!predicted) return std::nan("");
    squares += std::pow(rms(*predicted->find(quantity), *one.find(quantity), 20), 2);
  }
  return std::sqrt(squares / static_cast<double>(set.recordings.size()));
}

class OfADrive : public testing::TestWithParam<Bench> {};

// The equation that is proved on recordings held out: the file's prediction of its torque is as
// near to the recordings as the diagnosis, fitted without them, came.
TEST_P(OfADrive, ItsFilePredictsAsTheDiagnosisDid) {
  const RecordingSet set = GetParam().make().recordings;
  const Diagnosis d = diagnosed(set);
  ASSERT_FALSE(d.series.empty());
  const bool motor = d.series.front().equation == "motor";
  const RigModel model = through_a_file(*d.model);
  EXPECT_EQ(model.rig, set.rig);
  EXPECT_EQ(model.drive.gear_ratio, set.constants.at("gear_ratio"));
  const double error =
      error_of(model, set, motor ? Quantity::motor_torque : Quantity::transmitted_torque);
  EXPECT_LT(error, 1.15 * d.holdout.rmse_after) << GetParam().words() << ": " << d.says;
}

INSTANTIATE_TEST_SUITE_P(Rigs, OfADrive,
                         testing::Values(Bench{Rig::locked, 101, ""}, Bench{Rig::free, 103, ""},
                                         Bench{Rig::free, 206, "gravity_load"}));

}  // namespace
}  // namespace flexspline::studies
