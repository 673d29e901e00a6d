#include "posterior/torsion_posterior.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>

namespace flexspline::estimators {
namespace {

constexpr std::size_t kMotionIntervals = 100;
constexpr std::size_t kSpeedIntervals = 60;
constexpr std::size_t kModulationIntervals = 72;
// Of the range: below it the coordinate is logarithmic. f and h are finest where f(0) = 0 and
// h(0) = 1 hold them, as a kink there that is smoothed would move them everywhere.
constexpr double kFineMotion = 0.02;
constexpr double kFineSpeed = 0.02;
constexpr Eigen::Index kPerGroup = 4;     // second differences that share a roughness
constexpr double kFirstPrecision = 1e-2;  // of the largest information
constexpr double kFirstOfOne = 1e-8;      // a jump is taken as such before the spline steepens
constexpr double kFirstOfH = 1.0;         // h bends where f and g^-1 leave it to
constexpr double kFirstOfFreeH = 1e-4;    // or h bends first
constexpr double kFurthest = 0.5;         // of ln h in one step
constexpr int kSteps = 25;                // linearisations
constexpr int kStepsOfMisfit = 2;         // of a law that is refuted, after its noise was taken
constexpr int kRounds = 3;                // of the precisions, each
constexpr double kResolved = 2e-4;  // of the largest torque: less noise than the splines' own error
constexpr double kSettled = 0.05;   // standard deviations that a step may still move by
constexpr double kRefuted = 4.0;    // standard deviations of a sum of squares

constexpr int kFamilyOfH = 3;

// The second derivative of a spline is white noise of an intensity that is local: second divided
// differences at the centres of its functions, by the root of their distance.
void add_spline(std::vector<PriorGroup>& groups, Eigen::Index first, const RichSpline& spline,
                int family) {
  const Eigen::Index differences = spline.size() - 2;
  const Eigen::Index parts = std::max<Eigen::Index>(1, differences / kPerGroup);
  for (Eigen::Index k = 0; k < parts; ++k) {
    const Eigen::Index from = k * differences / parts;
    const Eigen::Index to = (k + 1) * differences / parts;
    PriorGroup group{.first = first + from, .count = to - from, .family = family};
    for (Eigen::Index i = from; i < to; ++i) group.rows.push_back(spline.bend(i));
    groups.push_back(std::move(group));
  }
}

std::vector<PriorGroup> groups_of(const RichLaws& laws, const RegressionColumns& at) {
  std::vector<PriorGroup> groups;
  add_spline(groups, at.f, laws.f, 1);
  add_spline(groups, at.g, laws.g_inverse, 2);
  if (at.h >= 0) add_spline(groups, at.h, laws.log_h, kFamilyOfH);
  for (Eigen::Index one : {at.jump, at.inertia, at.delay}) {
    groups.push_back({.first = one, .count = 1});
  }
  groups.push_back({.first = at.motion, .count = at.size - at.motion, .held = true});
  return groups;
}

// Smooth f and g^-1, h nearly straight, a jump that is free: so a kink or a jump is taken as such
// before h bends or g^-1 steepens to stand in for it.
void begin(std::vector<PriorGroup>& groups, double typical, double first_of_h) {
  for (auto& group : groups) {
    if (group.held) continue;
    const double share = group.rows.empty()           ? kFirstOfOne
                         : group.family == kFamilyOfH ? first_of_h
                                                      : kFirstPrecision;
    group.precision = share * typical;
  }
}

struct Normal {
  Eigen::VectorXd at;  // coefficients where it is linearised
  Eigen::MatrixXd information;
  Eigen::VectorXd gradient;
  std::vector<RegressionRows> whitened;  // a record each; in noises, independent
};

// Rows of records without repeats carry the noise of the motion one by one; then the colour goes.
RegressionRows whitened(const FoldedRecord& one, RegressionRows rows) {
  if (one.motion_sigma > 0.0) {
    const Eigen::VectorXd weight =
        (1.0 + (rows.along_motion * (one.motion_sigma / one.noise.sigma)).array().square() +
         (rows.along_speed * (one.speed_sigma / one.noise.sigma)).array().square())
            .rsqrt();
    rows.jacobian = weight.asDiagonal() * rows.jacobian;
    rows.target = rows.target.cwiseProduct(weight);
  }
  const WhiteningFilter filter(one.noise, one.time);
  filter.whiten(rows.jacobian);
  filter.whiten({rows.target.data(), static_cast<std::size_t>(rows.target.size())});
  return rows;
}

// Entries i >= j of J'J by coefficient, row by row of J: most entries of a row in white noise are
// zero.
template <class Each>
void for_each_product(const RegressionRows& rows, const Each& each) {
  struct Entry {
    Eigen::Index at;
    double value;
  };
  std::vector<Entry> filled;
  for (Eigen::Index row = 0; row < rows.jacobian.rows(); ++row) {
    filled.clear();
    for (Eigen::Index column = 0; column < rows.jacobian.cols(); ++column) {
      const double value = rows.jacobian(row, column);
      if (value != 0.0) filled.push_back({rows.coefficient(column), value});
    }
    for (std::size_t i = 0; i < filled.size(); ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        each(filled[i].at, filled[j].at, filled[i].value * filled[j].value);
      }
    }
  }
}

void add_information(const FoldedRecord& one, const RegressionRows& rows, Eigen::MatrixXd& to) {
  if (one.noise.share > 0.0) {
    const Eigen::Index shared = rows.shared, own = rows.jacobian.cols() - rows.shared;
    Eigen::MatrixXd products = Eigen::MatrixXd::Zero(shared + own, shared + own);
    products.selfadjointView<Eigen::Upper>().rankUpdate(rows.jacobian.transpose());
    to.topLeftCorner(shared, shared) += products.topLeftCorner(shared, shared);
    to.block(0, rows.motion, shared, own) += products.topRightCorner(shared, own);
    to.block(rows.motion, rows.motion, own, own) += products.bottomRightCorner(own, own);
  } else {
    for_each_product(rows, [&](Eigen::Index i, Eigen::Index j, double product) {
      to(j, i) += product;  // along a column
    });
  }
}

Normal normal_equations(const TorsionRegression& all, const std::vector<FoldedRecord>& records,
                        const Eigen::VectorXd& c) {
  Normal normal{.at = c,
                .information = Eigen::MatrixXd::Zero(c.size(), c.size()),
                .gradient = Eigen::VectorXd::Zero(c.size()),
                .whitened = {}};
  for (std::size_t r = 0; r < records.size(); ++r) {
    normal.whitened.push_back(whitened(records[r], all.linearise(r, c)));
    const auto& rows = normal.whitened.back();
    add_information(records[r], rows, normal.information);
    const Eigen::VectorXd gradient = rows.jacobian.transpose() * rows.target;
    normal.gradient.head(rows.shared) += gradient.head(rows.shared);
    const Eigen::Index own = gradient.size() - rows.shared;
    normal.gradient.segment(rows.motion, own) += gradient.tail(own);
  }
  normal.information = Eigen::MatrixXd(normal.information.selfadjointView<Eigen::Upper>());
  return normal;
}

double edf_of(const RegressionRows& rows, const Eigen::MatrixXd& covariance) {
  double sum = 0.0;
  for_each_product(rows, [&](Eigen::Index i, Eigen::Index j, double product) {
    sum += (i == j ? 1.0 : 2.0) * product * covariance(j, i);
  });
  return sum;
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

// Which recordings leave more than the noise of their repeats.
std::vector<bool> refuted(TorsionPosterior& model, const std::vector<FoldedRecord>& records,
                          const Normal& normal) {
  std::vector<bool> list;
  double squares = 0.0;
  double freedom = 0.0;
  for (std::size_t r = 0; r < records.size(); ++r) {
    const double left = normal.whitened[r].left(model.law.mean).squaredNorm();
    const double own = static_cast<double>(normal.whitened[r].target.size()) -
                       edf_of(normal.whitened[r], model.law.covariance);
    squares += left;
    freedom += own;
    list.push_back(records[r].repeats && left > own + kRefuted * std::sqrt(2.0 * own));
  }
  model.misfit = std::sqrt(squares / freedom);
  return list;
}

Eigen::RowVectorXd row_of(const TorsionPosterior& model, const RichSpline& spline,
                          Eigen::Index first, double x) {
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(model.law.mean.size());
  Eigen::RowVectorXd own(spline.size());
  spline.value(x, own);
  row.segment(first, own.size()) = own;
  return row;
}

// g^-1 midway between the slowest speeds seen both ways: between these nothing is known, and a
// constant may change hands with the offset.
Eigen::RowVectorXd midway(const TorsionPosterior& model) {
  const auto& spline = model.laws.g_inverse;
  return 0.5 * (row_of(model, spline, model.at.g, model.slowest) +
                row_of(model, spline, model.at.g, -model.slowest));
}

std::array<double, 2> value_of(const TorsionPosterior& model, const RichSpline& spline,
                               Eigen::Index first, double x, const Eigen::RowVectorXd& row) {
  double variance = row.dot(model.law.covariance * row.transpose());
  // Beyond the ends the prior goes on: the second derivative wanders as at the roughest place.
  const double out = spline.beyond(x);
  if (out > 0.0) {
    double precision = std::numeric_limits<double>::infinity();
    for (const auto& group : model.groups) {
      const bool of_it = group.first >= first && group.first < first + spline.size();
      if (of_it) precision = std::min(precision, group.precision);
    }
    variance += out * out * out / 3.0 / precision;
  }
  return {row.dot(model.law.mean), std::sqrt(std::max(0.0, variance))};
}

double slowest_of(const std::vector<FoldedRecord>& records) {
  double slowest = std::numeric_limits<double>::infinity();
  for (const auto& one : records) {
    for (const double v : one.velocity) slowest = std::min(slowest, std::abs(v));
  }
  return slowest;
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
  const bool travels = prepared.front().record.travels;  // then f(0) = 0 is no gauge
  return RichLaws{
      .f = RichSpline(low, high, kMotionIntervals, travels ? 0.0 : kFineMotion * ranges.motion),
      .g_inverse = RichSpline(-fastest, fastest, kSpeedIntervals, kFineSpeed * fastest),
      .log_h = RichSpline(low, high, kModulationIntervals, kFineMotion * ranges.motion)};
}

// Root mean square of what is left, in noises.
double left_in_noises(const Normal& normal, const Eigen::VectorXd& c) {
  double squares = 0.0;
  double rows = 0.0;
  for (const auto& one : normal.whitened) {
    squares += one.left(c).squaredNorm();
    rows += static_cast<double>(one.target.size());
  }
  return std::sqrt(squares / rows);
}

// Linearises in turn at c and takes the law there, until neither moves by what the noise, or more
// where more is left, lets them be known to. Returns the last equations.
Normal settle(TorsionPosterior& model, const TorsionRegression& all,
              const std::vector<FoldedRecord>& records, int steps, Eigen::VectorXd& c) {
  for (int step = 1;; ++step) {
    Normal normal = normal_equations(all, records, c);
    model.law = restricted_likelihood(normal.information, normal.gradient, model.groups, kRounds);
    const Eigen::VectorXd moved = model.law.mean - c;
    c += moved * shortened(model, moved);
    const double left = left_in_noises(normal, model.law.mean);
    if (step >= steps) return normal;
    if (largest_move(model, moved) < kSettled * std::max(1.0, left)) return normal;
  }
}

// The law and what recordings leave, from priors that begin with an h as stiff as this.
struct Attempt {
  TorsionPosterior model;
  Eigen::VectorXd c;
  Normal normal;
  std::vector<bool> refuted;

  bool misses() const { return std::ranges::find(refuted, true) != refuted.end(); }
};

Attempt attempt(TorsionPosterior model, const TorsionRegression& all,
                const std::vector<FoldedRecord>& records, double first_of_h) {
  Eigen::VectorXd c = Eigen::VectorXd::Zero(model.at.size);
  // The first step sees no h, whose columns begin where g^-1 has a slope.
  for (int step = 0; step < 2; ++step) {
    const Normal normal = normal_equations(all, records, c);
    begin(model.groups, normal.information.diagonal().maxCoeff(), first_of_h);
    c = restricted_likelihood(normal.information, normal.gradient, model.groups, kRounds).mean;
  }
  Normal normal = settle(model, all, records, kSteps, c);
  auto misses = refuted(model, records, normal);
  return {std::move(model), std::move(c), std::move(normal), std::move(misses)};
}

// Where repeats refute the law, another start may find a better one; where none does, and where
// there are no repeats, the noise is taken from what is left.
TorsionPosterior concluded(const TorsionPosterior& empty, const TorsionRegression& all,
                           std::vector<FoldedRecord>& records,
                           const std::vector<PreparedRecord>& prepared) {
  Attempt best = attempt(empty, all, records, kFirstOfH);
  if (best.misses() && empty.at.h >= 0) {
    Attempt other = attempt(empty, all, records, kFirstOfFreeH);
    if (other.model.misfit < best.model.misfit) best = std::move(other);
  }
  bool noise_taken = false;
  for (std::size_t r = 0; r < records.size(); ++r) {
    if (best.refuted[r]) best.model.misfits.push_back(prepared[r].record.id);
    if (records[r].repeats && !best.refuted[r]) continue;
    const Eigen::VectorXd raw = all.linearise(r, best.normal.at).left(best.model.law.mean);
    records[r].noise = noise_of(records[r], {raw.begin(), raw.end()});
    noise_taken = true;
  }
  if (noise_taken)
    settle(best.model, all, records, best.model.misfit > kRefutedNoises ? kStepsOfMisfit : kSteps,
           best.c);
  best.model.law.covariance = unconditional_covariance(best.model.law, best.model.groups);
  return std::move(best.model);
}

}  // namespace

std::array<double, 2> TorsionPosterior::f_at(double phi) const {
  Eigen::RowVectorXd row = row_of(*this, laws.f, at.f, phi);
  if (travels) {
    row[at.offset] = 1.0;
    row += midway(*this);
  }
  return value_of(*this, laws.f, at.f, phi, row);
}

std::array<double, 2> TorsionPosterior::g_inverse_at(double speed) const {
  if (speed == 0.0) return {0.0, 0.0};
  Eigen::RowVectorXd row = row_of(*this, laws.g_inverse, at.g, speed) - midway(*this);
  row[at.jump] = speed > 0.0 ? 1.0 : -1.0;
  return value_of(*this, laws.g_inverse, at.g, speed, row);
}

std::array<double, 2> TorsionPosterior::log_h_at(double phi) const {
  return value_of(*this, laws.log_h, at.h, phi, row_of(*this, laws.log_h, at.h, phi));
}

Result<TorsionPosterior> torsion_posterior(const std::vector<PreparedRecord>& prepared,
                                           const TorsionLayout& layout, std::span<const double> p,
                                           bool with_h) {
  std::vector<FoldedRecord> records;
  for (const auto& one : prepared) records.push_back(folded(one));
  const double resolved = kResolved * ranges_of(prepared, false).effort;
  for (auto& one : records) one.noise.sigma = std::max(one.noise.sigma, resolved);
  const auto laws = rich_laws(prepared, records, layout, p);
  if (!laws) return tl::unexpected(laws.error());
  const RegressionColumns at = regression_columns(*laws, records, with_h);
  TorsionPosterior model{.laws = *laws,
                         .at = at,
                         .travels = prepared.front().record.travels,
                         .slowest = slowest_of(records),
                         .groups = groups_of(*laws, at)};
  const TorsionRegression all(model.laws, model.at, records);
  model = concluded(model, all, records, prepared);
  if (!model.law.mean.allFinite() || !model.law.covariance.allFinite()) {
    return failure(ErrorCode::numerics, "the penalised splines of eq. (4) have no finite law",
                   "leave out recordings that hardly move");
  }
  return model;
}

}  // namespace flexspline::estimators
