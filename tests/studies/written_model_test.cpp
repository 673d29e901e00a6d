// What a diagnosis writes computes what it fitted: the file, read back and simulated along the
// recordings, leaves the residuals of the diagnosis' own columns on the same rows. Two ways to one
// number: columns times coefficients of a regression, and laws and effects of the catalogue.
#include <cmath>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "active_cause.hpp"
#include "diagnosis/model/specification.hpp"
#include "drive_frame.hpp"
#include "flexspline/core/effect.hpp"
#include "flexspline/core/rig_residuals.hpp"
#include "flexspline/core/simulate.hpp"
#include "flexspline/core/simulate_rig.hpp"
#include "flexspline/data/model_toml.hpp"
#include "printed_name.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr Index kAllRows = 1000000;
constexpr Index kEnd = 8;  // rows at the ends of a recording, where a spline's rates are loose

struct WrittenCase {
  std::string name;
  data::BenchKind kind;
  std::vector<data::HiddenEffect> hidden = {};
  double motor_gain = 1.0;  ///< of what is recorded of the motor's torque
};

std::ostream& operator<<(std::ostream& out, const WrittenCase& one) { return out << one.name; }

/// A bench's recordings and the baseline that they were fitted with.
struct Fitted {
  RecordingSet set;
  Frame frame;
  Findings findings;
};

Fitted fitted(const WrittenCase& one) {
  ConcealPlan plan;
  plan.rig = one.kind;
  plan.seed = 3;
  plan.effects = one.hidden;
  auto made = conceal(plan);
  EXPECT_TRUE(made) << made.error().message();
  RecordingSet set = std::move(made->recordings);
  for (Recording& recording : set.recordings) {
    for (auto& [quantity, channel] : recording.channels) {
      if (quantity != Quantity::motor_torque) continue;
      for (double& value : channel) value *= one.motor_gain;
    }
  }
  auto frame = make_frame(set, kAllRows);
  EXPECT_TRUE(frame) << frame.error().message();
  frame->motor_bandwidth.resize(0);  // the law itself, not what smoothing leaves of it
  auto findings = fit_baseline(*frame);
  EXPECT_TRUE(findings) << findings.error().message();
  return {std::move(set), std::move(*frame), std::move(*findings)};
}

/// The torsion of a recording, smoothed as a diagnosis smooths it.
Motion motion_of(const RecordingSet& set, const Recording& recording) {
  const auto c = drive_channels(set.rig, {}, recording, resolution_on(set.rig));
  EXPECT_TRUE(c);
  return {c->time, c->torsion, c->torsion_rate, c->torsion_acceleration};
}

ArrayXd as_array(const std::vector<double>& values) {
  return Eigen::Map<const ArrayXd>(values.data(), static_cast<Index>(values.size()));
}

/// What a file predicts of the torque that an equation explains, on a recording's samples.
Result<ArrayXd> simulated(const RigModel& model, const RecordingSet& set,
                          const Recording& recording, Equation equation) {
  if (set.rig == Rig::specimen) {
    const auto torque = simulate_torque(model.drive.torsion, motion_of(set, recording));
    if (!torque) return tl::unexpected(torque.error());
    return as_array(*torque);
  }
  const auto along = torques_along(model, recording);
  if (!along) return tl::unexpected(along.error());
  const Quantity quantity =
      equation == Equation::motor ? Quantity::motor_torque : Quantity::transmitted_torque;
  return as_array(*along->find(quantity));
}

const Recording& named(const RecordingSet& set, const std::string& id) {
  return *std::ranges::find(set.recordings, id, &Recording::id);
}

/// Rms over usable rows of simulation less prediction, over the deviation that the equation has.
double apart(const Fitted& fit, const ModelFit& expected, const RigModel& model,
             Equation equation) {
  const std::size_t e = index_of(equation);
  const ArrayXd deviation = deviation_of(fit.frame, fit.findings.noise[e]);
  double squares = 0.0;
  double rows = 0.0;
  for (std::size_t s = 0; s < fit.frame.segments.size(); ++s) {
    const Segment& segment = fit.frame.segments[s];
    const auto torque = simulated(model, fit.set, named(fit.set, segment.id), equation);
    EXPECT_TRUE(torque) << torque.error().message();
    if (!torque || torque->size() != segment.count) return std::nan("");
    const Index count = segment.count - 2 * kEnd;
    const Index first = segment.first + kEnd;
    const ArrayXd usable = fit.frame.usable.segment(first, count);
    const ArrayXd difference =
        (torque->segment(kEnd, count) - expected.prediction[e].segment(first, count)) /
        deviation.segment(first, count);
    squares += (difference.square() * usable).sum();
    rows += usable.sum();
  }
  return std::sqrt(squares / rows);
}

RigModel through_a_file(const RigModel& model) {
  const auto back = data::parse_rig_model(data::model_toml(model), "model.toml");
  EXPECT_TRUE(back) << back.error().message();
  return back ? *back : RigModel{};
}

// Of a free rig's torsion the fit takes what it is smoothed to, a simulation the difference of two
// angles that are smoothed apart: at most a fiftieth of a mean square.
double most_apart(const Fitted& fit, Equation equation) {
  return fit.frame.rig == Rig::free && equation == Equation::torsion ? 0.15 : 0.05;
}

bool is_simulated(Equation equation) { return equation != Equation::load; }

class WrittenModel : public testing::TestWithParam<WrittenCase> {};

TEST_P(WrittenModel, OfTheBaselineLeavesItsResidual) {
  const Fitted fit = fitted(GetParam());
  const auto written = specify(fit.frame, fit.findings.fit.model);
  const RigModel model = through_a_file(written.model);
  for (Equation equation : fit.frame.equations) {
    if (!is_simulated(equation)) continue;
    EXPECT_LT(apart(fit, fit.findings.fit, model, equation), most_apart(fit, equation))
        << name_of(equation);
  }
}

// The load's equation, which no simulated channel shows, by its residual.
TEST_P(WrittenModel, LeavesTheLoadsResidual) {
  const Fitted fit = fitted(GetParam());
  if (!fit.frame.has(Equation::load)) GTEST_SKIP() << "this rig has no such equation";
  const RigModel model = through_a_file(specify(fit.frame, fit.findings.fit.model).model);
  const auto& expected = fit.findings.fit.residual[index_of(Equation::load)];
  for (const Segment& segment : fit.frame.segments) {
    const auto channels = drive_channels(fit.set.rig, model.drive, named(fit.set, segment.id),
                                         resolution_on(fit.set.rig));
    ASSERT_TRUE(channels);
    const auto left = residuals(fit.set.rig, model.drive, *channels);
    ASSERT_TRUE(left);
    const ArrayXd difference =
        as_array(left->load.value) - expected.segment(segment.first, segment.count);
    EXPECT_LT(
        (difference * fit.frame.usable.segment(segment.first, segment.count)).abs().maxCoeff(),
        1e-9 * fit.frame.torque_range);
  }
}

/// Forms that go by the torque measured, in which none of them is hidden here, where the file goes
/// by that of the model; of a fit both are the same torque.
bool goes_by_measured_torque(const CauseRow& row, Equation equation) {
  return row.id == "backlash" || (row.id == "inertia_torque" && equation == Equation::motor);
}

// Each cause of the list in its turn beside the baseline, whether or not it was hidden. Some are
// put into the file to first order; what differs by more is said.
TEST_P(WrittenModel, OfEveryCauseLeavesItsResidual) {
  const Fitted fit = fitted(GetParam());
  int written_ones = 0;
  for (const auto rows : {causes(), baseline_parts()}) {
    for (const CauseRow& row : rows) {
      for (const CauseForm* form : forms_on(row, fit.frame)) {
        if (form->counterpart == nullptr) continue;
        const DriveModel model = with_cause(fit.frame, fit.findings, row, *form);
        const Reference reference = reference_of(fit.frame, model);
        const ModelFit expected = evaluate(fit.frame, model, reference);
        const auto written = specify(fit.frame, model);
        const RigModel file = through_a_file(written.model);
        ++written_ones;
        for (Equation equation : fit.frame.equations) {
          if (!is_simulated(equation)) continue;
          const double d = apart(fit, expected, file, equation);
          if (!written.notes.empty() || goes_by_measured_torque(row, equation)) continue;
          EXPECT_LT(d, 0.4) << row.id << ", " << form->equation << ", " << name_of(equation);
        }
      }
    }
  }
  EXPECT_GT(written_ones, 5);
}

INSTANTIATE_TEST_SUITE_P(
    Rigs, WrittenModel,
    testing::Values(WrittenCase{"locked", Rig::locked}, WrittenCase{"free", Rig::free},
                    WrittenCase{"servo", Rig::servo},
                    WrittenCase{"servo_of_another_constant", Rig::servo, {}, 0.9},
                    WrittenCase{"specimen", Rig::specimen},
                    WrittenCase{"joint", data::BenchKind(Rig::specimen, true)}),
    PrintedName());

}  // namespace
}  // namespace flexspline::studies
