#include "sanity/lag.hpp"

#include <algorithm>
#include <cmath>

#include <boost/math/tools/minima.hpp>

namespace flexspline::data {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr double kLeastPhase = 0.06;  // rad of the fastest motion, where a search begins
constexpr double kMostPhase = 4.0;    // and ends
constexpr int kSteps = 16;
constexpr int kBits = 16;
constexpr double kHolds = 0.5;  // of the response's variance, with the lag

/// Values at other instants, straight between samples; at the ends those of the ends.
ArrayXd at_instants(const ArrayXd& time, const ArrayXd& values, const ArrayXd& instants) {
  ArrayXd taken(values.size());
  Index k = 0;
  for (Index i = 0; i < instants.size(); ++i) {
    while (k > 0 && time[k] > instants[i]) --k;
    while (k + 2 < time.size() && time[k + 1] < instants[i]) ++k;
    const double share = (instants[i] - time[k]) / (time[k + 1] - time[k]);
    taken[i] = values[k] + std::clamp(share, 0.0, 1.0) * (values[k + 1] - values[k]);
  }
  return taken;
}

/// y' = (x - y) / T, x straight between samples, from rest at the first, of all columns.
std::vector<ArrayXd> behind_low_pass(const RelationRows& rows, double time_constant) {
  std::vector<ArrayXd> y = rows.columns;
  for (Index i = 1; i < rows.time.size(); ++i) {
    const double steps = (rows.time[i] - rows.time[i - 1]) / time_constant;
    const double keeps = std::exp(-steps);
    const double slope = steps > 1e-6 ? (1.0 - keeps) / steps : 1.0 - 0.5 * steps;
    for (std::size_t k = 0; k < y.size(); ++k) {
      const ArrayXd& x = rows.columns[k];
      y[k][i] = keeps * y[k][i - 1] + (1.0 - slope) * x[i] + (slope - keeps) * x[i - 1];
    }
  }
  return y;
}

std::vector<ArrayXd> lagging(const RelationRows& rows, LagKind kind, double amount) {
  if (amount == 0.0) return rows.columns;
  if (kind == LagKind::low_pass) return behind_low_pass(rows, amount);
  const double start = rows.time[0];
  const ArrayXd instants = kind == LagKind::delay
                               ? ArrayXd(rows.time - amount)
                               : ArrayXd(start + (1.0 + amount) * (rows.time - start));
  std::vector<ArrayXd> columns;
  for (const ArrayXd& x : rows.columns) columns.push_back(at_instants(rows.time, x, instants));
  return columns;
}

RelationFit fit_with(const Relation& relation, LagKind kind, double amount) {
  std::vector<std::vector<ArrayXd>> columns;
  for (const RelationRows& rows : relation.rows) columns.push_back(lagging(rows, kind, amount));
  return fit_relation(relation, columns);
}

/// The steps of a search, in rad.
double phase_at(int step) {
  return kLeastPhase * std::pow(kMostPhase / kLeastPhase, static_cast<double>(step) / (kSteps - 1));
}

/// What a search has found so far: by no lag at all where side is 0.
struct Tried {
  double side = 0.0;
  int step = 0;
  double left = 0.0;
};

/// rad of the fastest motion for an amount of 1.
double phase_of_one(const Relation& relation, LagKind kind) {
  if (kind != LagKind::drift) return relation.fastest();
  double most = 0.0;
  for (const RelationRows& rows : relation.rows) {
    most = std::max(most, rows.rate * (rows.time[rows.time.size() - 1] - rows.time[0]));
  }
  return most;
}

}  // namespace

std::optional<Lag> best_lag(const Relation& relation, LagKind kind) {
  const double phase = phase_of_one(relation, kind);
  if (!(phase > 0.0)) return std::nullopt;
  const auto left = [&](double amount) { return fit_with(relation, kind, amount).left; };
  const RelationFit without = fit_with(relation, kind, 0.0);
  Tried best{0.0, 0, without.left};
  const bool both = kind == LagKind::drift || (kind == LagKind::delay && relation.early_too);
  for (const double side : {1.0, -1.0}) {
    for (int k = 0; k < kSteps && (side > 0.0 || both); ++k) {
      const double now = left(side * phase_at(k) / phase);
      if (now < best.left) best = {side, k, now};
    }
  }
  if (best.side == 0.0 || best.step == kSteps - 1) return std::nullopt;
  const double near = best.side * phase_at(best.step - 1) / phase;
  const double far = best.side * phase_at(best.step + 1) / phase;
  const auto [amount, value] =
      boost::math::tools::brent_find_minima(left, std::min(near, far), std::max(near, far), kBits);
  if (value > (1.0 - kHolds) * without.total) return std::nullopt;
  return Lag{kind, amount, std::abs(amount) * phase, value / without.left};
}

}  // namespace flexspline::data
