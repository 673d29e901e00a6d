#include "posterior/torsion_posterior.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>

namespace flexspline::estimators {
namespace {

constexpr std::size_t kMotionIntervals = 80;
constexpr std::size_t kSpeedIntervals = 60;
constexpr std::size_t kModulationIntervals = 56;
constexpr double kFineSpeed = 0.02;       // of the largest: below it the coordinate is logarithmic
constexpr Eigen::Index kPerGroup = 7;     // second differences that share a roughness
constexpr double kFirstPrecision = 1e-2;  // of the largest information
constexpr double kFirstOfOne = 1e-8;      // a jump is taken as such before the spline steepens
constexpr double kFirstOfH = 1.0;         // h bends where f and g^-1 leave it to
constexpr double kFurthest = 0.5;         // of ln h in one step
constexpr int kSteps = 24;                // linearisations
constexpr int kRounds = 3;                // of the precisions, each
constexpr double kSettled = 0.05;         // standard deviations that a step may still move by
constexpr double kRefuted = 4.0;          // standard deviations of a sum of squares

constexpr int kFamilyOfH = 3;

void add_spline(std::vector<PriorGroup>& groups, Eigen::Index first, Eigen::Index size,
                int family) {
  const Eigen::Index differences = size - 2;
  const Eigen::Index parts = std::max<Eigen::Index>(1, differences / kPerGroup);
  for (Eigen::Index k = 0; k < parts; ++k) {
    const Eigen::Index from = k * differences / parts;
    const Eigen::Index to = (k + 1) * differences / parts;
    groups.push_back({.first = first + from, .count = to - from, .family = family});
  }
}

std::vector<PriorGroup> groups_of(const RichLaws& laws, const RegressionColumns& at) {
  std::vector<PriorGroup> groups;
  add_spline(groups, at.f, laws.f.size(), 1);
  add_spline(groups, at.g, laws.g_inverse.size(), 2);
  if (at.h >= 0) add_spline(groups, at.h, laws.log_h.size(), kFamilyOfH);
  for (Eigen::Index one : {at.jump, at.inertia, at.delay}) {
    groups.push_back({.first = one, .count = 1, .width = 1});
  }
  groups.push_back({.first = at.motion, .count = at.size - at.motion, .width = 1, .held = true});
  return groups;
}

// Smooth f and g^-1, h nearly straight, a jump that is free: so a kink or a jump is taken as such
// before h bends or g^-1 steepens to stand in for it.
void begin(std::vector<PriorGroup>& groups, double typical) {
  for (auto& group : groups) {
    if (group.held) continue;
    const double share = group.width == 1             ? kFirstOfOne
                         : group.family == kFamilyOfH ? kFirstOfH
                                                      : kFirstPrecision;
    group.precision = share * typical;
  }
}

struct Normal {
  Eigen::MatrixXd information;
  Eigen::VectorXd gradient;
  std::vector<RegressionRows> plain;     // Nm, a record each
  std::vector<RegressionRows> whitened;  // in noises, independent
};

// Rows of records without repeats carry the noise of the motion one by one; then the colour goes.
RegressionRows whitened(const FoldedRecord& one, RegressionRows rows) {
  if (one.motion_sigma > 0.0) {
    const Eigen::VectorXd weight =
        (1.0 + (rows.along_motion * (one.motion_sigma / one.noise.sigma)).array().square()).rsqrt();
    rows.jacobian = weight.asDiagonal() * rows.jacobian;
    rows.target = rows.target.cwiseProduct(weight);
  }
  const WhiteningFilter filter(one.noise, one.time);
  const auto n = static_cast<std::size_t>(rows.target.size());
  for (auto column : rows.jacobian.colwise()) filter.whiten({column.data(), n});
  filter.whiten({rows.target.data(), n});
  return rows;
}

Normal normal_equations(const TorsionRegression& all, const std::vector<FoldedRecord>& records,
                        const Eigen::VectorXd& c) {
  Normal normal;
  normal.information = Eigen::MatrixXd::Zero(c.size(), c.size());
  normal.gradient = Eigen::VectorXd::Zero(c.size());
  for (std::size_t r = 0; r < records.size(); ++r) {
    normal.plain.push_back(all.linearise(r, c));
    normal.whitened.push_back(whitened(records[r], normal.plain.back()));
    const auto& rows = normal.whitened.back();
    normal.information.selfadjointView<Eigen::Lower>().rankUpdate(rows.jacobian.transpose());
    normal.gradient += rows.jacobian.transpose() * rows.target;
  }
  normal.information = Eigen::MatrixXd(normal.information.selfadjointView<Eigen::Lower>());
  return normal;
}

Eigen::VectorXd left_of(const RegressionRows& rows, const Eigen::VectorXd& c) {
  return rows.target - rows.jacobian * c;
}

double edf_of(const Eigen::MatrixXd& jacobian, const Eigen::MatrixXd& covariance) {
  return (jacobian * covariance).cwiseProduct(jacobian).sum();
}

// Share of a step in which ln h moves no further than the linearisation reaches.
double shortened(const TorsionPosterior& model, const Eigen::VectorXd& step) {
  if (model.at.h < 0) return 1.0;
  const double largest = step.segment(model.at.h, model.laws.log_h.size()).cwiseAbs().maxCoeff();
  return std::min(1.0, kFurthest / std::max(largest, 1e-300));
}

// Largest step of what is no error of the motion, in standard deviations.
double largest_move(const TorsionPosterior& model, const Eigen::VectorXd& step) {
  const auto variance = model.law.covariance.diagonal().head(model.at.motion);
  return (step.head(model.at.motion).cwiseAbs().array() / variance.cwiseSqrt().array()).maxCoeff();
}

// Takes the noise of recordings that leave more than it from what they leave.
bool take_misfit(TorsionPosterior& model, std::vector<FoldedRecord>& records, const Normal& normal,
                 const std::vector<PreparedRecord>& prepared) {
  bool changed = false;
  double squares = 0.0;
  double freedom = 0.0;
  for (std::size_t r = 0; r < records.size(); ++r) {
    const Eigen::VectorXd left = left_of(normal.whitened[r], model.law.mean);
    const double own = static_cast<double>(left.size()) -
                       edf_of(normal.whitened[r].jacobian, model.law.covariance);
    squares += left.squaredNorm();
    freedom += own;
    const bool refuted = left.squaredNorm() > own + kRefuted * std::sqrt(2.0 * own);
    if (!refuted && records[r].repeats) continue;
    if (refuted && records[r].repeats) model.misfits.push_back(prepared[r].record.id);
    const Eigen::VectorXd raw = left_of(normal.plain[r], model.law.mean);
    records[r].noise = noise_of(records[r], {raw.begin(), raw.end()});
    changed = true;
  }
  model.misfit = std::sqrt(squares / freedom);
  return changed;
}

std::array<double, 2> value_of(const TorsionPosterior& model, const RichSpline& spline,
                               Eigen::Index first, double x, double jump) {
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(model.law.mean.size());
  Eigen::RowVectorXd own(spline.size());
  spline.value(x, own);
  row.segment(first, own.size()) = own;
  row[model.at.jump] = jump;
  double variance = row.dot(model.law.covariance * row.transpose());
  // Beyond the ends the prior goes on: the second derivative wanders as at the roughest place.
  const double out = spline.beyond(x);
  if (out > 0.0) {
    double precision = std::numeric_limits<double>::infinity();
    for (const auto& group : model.groups) {
      const bool of_it = group.first >= first && group.first < first + own.size();
      if (of_it) precision = std::min(precision, group.precision);
    }
    variance += out * out * out / 3.0 / precision;
  }
  return {row.dot(model.law.mean), std::sqrt(std::max(0.0, variance))};
}

Result<RichLaws> rich_laws(const std::vector<PreparedRecord>& prepared,
                           const std::vector<FoldedRecord>& records, const TorsionLayout& layout,
                           std::span<const double> p) {
  const auto h = make_law(layout.h(p));
  if (!h) return tl::unexpected(h.error());
  double fastest = 0.0;
  for (const auto& one : records) {
    for (std::size_t i = 0; i < one.time.size(); ++i) {
      fastest = std::max(fastest, std::abs(one.velocity[i] / (*h)->value(one.position[i])));
    }
  }
  const Ranges ranges = ranges_of(prepared, false);
  const double low = ranges.lowest_motion;
  const double high = ranges.highest_motion;
  return RichLaws{.f = RichSpline(low, high, kMotionIntervals, 0.0),
                  .g_inverse = RichSpline(-fastest, fastest, kSpeedIntervals, kFineSpeed * fastest),
                  .log_h = RichSpline(low, high, kModulationIntervals, 0.0)};
}

void iterate(TorsionPosterior& model, std::vector<FoldedRecord>& records,
             const std::vector<PreparedRecord>& prepared) {
  const TorsionRegression all(model.laws, model.at, records);
  Eigen::VectorXd c = Eigen::VectorXd::Zero(model.at.size);
  bool noise_taken = false;
  for (int step = 0; step < kSteps; ++step) {
    const Normal normal = normal_equations(all, records, c);
    // The first step sees no h: its columns begin where g^-1 has a slope.
    if (step < 2) begin(model.groups, normal.information.diagonal().maxCoeff());
    model.law = restricted_likelihood(normal.information, normal.gradient, model.groups, kRounds);
    const Eigen::VectorXd moved = model.law.mean - c;
    c += moved * shortened(model, moved);
    const bool settled = largest_move(model, moved) < kSettled;
    if (step < 2 || !(settled || (!noise_taken && step >= kSteps / 2))) continue;
    if (noise_taken || !take_misfit(model, records, normal, prepared)) break;
    noise_taken = true;
  }
}

}  // namespace

std::array<double, 2> TorsionPosterior::f_at(double phi) const {
  return value_of(*this, laws.f, at.f, phi, 0.0);
}

std::array<double, 2> TorsionPosterior::g_inverse_at(double speed) const {
  return value_of(*this, laws.g_inverse, at.g, speed, speed > 0.0 ? 1.0 : speed < 0.0 ? -1.0 : 0.0);
}

std::array<double, 2> TorsionPosterior::log_h_at(double phi) const {
  return value_of(*this, laws.log_h, at.h, phi, 0.0);
}

Result<TorsionPosterior> torsion_posterior(const std::vector<PreparedRecord>& prepared,
                                           const TorsionLayout& layout, std::span<const double> p,
                                           bool with_h) {
  std::vector<FoldedRecord> records;
  for (const auto& one : prepared) records.push_back(folded(one));
  const auto laws = rich_laws(prepared, records, layout, p);
  if (!laws) return tl::unexpected(laws.error());
  const RegressionColumns at = regression_columns(*laws, records, with_h);
  TorsionPosterior model{.laws = *laws, .at = at, .groups = groups_of(*laws, at)};
  iterate(model, records, prepared);
  if (!model.law.mean.allFinite() || !model.law.covariance.allFinite()) {
    return failure(ErrorCode::numerics, "the penalised splines of eq. (4) have no finite law",
                   "leave out recordings that hardly move");
  }
  return model;
}

}  // namespace flexspline::estimators
