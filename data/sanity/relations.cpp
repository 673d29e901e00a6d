#include "sanity/relations.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "sanity/evidence.hpp"

namespace flexspline::data {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

/// Dry friction that comes with the motion over a width after each turn: dz = (dx - z |dx|) /
/// width.
ArrayXd dry_friction(const ArrayXd& x, double width) {
  ArrayXd z = ArrayXd::Zero(x.size());
  for (Index i = 1; i < x.size(); ++i) {
    const double by = (x[i] - x[i - 1]) / width;
    const double end = by < 0.0 ? -1.0 : 1.0;
    z[i] = end + (z[i - 1] - end) * std::exp(-std::abs(by));
  }
  return z;
}

double rms(const ArrayXd& x) { return std::sqrt(x.square().mean()); }

RelationRows rows_of(const Observed& o, const ArrayXd& motion, const ArrayXd& rate,
                     const ArrayXd& response) {
  const double wide = rms(motion - motion.mean());
  return {o.recording, o.time, o.usable, response, {}, wide > 0.0 ? rms(rate) / wide : 0.0};
}

RelationRows spring_rows(const Observed& o) {
  RelationRows rows = rows_of(o, o.motion, o.rate, o.effort);
  const ArrayXd x = o.motion - o.motion.mean();
  const double range = range_of(o.motion);
  rows.columns = {x, x.square(), x.cube(), smooth_sign(o.rate)};
  for (const double width : {0.05, 0.2}) rows.columns.push_back(dry_friction(x, width * range));
  rows.columns.push_back(o.rate);
  return rows;
}

/// Of what drives a load that is held by nothing else: inertia, gravity, friction.
RelationRows load_rows(const Observed& o, const ArrayXd& effort) {
  RelationRows rows = rows_of(o, o.load_angle, o.load_speed, effort);
  rows.columns = {o.load_angle.sin(), o.load_angle.cos(), o.load_acceleration,
                  smooth_sign(o.load_speed), o.load_speed};
  return rows;
}

void add_spring(const ObservedSet& all, std::vector<Relation>& list) {
  Relation relation{"the torque", "the motion", 3, false, {}};
  for (const Observed& o : all.recordings) {
    if (o.motion.size() == 0 || o.effort.size() == 0 || !(o.usable.sum() > 0.0)) continue;
    relation.rows.push_back(spring_rows(o));
  }
  if (!relation.rows.empty()) list.push_back(std::move(relation));
}

void add_load(const ObservedSet& all, std::vector<Relation>& list) {
  const bool servo = all.set.rig == Rig::servo;
  Relation relation{servo ? "the drive" : "the torque", "the load's angle", 3, true, {}};
  for (const Observed& o : all.recordings) {
    const ArrayXd& effort = servo ? o.drive : o.effort;
    if (o.load_angle.size() == 0 || effort.size() == 0 || !(o.usable.sum() > 0.0)) continue;
    relation.rows.push_back(load_rows(o, effort));
  }
  if (!relation.rows.empty()) list.push_back(std::move(relation));
}

}  // namespace

double Relation::fastest() const {
  double most = 0.0;
  for (const RelationRows& one : rows) most = std::max(most, one.rate);
  return most;
}

std::vector<Relation> relations_of(const ObservedSet& all) {
  std::vector<Relation> list;
  if (all.travels()) return list;
  if (all.set.rig == Rig::free || all.set.rig == Rig::servo) add_load(all, list);
  if (all.set.rig != Rig::servo) add_spring(all, list);
  return list;
}

namespace {

/// Normal equations of centred rows, the response as the last column.
Eigen::MatrixXd moments_of(const Relation& relation,
                           const std::vector<std::vector<ArrayXd>>& columns) {
  const auto count = static_cast<Index>(columns[0].size());
  Eigen::MatrixXd moments = Eigen::MatrixXd::Zero(count + 1, count + 1);
  for (std::size_t r = 0; r < relation.rows.size(); ++r) {
    const RelationRows& rows = relation.rows[r];
    const double weight = std::max(rows.usable.sum(), 1.0);
    Eigen::MatrixXd a(rows.time.size(), count + 1);
    for (Index k = 0; k <= count; ++k) {
      const ArrayXd& column = k < count ? columns[r][static_cast<std::size_t>(k)] : rows.response;
      a.col(k) = (column - (column * rows.usable).sum() / weight) * rows.usable;
    }
    moments.noalias() += a.transpose() * a;
  }
  return moments;
}

}  // namespace

RelationFit fit_relation(const Relation& relation,
                         const std::vector<std::vector<ArrayXd>>& columns) {
  const Eigen::MatrixXd moments = moments_of(relation, columns);
  const Index count = moments.rows() - 1;
  const double total = moments(count, count);
  std::vector<Index> kept;
  for (Index k = 0; k < count; ++k) {
    if (moments(k, k) > 0.0) kept.push_back(k);
  }
  while (!kept.empty()) {
    const Eigen::VectorXd scale = moments(kept, kept).diagonal().cwiseSqrt().cwiseInverse();
    Eigen::MatrixXd normal = scale.asDiagonal() * moments(kept, kept) * scale.asDiagonal();
    normal.diagonal().array() += 1e-10;
    const Eigen::VectorXd right = scale.asDiagonal() * moments(kept, count);
    const Eigen::VectorXd solution = normal.ldlt().solve(right);
    Index worst = -1;
    for (Index k = 0; k < solution.size(); ++k) {
      const bool passive =
          kept[static_cast<std::size_t>(k)] >= static_cast<Index>(relation.passive);
      if (passive && solution[k] < 0.0 && (worst < 0 || solution[k] < solution[worst])) worst = k;
    }
    if (worst < 0) return {std::max(total - solution.dot(right), 0.0), total};
    kept.erase(kept.begin() + worst);
  }
  return {total, total};
}

}  // namespace flexspline::data
