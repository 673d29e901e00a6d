#include "posterior/torsion_regression.hpp"

#include <algorithm>
#include <cmath>

namespace flexspline::estimators {
namespace {

Eigen::Index errors_of(const FoldedRecord& record) {
  Eigen::Index count = 0;
  for (const auto& error : record.motion) count += error.angular_frequency > 0.0 ? 2 : 1;
  return count;
}

}  // namespace

RegressionColumns regression_columns(const RichLaws& laws, const std::vector<FoldedRecord>& records,
                                     bool with_h) {
  RegressionColumns at;
  at.g = at.f + laws.f.size();
  at.jump = at.g + laws.g_inverse.size();
  Eigen::Index next = at.jump + 1;
  if (with_h) {
    at.h = next;
    next += laws.log_h.size();
  }
  at.inertia = next++;
  at.delay = next++;
  at.motion = next;
  for (const auto& one : records) next += errors_of(one);
  at.size = next;
  return at;
}

// What eq. (4) is at one row.
struct TorsionRegression::Point {
  RichSpline::Local g;
  double log_h = 0.0;
  double speed = 0.0;    // phi'/h
  double damping = 0.0;  // slope of g^-1 there
  double along_motion = 0.0;
  double along_speed = 0.0;
};

TorsionRegression::TorsionRegression(const RichLaws& laws, const RegressionColumns& at,
                                     const std::vector<FoldedRecord>& records)
    : laws_(laws), at_(at), records_(records) {
  double fastest = 0.0;
  Eigen::Index next = at.motion;
  for (const auto& one : records) {
    motion_.push_back(next);
    next += errors_of(one);
    auto& places = places_.emplace_back();
    for (std::size_t i = 0; i < one.time.size(); ++i) {
      places.push_back({laws_.f.at(one.position[i]), laws_.log_h.at(one.position[i])});
      fastest = std::max(fastest, std::abs(one.velocity[i]));
      largest_acceleration_ = std::max(largest_acceleration_, std::abs(one.acceleration[i]));
    }
  }
  time_scale_ = fastest / largest_acceleration_;
}

TorsionRegression::Point TorsionRegression::point(const FoldedRecord& one, std::size_t k,
                                                  const Place& place,
                                                  const Eigen::VectorXd& c) const {
  Point p;
  double bend = 0.0;
  if (at_.h >= 0) {
    const auto own = c.segment(at_.h, laws_.log_h.size());
    p.log_h = laws_.log_h.value(place.h, own);
    bend = RichSpline::slope(place.h, own);
  }
  const double modulation = std::exp(-p.log_h);
  p.speed = one.velocity[k] * modulation;
  p.g = laws_.g_inverse.at(p.speed);
  p.damping = RichSpline::slope(p.g, c.segment(at_.g, laws_.g_inverse.size()));
  p.along_motion =
      RichSpline::slope(place.f, c.segment(at_.f, laws_.f.size())) - p.damping * p.speed * bend;
  p.along_speed = p.damping * modulation;
  return p;
}

void TorsionRegression::fill_motion(const FoldedRecord& one, std::size_t k, const Point& at,
                                    Eigen::Ref<Eigen::RowVectorXd> row) const {
  Eigen::Index next = 0;
  for (const auto& error : one.motion) {
    const double angle = error.angular_frequency * (one.time[k] - one.phase_zero);
    const double faster = at.along_speed * error.angular_frequency;
    row[next++] = error.sigma * (at.along_motion * std::cos(angle) - faster * std::sin(angle));
    if (!(error.angular_frequency > 0.0)) continue;
    row[next++] = error.sigma * (at.along_motion * std::sin(angle) + faster * std::cos(angle));
  }
}

Eigen::VectorXd RegressionRows::own(const Eigen::VectorXd& c) const {
  Eigen::VectorXd coefficients(jacobian.cols());
  coefficients << c.head(shared), c.segment(motion, jacobian.cols() - shared);
  return coefficients;
}

RegressionRows TorsionRegression::linearise(std::size_t r, const Eigen::VectorXd& c) const {
  const FoldedRecord& one = records_[r];
  const auto n = static_cast<Eigen::Index>(one.time.size());
  const Eigen::Index errors = errors_of(one);
  RegressionRows rows{.jacobian = decltype(RegressionRows::jacobian)::Zero(n, at_.motion + errors),
                      .target = Eigen::VectorXd(n),
                      .along_motion = Eigen::VectorXd(n),
                      .along_speed = Eigen::VectorXd(n),
                      .shared = at_.motion,
                      .motion = motion_[r]};
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Place& place = places_[r][k];
    const Point p = point(one, k, place, c);
    auto row = rows.jacobian.row(i);
    row[at_.offset] = 1.0;
    laws_.f.add_value(place.f, 1.0, row.segment(at_.f, laws_.f.size()));
    laws_.g_inverse.add_value(p.g, 1.0, row.segment(at_.g, laws_.g_inverse.size()));
    row[at_.jump] = p.speed > 0.0 ? 1.0 : -1.0;
    if (at_.h >= 0) {
      laws_.log_h.add_value(place.h, -p.damping * p.speed, row.segment(at_.h, laws_.log_h.size()));
    }
    row[at_.inertia] = one.acceleration[k] / largest_acceleration_;
    row[at_.delay] =
        -time_scale_ * (p.along_motion * one.velocity[k] + p.along_speed * one.acceleration[k]);
    fill_motion(one, k, p, row.segment(at_.motion, errors));
    rows.target[i] = one.torque[k] - p.damping * p.speed * p.log_h;
    rows.along_motion[i] = p.along_motion;
    rows.along_speed[i] = p.along_speed;
  }
  return rows;
}

}  // namespace flexspline::estimators
