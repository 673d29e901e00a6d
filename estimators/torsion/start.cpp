#include "torsion/start.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "flexspline/estimators/bounded_least_squares.hpp"
#include "torsion/torque_residuals.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kSlopeFloor = 1e-3;      // of peak effort over range: keeps g defined
constexpr double kMotionMargin = 1.02;    // knots end a little beyond the data
constexpr double kVelocityMargin = 1.15;  // v/h may exceed the fastest v
constexpr double kDelayShare = 0.05;      // of the shortest period
constexpr std::size_t kTravelIntervals = 24;

const std::vector<double> kMotionKnots = {0.25, 0.5, 0.75};
// Even in steps of the eye, and in decades: dry friction turns close to zero speed.
const std::vector<std::vector<double>> kVelocityKnots = {
    {0.08, 0.2, 0.4, 0.7}, {0.004, 0.012, 0.035, 0.08, 0.2, 0.4, 0.7}};

// One choice among the classes of f and g^-1.
struct Candidate {
  std::size_t f_sides;
  std::size_t g_sides;
  const std::vector<double>* velocity_knots;
  const std::vector<double>* motion_knots = &kMotionKnots;
};

std::vector<Candidate> candidates() {
  std::vector<Candidate> list;
  for (const auto& knots : kVelocityKnots) {
    for (std::size_t f_sides : {1, 2}) {
      for (std::size_t g_sides : {1, 2}) list.push_back({f_sides, g_sides, &knots});
    }
  }
  return list;
}

LawSpec motion_law(const Ranges& ranges, bool travels, const Candidate& candidate,
                   std::size_t& size) {
  const double scale = ranges.motion * kMotionMargin;
  if (!travels) {
    size = candidate.f_sides * (candidate.motion_knots->size() + 3);
    return {.law = "monotone_spline",
            .scale = scale,
            .knots = *candidate.motion_knots,
            .coefficients = {},
            .valid_to = ranges.motion};
  }
  size = kTravelIntervals + 3;
  return {.law = "free_spline",
          .scale = scale,
          .knots = {ranges.lowest_motion / scale, ranges.highest_motion / scale},
          .coefficients = {},
          .valid_to = ranges.motion};
}

TorsionLayout layout_for(const std::vector<PreparedRecord>& records, const Ranges& ranges,
                         const Candidate& candidate, FreeTerms free) {
  const bool travels = records.front().record.travels;
  std::size_t f_size = 0;
  LawSpec f = motion_law(ranges, travels, candidate, f_size);
  const std::vector<double>& velocity_knots = *candidate.velocity_knots;
  const LawSpec g{.law = "monotone_spline",
                  .scale = ranges.velocity * kVelocityMargin,
                  .knots = velocity_knots,
                  .coefficients = {},
                  .valid_to = ranges.velocity};
  std::vector<std::string> ids;
  for (const auto& one : records) ids.push_back(one.record.id);
  const double h_scale = ranges.motion * kMotionMargin;
  return TorsionLayout(std::move(f), f_size, g, candidate.g_sides * (velocity_knots.size() + 3),
                       h_scale, std::move(ids), free);
}

void start_nuisances(const TorsionLayout& layout, const std::vector<PreparedRecord>& records,
                     std::span<double> p) {
  const auto zeros = layout.zero_group.of(p);
  for (std::size_t k = 0; k < zeros.size(); ++k) zeros[k] = centre_of(records[k]);
  const auto initial = layout.initial_group.of(p);
  for (std::size_t k = 0; k < initial.size(); ++k) {
    initial[k] = records[k].smooth.motion.position.front();
  }
}

struct LinearFit {
  std::vector<double> p;
  double criterion = kInfinity;
};

std::vector<Eigen::Index> columns_of(std::initializer_list<const Group*> groups) {
  std::vector<Eigen::Index> columns;
  for (const Group* group : groups) {
    for (std::size_t k = 0; k < group->count; ++k) {
      columns.push_back(static_cast<Eigen::Index>(group->first + k));
    }
  }
  return columns;
}

// The residual is linear in f, g^-1 and offset where h = 1. `beside` holds directions of what is
// not linear or not yet free, so that the choice of a class does not have to stand in for them.
Result<LinearFit> linear_fit(const TorsionLayout& layout,
                             const std::vector<PreparedRecord>& records,
                             const Eigen::MatrixXd& beside) {
  LinearFit fit{.p = std::vector<double>(layout.size(), 0.0)};
  start_nuisances(layout, records, fit.p);
  const auto at = linearise(TorqueResiduals(layout, records), fit.p);
  if (!at) return tl::unexpected(at.error());

  const auto linear = columns_of({&layout.f_group, &layout.g_group, &layout.offset_group});
  const auto bounds = bounded_parameters(layout, records, fit.p);
  const auto own = static_cast<Eigen::Index>(linear.size());
  Eigen::VectorXd lower = Eigen::VectorXd::Constant(own + beside.cols(), -kInfinity);
  for (std::size_t k = 0; k < layout.f_group.count + layout.g_group.count; ++k) {
    lower[static_cast<Eigen::Index>(k)] = bounds[k].lower;
  }
  Eigen::MatrixXd j(at->jacobian.rows(), own + beside.cols());
  j.leftCols(own) = at->jacobian(Eigen::all, linear);
  j.rightCols(beside.cols()) = beside;
  const Eigen::VectorXd x =
      bounded_least_squares(j.transpose() * j, -(j.transpose() * at->residual), lower);
  for (Eigen::Index k = 0; k < own; ++k) {
    fit.p[static_cast<std::size_t>(linear[static_cast<std::size_t>(k)])] += x[k];
  }
  const double n = static_cast<double>(at->residual.size());
  const double rss = (at->residual + j * x).squaredNorm();
  fit.criterion = n * std::log(rss / n) + static_cast<double>(linear.size()) * std::log(n);
  return fit;
}

Eigen::Index rows_of(const std::vector<PreparedRecord>& records) {
  std::size_t rows = 0;
  for (const auto& one : records) rows += one.rows.size();
  return static_cast<Eigen::Index>(rows);
}

// Directions of ln h, inertia, delay and zeros at a start, as far as they will be free.
Result<Eigen::MatrixXd> directions_beside(const std::vector<PreparedRecord>& records,
                                          const LinearStart& at, FreeTerms free) {
  const LinearStart probe = with_terms(at, free);
  const auto& layout = probe.layout;
  const auto linear = linearise(TorqueResiduals(layout, records), probe.p);
  if (!linear) return tl::unexpected(linear.error());
  Eigen::MatrixXd beside =
      linear->jacobian(Eigen::all, columns_of({&layout.h_group, &layout.inertia_group,
                                               &layout.delay_group, &layout.zero_group}));
  beside.colwise().normalize();
  return beside;
}

}  // namespace

std::vector<BoundedParameter> bounded_parameters(const TorsionLayout& layout,
                                                 const std::vector<PreparedRecord>& records,
                                                 std::span<const double> p) {
  const Ranges ranges = ranges_of(records, layout.zero_group.present());
  const bool travels = records.front().record.travels;
  std::vector<BoundedParameter> result(layout.size());
  auto fill = [&](const Group& group, double lower, double upper, double scale) {
    for (std::size_t k = group.first; k < group.first + group.count; ++k) {
      result[k] = {.start = p[k], .lower = lower, .upper = upper, .scale = scale};
    }
  };
  const double floor = kSlopeFloor * ranges.effort;
  const double delay = kDelayShare * ranges.shortest_period;
  const double inertia = ranges.effort / ranges.acceleration;
  fill(layout.f_group, travels ? -kInfinity : floor, kInfinity, ranges.effort);
  fill(layout.g_group, floor, kInfinity, ranges.effort);
  fill(layout.h_group, -3.0, 3.0, 1.0);
  fill(layout.inertia_group, -inertia, inertia, 0.1 * inertia);
  fill(layout.delay_group, -delay, delay, delay);
  fill(layout.offset_group, -ranges.effort, ranges.effort, 0.1 * ranges.effort);
  fill(layout.zero_group, -kInfinity, kInfinity, ranges.motion);
  fill(layout.initial_group, -kInfinity, kInfinity, ranges.motion);
  return result;
}

Result<LinearStart> richest_start(const std::vector<PreparedRecord>& records, FreeTerms base) {
  const Ranges ranges = ranges_of(records, base.zeros);
  const bool travels = records.front().record.travels;
  TorsionLayout layout =
      layout_for(records, ranges, {travels ? std::size_t{1} : 2, 2, &kVelocityKnots.front()}, base);
  auto fit = linear_fit(layout, records, Eigen::MatrixXd(rows_of(records), 0));
  if (!fit) return tl::unexpected(fit.error());
  return LinearStart{std::move(layout), std::move(fit->p)};
}

Result<LinearStart> chosen_start(const std::vector<PreparedRecord>& records, FreeTerms base,
                                 const LinearStart& richest, FreeTerms beside_terms) {
  const Ranges ranges = ranges_of(records, base.zeros);
  const auto beside = directions_beside(records, richest, beside_terms);
  if (!beside) return tl::unexpected(beside.error());
  std::optional<LinearStart> best;
  double criterion = kInfinity;
  for (const auto& candidate : candidates()) {
    if (records.front().record.travels && candidate.f_sides == 2) continue;
    TorsionLayout layout = layout_for(records, ranges, candidate, base);
    auto fit = linear_fit(layout, records, *beside);
    if (!fit) return tl::unexpected(fit.error());
    if (!best || fit->criterion < criterion) {
      criterion = fit->criterion;
      best = LinearStart{std::move(layout), std::move(fit->p)};
    }
  }
  return std::move(*best);
}

Result<LinearStart> even_start(const std::vector<PreparedRecord>& records, FreeTerms base,
                               std::size_t intervals) {
  std::vector<double> knots;
  for (std::size_t k = 1; k < intervals; ++k) {
    knots.push_back(static_cast<double>(k) / static_cast<double>(intervals));
  }
  const std::size_t f_sides = records.front().record.travels ? 1 : 2;
  TorsionLayout layout =
      layout_for(records, ranges_of(records, base.zeros), {f_sides, 2, &knots, &knots}, base);
  auto fit = linear_fit(layout, records, Eigen::MatrixXd(rows_of(records), 0));
  if (!fit) return tl::unexpected(fit.error());
  return LinearStart{std::move(layout), std::move(fit->p)};
}

LinearStart with_terms(const LinearStart& start, FreeTerms free) {
  const auto& old = start.layout;
  const LawSpec f = old.f(start.p);
  const LawSpec g = old.g_inverse(start.p);
  TorsionLayout layout(f, old.f_group.count, g, old.g_group.count, old.h(start.p).scale,
                       old.records(), free);
  auto p = layout.carry_over(old, start.p);
  return {std::move(layout), std::move(p)};
}

}  // namespace flexspline::estimators
