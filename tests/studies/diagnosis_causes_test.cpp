#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "diagnosis/model/cause.hpp"
#include "diagnosis/model/model.hpp"
#include "diagnosis/search/search.hpp"
#include "diagnosis_checks.hpp"
#include "drive_frame.hpp"
#include "flexspline/core/effect.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr Rig kRigs[] = {Rig::locked, Rig::free, Rig::specimen};

const std::map<std::string_view, std::string_view> kContract = {
    {"presliding_hysteresis", "reversal_memory"},
    {"viscoelastic_creep", "lag"},
    {"backlash", "torsion"},
    {"direction_asymmetry", "velocity"},
    {"stribeck_friction", "velocity"},
    {"nonlinear_viscous_friction", "velocity"},
    {"load_dependent_friction", "load"},
    {"position_dependent_friction", "motor_angle"},
    {"kinematic_error", "motor_angle"},
    {"motor_torque_ripple", "motor_angle"},
    {"gravity_load", "load_angle"},
    {"inertia_torque", "acceleration"},
    {"thermal_friction_drift", "time"},
    {"torque_sensor_offset", "constant"},
    {"torque_sensor_drift", "time"},
    {"sensor_delay", "lag"},
    {"motor_torque_offset", "constant"},
    {"torque_constant_error", "load"},
    {"torque_sensor_gain", "load"},
    {"series_compliance", "torsion"},
    {"soft_windup", "torsion"},
    {"encoder_skew", "lag"},
    {"encoder_eccentricity", "motor_angle"},
    {"current_lag", "lag"},
    {"sensor_crosstalk", "motor_angle"}};

/// The frame of one drawn bench without an effect, by rig; with a baseline fitted to it.
struct Bench {
  Frame frame;
  Findings baseline;
};

const Bench& bench(Rig rig) {
  static const std::map<Rig, Bench> benches = [] {
    std::map<Rig, Bench> made;
    for (const Rig each : kRigs) {
      Frame frame = drawn_frame(each);
      const auto baseline = fit_baseline(frame);
      EXPECT_TRUE(baseline.has_value()) << (baseline ? "" : baseline.error().message());
      made[each] = {frame, baseline.value_or(Findings{})};
    }
    return made;
  }();
  return benches.at(rig);
}

/// Calls with every form of every cause that a rig's bench has, with a trace of which it is.
template <class Check>
void on_every_form(const Check& check) {
  for (const Rig rig : kRigs) {
    for (const CauseRow& row : causes()) {
      for (const CauseForm* form : forms_on(row, bench(rig).frame)) {
        SCOPED_TRACE(std::string(row.id) + " on " + std::string(name_of(rig)) + ": " +
                     std::string(form->equation));
        check(bench(rig), row, *form);
      }
    }
  }
}

std::vector<Shape> shapes_of(const CauseForm& form, const Frame& frame) {
  return form.shapes == nullptr ? std::vector<Shape>{} : form.shapes(frame);
}

// All shapes at one share of their range.
std::vector<double> shape_at(const CauseForm& form, const Frame& frame, double share) {
  std::vector<double> values;
  for (const Shape& s : shapes_of(form, frame)) {
    const double value = s.logarithmic && !s.discrete ? s.lower * std::pow(s.upper / s.lower, share)
                                                      : s.lower + share * (s.upper - s.lower);
    values.push_back(s.discrete ? std::round(value) : value);
  }
  return values;
}

TEST(Causes, AreTheContractsEachOnceInItsCoordinateAndEffectsSoughtByTheirLaw) {
  std::set<std::string_view> seen;
  for (const CauseRow& row : causes()) {
    EXPECT_TRUE(seen.insert(row.id).second) << row.id << " twice";
    const auto known = kContract.find(row.id);
    if (known != kContract.end()) {
      EXPECT_EQ(row.coordinate, known->second) << row.id;
      continue;
    }
    const auto effect = find_effect(row.id);
    ASSERT_TRUE(effect) << row.id << " is neither the contract's nor an effect";
    EXPECT_TRUE(sought_by_law(**effect)) << row.id;
  }
  for (const auto& [id, coordinate] : kContract) EXPECT_TRUE(seen.contains(id)) << id;
}

TEST(Causes, AreOrganisedAsTheEffectsThatCanBeConcealed) {
  std::size_t matched = 0;
  for (const CauseRow& row : causes()) {
    for (const data::HiddenRow& hidden : data::hidden_effects()) {
      if (hidden.id != row.id) continue;
      EXPECT_EQ(hidden.coordinate, row.coordinate) << row.id;
      ++matched;
    }
  }
  EXPECT_GT(matched, 20U);
}

// On a specimen what is in series with the spring is the spring.
TEST(Causes, AreTriedOnEveryDriveThatCanConcealThem) {
  for (const data::HiddenRow& hidden : data::hidden_effects()) {
    for (const CauseRow& row : causes()) {
      if (hidden.id != row.id) continue;
      for (const Rig rig : hidden.rigs) {
        if (rig != Rig::locked && rig != Rig::free) continue;
        EXPECT_FALSE(forms_on(row, bench(rig).frame).empty()) << row.id << " on " << name_of(rig);
      }
    }
  }
}

TEST(Causes, HaveAnEquationRigsAndSomethingToDo) {
  for (const CauseRow& row : causes()) {
    SCOPED_TRACE(row.id);
    EXPECT_FALSE(row.forms.empty());
    for (const CauseForm& form : row.forms) {
      EXPECT_FALSE(form.equation.empty());
      EXPECT_FALSE(form.rigs.empty());
      EXPECT_FALSE(form.at.empty());
      EXPECT_NE(form.columns == nullptr, form.transform == nullptr) << "one of the two";
      EXPECT_TRUE(form.transform == nullptr || form.shapes != nullptr) << "a change has a size";
      EXPECT_TRUE(form.start == nullptr || form.shapes != nullptr);
      EXPECT_EQ(std::set<Equation>(form.at.begin(), form.at.end()).size(), form.at.size());
      EXPECT_EQ(std::set<Rig>(form.rigs.begin(), form.rigs.end()).size(), form.rigs.size());
    }
  }
}

TEST(Causes, ShapesHaveAWideFiniteRange) {
  on_every_form([](const Bench& b, const CauseRow&, const CauseForm& form) {
    const auto shapes = shapes_of(form, b.frame);
    std::set<std::string_view> names;
    for (const Shape& s : shapes) {
      EXPECT_TRUE(std::isfinite(s.lower) && std::isfinite(s.upper)) << s.name;
      EXPECT_LT(s.lower, s.upper) << s.name;
      EXPECT_TRUE(!s.logarithmic || s.lower > 0.0) << s.name << " has no logarithm";
      EXPECT_FALSE(s.unit.empty()) << s.name;
      EXPECT_GT(s.grid, 0) << s.name;
      EXPECT_TRUE(names.insert(s.name).second) << s.name << " twice";
    }
    if (form.start == nullptr) return;
    const auto start = form.start(b.frame);
    ASSERT_EQ(start.size(), shapes.size());
    for (std::size_t k = 0; k < start.size(); ++k) {
      EXPECT_GE(start[k], shapes[k].lower) << shapes[k].name;
      EXPECT_LE(start[k], shapes[k].upper) << shapes[k].name;
    }
  });
}

TEST(Causes, ColumnsAreFiniteAndAsManyInEveryEquationAtEveryShape) {
  on_every_form([](const Bench& b, const CauseRow&, const CauseForm& form) {
    if (form.columns == nullptr) return;
    std::set<std::size_t> counts;
    for (const double share : {0.0, 0.5, 1.0}) {
      const auto shape = shape_at(form, b.frame, share);
      std::vector<double> largest;
      for (const Equation equation : form.at) {
        if (!b.frame.has(equation)) continue;
        const Columns columns = form.columns(equation, b.frame, b.baseline.reference, shape);
        counts.insert(columns.size());
        largest.resize(columns.size(), 0.0);
        for (std::size_t k = 0; k < columns.size(); ++k) {
          ASSERT_EQ(columns[k].size(), b.frame.rows());
          EXPECT_TRUE(columns[k].allFinite());
          largest[k] = std::max(largest[k], columns[k].abs().maxCoeff());
        }
      }
      EXPECT_GT(*std::ranges::min_element(largest), 0.0) << "a column that does nothing";
    }
    EXPECT_EQ(counts.size(), 1U);
  });
}

TEST(Causes, TransformsLeaveEverythingFinite) {
  on_every_form([](const Bench& b, const CauseRow&, const CauseForm& form) {
    if (form.transform == nullptr) return;
    for (const double share : {0.0, 0.3, 0.7, 1.0}) {
      Frame changed = b.frame;
      form.transform(changed, shape_at(form, b.frame, share));
      for (const ArrayXd* x : {&changed.torsion, &changed.torsion_rate, &changed.torque,
                               &changed.motor_torque, &changed.load_acceleration}) {
        EXPECT_TRUE(x->allFinite()) << share;
      }
    }
  });
}

double change(const ArrayXd& a, const ArrayXd& b) {
  return (a - b).abs().maxCoeff() / std::max(a.abs().maxCoeff(), 1e-300);
}

// Where zero is no shape that is searched, a millionth of the smallest one.
TEST(Causes, TransformsOfNoSizeChangeNothing) {
  on_every_form([](const Bench& b, const CauseRow&, const CauseForm& form) {
    if (form.transform == nullptr) return;
    std::vector<double> shape;
    double tolerance = 1e-15;
    for (const Shape& s : shapes_of(form, b.frame)) {
      const bool zero = s.lower <= 0.0 && s.upper >= 0.0;
      shape.push_back(zero ? 0.0 : 1e-6 * s.lower);
      if (!zero) tolerance = 1e-6;
    }
    Frame changed = b.frame;
    form.transform(changed, shape);
    EXPECT_LE(change(b.frame.torsion, changed.torsion), tolerance);
    EXPECT_LE(change(b.frame.torque, changed.torque), tolerance);
    EXPECT_LE(change(b.frame.motor_torque, changed.motor_torque), tolerance);
    EXPECT_LE(change(b.frame.load_acceleration, changed.load_acceleration), tolerance);
    if (tolerance > 1e-15) return;
    EXPECT_EQ(change(b.frame.torsion_rate, changed.torsion_rate), 0.0);
  });
}

TEST(Causes, TransformsOfSomeSizeChangeSomething) {
  on_every_form([](const Bench& b, const CauseRow&, const CauseForm& form) {
    if (form.transform == nullptr) return;
    Frame changed = b.frame;
    form.transform(changed, shape_at(form, b.frame, 0.9));
    const double most =
        std::max({change(b.frame.torsion, changed.torsion), change(b.frame.torque, changed.torque),
                  change(b.frame.motor_torque, changed.motor_torque)});
    EXPECT_GT(most, 1e-3);
  });
}

TEST(Causes, ContributeNothingWhereTheirAmplitudeIsZero) {
  on_every_form([](const Bench& b, const CauseRow& row, const CauseForm& form) {
    if (form.columns == nullptr) return;
    const auto shape = shape_at(form, b.frame, 0.5);
    const auto count = form.columns(form.at.front(), b.frame, b.baseline.reference, shape).size();
    DriveModel model = b.baseline.fit.model;
    model.causes = {{&row, &form, shape}};
    model.coefficients = {Eigen::VectorXd::Zero(static_cast<Index>(count))};
    for (const Equation equation : form.at) {
      if (!b.frame.has(equation)) continue;
      const ArrayXd silent = contribution(b.frame, model, b.baseline.reference, 0, equation);
      EXPECT_EQ(silent.abs().maxCoeff(), 0.0) << name_of(equation);
      DriveModel loud = model;
      loud.coefficients.front().setOnes();
      const Columns columns = form.columns(equation, b.frame, b.baseline.reference, shape);
      ArrayXd sum = ArrayXd::Zero(b.frame.rows());
      for (const ArrayXd& column : columns) sum += column;
      const ArrayXd added = contribution(b.frame, loud, b.baseline.reference, 0, equation);
      EXPECT_LE((added - sum).abs().maxCoeff(),
                1e-9 * (sum.abs().maxCoeff() + b.frame.torque_range));
    }
  });
}

// The rate that a change leaves is the rate of the angle that it leaves; a form that changes the
// spring alone leaves the rate as it was.
TEST(Causes, TransformsOfTheTorsionKeepItsRateItsRate) {
  const Frame frame = closed_form_frame(40000, 1e-4);
  int checked = 0;
  for (const CauseRow& row : causes()) {
    for (const CauseForm* form : forms_on(row, frame)) {
      if (form->transform == nullptr) continue;
      SCOPED_TRACE(std::string(row.id) + ": " + std::string(form->equation));
      Frame changed = frame;
      form->transform(changed, shape_at(*form, frame, 0.6));
      if (change(frame.torsion_rate, changed.torsion_rate) == 0.0) continue;
      ++checked;
      double worst = 0.0;
      for (const Segment& s : frame.segments) {
        for (Index r = s.first + 1; r + 1 < s.first + s.count; ++r) {
          const double slope = (changed.torsion[r + 1] - changed.torsion[r - 1]) /
                               (changed.time[r + 1] - changed.time[r - 1]);
          worst = std::max(worst, std::abs(slope - changed.torsion_rate[r]));
        }
      }
      EXPECT_LT(worst, 0.02 * changed.torsion_rate.abs().maxCoeff());
    }
  }
  EXPECT_GE(checked, 5);
}

TEST(Causes, OfTheTorqueSignalKeepTheRatioOfTheirEquations) {
  const Frame& frame = bench(Rig::free).frame;
  int checked = 0;
  for (const CauseRow& row : causes()) {
    for (const CauseForm* form : forms_on(row, frame)) {
      if (form->columns == nullptr || form->at.size() < 3) continue;
      const auto shape = shape_at(*form, frame, 0.5);
      const auto& reference = bench(Rig::free).baseline.reference;
      const Columns load = form->columns(Equation::load, frame, reference, shape);
      const Columns motor = form->columns(Equation::motor, frame, reference, shape);
      for (std::size_t k = 0; k < load.size(); ++k) {
        EXPECT_LT(change(load[k], -frame.ratio * motor[k]), 1e-12) << row.id;
      }
      ++checked;
    }
  }
  EXPECT_GE(checked, 4);
}

// A sensor's noise that has a colour is in its smoothed torque, too: to undo a delay must not take
// any of it out, or every delay would fit better than none.
TEST(SensorDelay, IsUndoneWithoutTheNoiseOfTheTorque) {
  Frame frame = closed_form_frame();
  const ArrayXd noise = 5.0 * (7.0 * frame.time).sin() * (31.0 * frame.clock).cos();
  frame.torque += noise;
  frame.smooth_torque += noise;
  const CauseRow& row =
      *std::ranges::find(causes(), std::string_view("sensor_delay"), &CauseRow::id);
  const auto forms = forms_on(row, frame);
  const auto form = std::ranges::find_if(
      forms, [](const CauseForm* one) { return one->at.front() == Equation::torsion; });
  ASSERT_NE(form, forms.end());
  constexpr double kDelay = 4e-3;  // two rows
  Frame then = frame;
  (*form)->transform(then, std::vector{kDelay});
  EXPECT_TRUE((then.torque == frame.torque).all());
  // What the motor felt is what the sensor shows d later.
  const ArrayXd felt = frame.told_torque - frame.ratio * (then.motor_torque - frame.motor_torque);
  const Eigen::Index n = frame.segments.front().count - 2;
  EXPECT_LT((felt.head(n) - frame.told_torque.segment(2, n)).abs().maxCoeff(),
            1e-3 * frame.torque_range);
  // Torsion and load are those of d ago, to the second and the first order in d.
  EXPECT_LT((then.torsion.segment(2, n) - frame.torsion.head(n)).abs().maxCoeff(),
            1e-3 * frame.torsion_range);
  EXPECT_LT(
      (then.load_acceleration.segment(2, n) - frame.load_acceleration.head(n)).abs().maxCoeff(),
      1e-3 * frame.load_acceleration.abs().maxCoeff());
}

}  // namespace
}  // namespace flexspline::studies
