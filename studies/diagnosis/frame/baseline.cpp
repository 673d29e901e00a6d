#include "diagnosis/frame/baseline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "diagnosis/frame/coordinates.hpp"
#include "diagnosis/frame/low_pass.hpp"
#include "flexspline/core/cubic_basis.hpp"
#include "flexspline/core/integrated_basis.hpp"
#include "flexspline/core/monotone_spline.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;

constexpr int kElasticKnots = 7;
constexpr int kDissipativeKnots = 11;
constexpr std::size_t kTravelIntervals = 24;
constexpr double kNarrowest = 1e-3;     // width of dry friction over the largest speed
constexpr std::size_t kDryWidths = 19;  // two to an octave: to half the largest speed
constexpr double kFree = -std::numeric_limits<double>::infinity();

std::vector<double> even_knots(int count) {
  std::vector<double> knots;
  for (int k = 1; k <= count; ++k) knots.push_back(k / static_cast<double>(count + 1));
  return knots;
}

// From the slowest of the recordings, or a tenth of the fastest, on: g^-1 is steepest near rest.
std::vector<double> rate_knots(const Frame& frame) {
  const double slow = std::clamp(frame.slow_rate / frame.rate_range, 1e-3, 0.1);
  std::vector<double> knots;
  for (int k = 0; k < kDissipativeKnots; ++k) {
    knots.push_back(slow * std::pow(0.75 / slow, k / static_cast<double>(kDissipativeKnots - 1)));
  }
  return knots;
}

// sgn(x) I_i(|x|) for every integrated spline i. Rows are written some at a time: they lie across
// the columns.
void odd_columns(const IntegratedBasis& basis, const ArrayXd& x, Eigen::Ref<MatrixXd> out) {
  constexpr Index kTogether = 64;
  const Index size = static_cast<Index>(basis.size());
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> some(kTogether, size);
  for (Index first = 0; first < x.size(); first += kTogether) {
    const Index count = std::min(kTogether, x.size() - first);
    for (Index r = 0; r < count; ++r) {
      auto row = some.row(r);
      basis.values(std::abs(x[first + r]), {row.data(), basis.size()});
      if (x[first + r] < 0.0) row = -row;
    }
    out.middleRows(first, count) = some.topRows(count);
  }
}

// odd_columns() times b: one cubic by row.
ArrayXd odd_sum(const IntegratedBasis& basis, const Eigen::VectorXd& b, const ArrayXd& x) {
  const auto knots = basis.breakpoints();
  LawSpec spec;
  spec.knots.assign(knots.begin() + 1, knots.end() - 1);
  spec.coefficients.assign(b.begin(), b.end());
  const MonotoneSpline law(std::move(spec));
  return x.unaryExpr([&law](double u) { return law.value(u); });
}

// The torsion from where it is unloaded: shape[2] is the zero's error over the range.
ArrayXd wound(const Frame& frame, std::span<const double> shape) {
  return frame.torsion / frame.torsion_range - shape[2];
}

ArrayXd modulation(const Frame& frame, std::span<const double> shape) {
  const ArrayXd x2 = wound(frame, shape).square();
  return (shape[0] * x2 + shape[1] * x2.square()).max(-2.0).min(2.0).exp();
}

// Differences of neighbouring coefficients, each over its own deviation.
void penalise_differences(const Frame& frame, const ArrayXd& deviation, Eigen::Ref<MatrixXd> rows) {
  rows.setZero();
  if (!(frame.torque_range > 0.0)) return;
  for (Index k = 0; k < deviation.size(); ++k) {
    rows(k, k + 1) = 1.0 / (deviation[k] * frame.torque_range);
    rows(k, k) = -rows(k, k + 1);
  }
}

// Where a coefficient stands between its neighbours: means of two knots, clamped (Greville).
ArrayXd midpoints(const IntegratedBasis& basis) {
  const auto knots = basis.breakpoints();
  const Index last = static_cast<Index>(knots.size()) - 1;
  const auto at = [&](Index k) {
    return 0.5 * (knots[static_cast<std::size_t>(std::clamp<Index>(k - 1, 0, last))] +
                  knots[static_cast<std::size_t>(std::clamp<Index>(k, 0, last))]);
  };
  return ArrayXd::NullaryExpr(static_cast<Index>(basis.size()) - 1,
                              [&](Index k) { return 0.5 * (at(k) + at(k + 1)); });
}

Eigen::VectorXd heights(const IntegratedBasis& basis) {
  Eigen::VectorXd whole(static_cast<Index>(basis.size()));
  basis.values(1.0, {whole.data(), basis.size()});
  return whole;
}

// f = sum_i c_i I_i(x); of a firm spring sum_i c_i (I_i(x) + e I_i(1) x), whose slope with c_i >= 0
// is nowhere below e/(1 + e) of its mean.
constexpr double kFirm = kLeastSlope / (1.0 - kLeastSlope);

void elastic_columns(const Frame& frame, const IntegratedBasis& basis, const ArrayXd& x,
                     Eigen::Ref<MatrixXd> out) {
  odd_columns(basis, x, out);
  if (!frame.firm_spring) return;
  const Eigen::VectorXd whole = heights(basis);
  for (Index k = 0; k < whole.size(); ++k) out.col(k) += kFirm * whole[k] * x.matrix();
}

ArrayXd elastic_sum(const Frame& frame, const IntegratedBasis& basis, const Eigen::VectorXd& c,
                    const ArrayXd& x) {
  ArrayXd sum = odd_sum(basis, c, x);
  if (frame.firm_spring) sum += kFirm * heights(basis).dot(c) * x;
  return sum;
}

/// The laws of a gear, what they are taken at, and how many parameters each has.
struct GearLaws {
  GearLaws(const Frame& frame, std::span<const double> shape)
      : elastic(even_knots(kElasticKnots)),
        dissipative(rate_knots(frame)),
        f(static_cast<Index>(elastic.size())),
        g(static_cast<Index>(dissipative.size())),
        torsion(wound(frame, shape)),
        rate(frame.torsion_rate / frame.rate_range / modulation(frame, shape)),
        offset(frame.rig == Rig::specimen),
        drag(frame.torque_by_inertia) {}

  Index size() const { return f + g + (offset || drag ? 1 : 0); }

  IntegratedBasis elastic, dissipative;
  Index f, g;
  ArrayXd torsion, rate;
  bool offset;
  bool drag;  ///< of the load, which its inertia's torque is without
};

MatrixXd prior_of(const Frame& frame, const GearLaws& laws) {
  const auto& [elastic, dissipative, f, g, torsion, rate, offset, drag] = laws;
  MatrixXd prior = MatrixXd::Zero(f + g - 2, laws.size());
  penalise_differences(frame, ArrayXd::Ones(f - 1), prior.topLeftCorner(f - 1, f));
  penalise_differences(frame, midpoints(dissipative).inverse(), prior.block(f - 1, f, g - 1, g));
  return prior;
}

BaselineColumns gear_columns(const Frame& frame, std::span<const double> shape) {
  const GearLaws laws(frame, shape);
  const auto& [elastic, dissipative, f, g, torsion, rate, offset, drag] = laws;
  BaselineColumns c{MatrixXd(frame.rows(), laws.size()), Eigen::VectorXd::Zero(laws.size()), f, g,
                    prior_of(frame, laws)};
  elastic_columns(frame, elastic, torsion, c.columns.leftCols(f));
  odd_columns(dissipative, rate, c.columns.middleCols(f, g));
  if (offset) {
    c.columns.col(f + g).setOnes();
    c.lower[f + g] = kFree;
  }
  if (drag) c.columns.col(f + g) = -frame.load_speed;
  return c;
}

BaselineTorque gear_torque(const Frame& frame, std::span<const double> shape,
                           const Eigen::VectorXd& b) {
  const GearLaws laws(frame, shape);
  return {elastic_sum(frame, laws.elastic, b.head(laws.f), laws.torsion),
          odd_sum(laws.dissipative, b.segment(laws.f, laws.g), laws.rate),
          laws.offset ? b[laws.f + laws.g] : 0.0, prior_of(frame, laws) * b,
          laws.drag ? ArrayXd(-b[laws.f + laws.g] * frame.load_speed) : ArrayXd()};
}

CubicBasis positions(const Frame& frame) { return {frame.lowest, frame.highest, kTravelIntervals}; }

MatrixXd travelling_prior(const Frame& frame, Index f, Index g) {
  MatrixXd prior = MatrixXd::Zero(f - 1, f + g);
  penalise_differences(frame, ArrayXd::Ones(f - 1), prior.leftCols(f));
  return prior;
}

// Of half the width: tanh(2u) = 2t/(1 + t^2), t = tanh(u).
ArrayXd sharper(const ArrayXd& t) { return 2.0 * t / (1.0 + t.square()); }

// Each of dry_widths() is half of the next but one.
void dry_columns(const ArrayXd& speed, const std::vector<double>& widths,
                 Eigen::Ref<MatrixXd> out) {
  for (Index k = out.cols() - 1; k >= 0; --k) {
    out.col(k) = k + 2 < out.cols() ? sharper(out.col(k + 2))
                                    : rounded_sign(speed, widths[static_cast<std::size_t>(k)]);
  }
}

BaselineColumns travelling_columns(const Frame& frame) {
  const CubicBasis position = positions(frame);
  const Index f = static_cast<Index>(position.size());
  const auto widths = dry_widths(frame.rate_range);
  const Index g = static_cast<Index>(widths.size()) + 1;
  BaselineColumns c{MatrixXd::Zero(frame.rows(), f + g), Eigen::VectorXd::Zero(f + g), f, g,
                    travelling_prior(frame, f, g)};
  c.lower.head(f).setConstant(kFree);
  for (Index r = 0; r < frame.rows(); ++r) {
    const auto local = position.at(frame.torsion[r]);
    for (std::size_t k = 0; k < 4; ++k) {
      c.columns(r, static_cast<Index>(local.first + k)) = local.value[k];
    }
  }
  dry_columns(frame.torsion_rate, widths, c.columns.middleCols(f, g - 1));
  c.columns.col(f + g - 1) = frame.torsion_rate / frame.rate_range;
  return c;
}

BaselineTorque travelling_torque(const Frame& frame, const Eigen::VectorXd& b) {
  const CubicBasis position = positions(frame);
  const Index f = static_cast<Index>(position.size());
  const auto widths = dry_widths(frame.rate_range);
  const Index g = static_cast<Index>(widths.size()) + 1;
  ArrayXd elastic = ArrayXd::Zero(frame.rows());
  for (Index r = 0; r < frame.rows(); ++r) {
    const auto local = position.at(frame.torsion[r]);
    for (std::size_t k = 0; k < 4; ++k) {
      elastic[r] += b[static_cast<Index>(local.first + k)] * local.value[k];
    }
  }
  ArrayXd dissipative = b[f + g - 1] / frame.rate_range * frame.torsion_rate;
  for (const Index widest : {g - 2, g - 3}) {
    ArrayXd sign = rounded_sign(frame.torsion_rate, widths[static_cast<std::size_t>(widest)]);
    for (Index k = widest;; k -= 2) {
      dissipative += b[f + k] * sign;
      if (k < 2) break;
      sign = sharper(sign);
    }
  }
  return {std::move(elastic), std::move(dissipative), 0.0, travelling_prior(frame, f, g) * b};
}

// Dry friction rises and saturates in its own way: a mixture of tanh of several widths.
BaselineColumns motor_columns(const Frame& frame) {
  const auto widths = dry_widths(frame.speed_range);
  const Index n = static_cast<Index>(widths.size());
  const Index load = frame.rig == Rig::servo ? 2 : 0;
  BaselineColumns c{MatrixXd(frame.rows(), 1 + n + load), Eigen::VectorXd::Zero(1 + n + load), 1, n,
                    MatrixXd(0, 1 + n + load)};
  c.columns.col(0) = frame.motor_speed;
  dry_columns(frame.motor_speed, widths, c.columns.middleCols(1, n));
  if (load > 0) {
    c.columns.col(1 + n) = frame.gravity;
    c.columns.col(2 + n) = frame.load_acceleration;
  }
  return c;
}

BaselineColumns before_a_filter(const Frame& frame, Equation equation,
                                std::span<const double> shape) {
  if (equation == Equation::torsion) {
    return frame.travels ? travelling_columns(frame) : gear_columns(frame, shape);
  }
  if (equation == Equation::load)
    return {frame.load_speed, Eigen::VectorXd::Zero(1), 0, 1, MatrixXd(0, 1)};
  return motor_columns(frame);
}

}  // namespace

Index prior_rows(const Frame& frame, Equation equation) {
  if (equation != Equation::torsion) return 0;
  if (frame.travels) return static_cast<Index>(kTravelIntervals) + 2;
  return kElasticKnots + 2 + kDissipativeKnots + 2;
}

std::vector<double> dry_widths(double largest) {
  std::vector<double> widths;
  for (std::size_t k = 0; k < kDryWidths; ++k) {
    widths.push_back(kNarrowest * largest * std::exp2(0.5 * static_cast<double>(k)));
  }
  return widths;
}

ArrayXd target_of(const Frame& frame, Equation equation) {
  switch (equation) {
    case Equation::torsion:
      return frame.torque;
    case Equation::load:
      return frame.torque - frame.load_inertia * frame.load_acceleration;
    case Equation::motor:
      break;
  }
  if (frame.rig == Rig::servo) return frame.motor_torque;
  return frame.motor_torque - frame.motor_inertia * frame.motor_acceleration -
         frame.torque / frame.ratio;
}

Frame motion_at(const Frame& frame, const std::vector<Index>& rows) {
  Frame few;
  few.rig = frame.rig;
  few.travels = frame.travels;
  few.firm_spring = frame.firm_spring;
  few.torque_by_inertia = frame.torque_by_inertia;
  few.torque_range = frame.torque_range;
  few.torsion_range = frame.torsion_range;
  few.lowest = frame.lowest;
  few.highest = frame.highest;
  few.rate_range = frame.rate_range;
  few.slow_rate = frame.slow_rate;
  few.speed_range = frame.speed_range;
  few.time = frame.time(rows);
  few.torsion = frame.torsion(rows);
  few.torsion_rate = frame.torsion_rate(rows);
  few.motor_speed = frame.motor_speed(rows);
  few.load_speed = frame.load_speed(rows);
  few.load_acceleration = frame.load_acceleration(rows);
  if (frame.rig == Rig::servo) few.gravity = frame.gravity(rows);
  return few;
}

BaselineColumns baseline_columns(const Frame& frame, Equation equation,
                                 std::span<const double> shape) {
  BaselineColumns c = before_a_filter(frame, equation, shape);
  if (frame.torque_lag > 0.0) shared_low_pass(frame, frame.torque_lag)->apply(c.columns);
  return c;
}

BaselineTorque baseline_torque(const Frame& frame, std::span<const double> shape,
                               const Eigen::VectorXd& b) {
  BaselineTorque torque =
      frame.travels ? travelling_torque(frame, b) : gear_torque(frame, shape, b);
  if (frame.torque_lag > 0.0) {
    const auto filter = shared_low_pass(frame, frame.torque_lag);
    for (ArrayXd* part : {&torque.elastic, &torque.dissipative}) filter->apply(part->matrix());
  }
  return torque;
}

ArrayXd told_torque(const Frame& frame) {
  const MatrixXd x = baseline_columns(frame, Equation::torsion, std::vector(3, 0.0)).columns;
  const MatrixXd rows = frame.usable.matrix().asDiagonal() * x;
  const Eigen::VectorXd torque = (frame.torque * frame.usable).matrix();
  return (x * rows.colPivHouseholderQr().solve(torque)).array();
}

}  // namespace flexspline::studies
