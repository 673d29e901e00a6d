#include "decimated.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace flexspline::reports {
namespace {

using Series = std::vector<double>;

constexpr double kSeen = 1e-3;  // of the extent: less than a pixel's width

double extent_of(const Series& values) {
  double lower = std::numeric_limits<double>::infinity();
  double upper = -lower;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    lower = std::min(lower, value);
    upper = std::max(upper, value);
  }
  return upper > lower ? upper - lower : 1.0;
}

struct Point {
  double x = 0.0;
  double y = 0.0;
};

/// Distance of a point from the segment from a to b.
double distance(const Point& a, const Point& b, const Point& p) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double square = dx * dx + dy * dy;
  const double along = square > 0.0 ? ((p.x - a.x) * dx + (p.y - a.y) * dy) / square : 0.0;
  const double share = std::clamp(along, 0.0, 1.0);
  return std::hypot(p.x - a.x - share * dx, p.y - a.y - share * dy);
}

class Curve {
 public:
  Curve(const Series& x, const Series& y) {
    const double width = extent_of(x);
    const double height = extent_of(y);
    for (std::size_t i = 0; i < x.size(); ++i) points_.push_back({x[i] / width, y[i] / height});
  }

  std::vector<bool> kept(double tolerance) const {
    std::vector<bool> keep(points_.size(), false);
    keep.front() = keep.back() = true;
    std::vector<std::pair<std::size_t, std::size_t>> open = stretches();
    for (const auto& [from, to] : open) {
      keep[from] = keep[to] = true;
      if (to + 1 < keep.size()) keep[to + 1] = true;
    }
    while (!open.empty()) {
      const auto [from, to] = open.back();
      open.pop_back();
      const auto [off, at] = farthest(from, to);
      if (!(off > tolerance)) continue;
      keep[at] = true;
      open.emplace_back(from, at);
      open.emplace_back(at, to);
    }
    return keep;
  }

 private:
  /// First and last points of what is drawn in one line: between two of them something is no
  /// number.
  std::vector<std::pair<std::size_t, std::size_t>> stretches() const {
    std::vector<std::pair<std::size_t, std::size_t>> list;
    bool goes_on = false;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const bool drawn = std::isfinite(points_[i].x) && std::isfinite(points_[i].y);
      if (drawn && goes_on) list.back().second = i;
      if (drawn && !goes_on) list.emplace_back(i, i);
      goes_on = drawn;
    }
    return list;
  }

  std::pair<double, std::size_t> farthest(std::size_t from, std::size_t to) const {
    std::pair<double, std::size_t> most = {0.0, from};
    for (std::size_t i = from + 1; i < to; ++i) {
      const double off = distance(points_[from], points_[to], points_[i]);
      if (off > most.first) most = {off, i};
    }
    return most;
  }

  std::vector<Point> points_;
};

}  // namespace

std::vector<bool> seen_points(std::span<const DrawnCurve> curves, std::size_t most) {
  const std::size_t size = curves.front().x->size();
  std::vector<Curve> drawn;
  for (const DrawnCurve& one : curves) {
    if (one.x->size() == size && one.y->size() == size) drawn.emplace_back(*one.x, *one.y);
  }
  std::vector<bool> keep(size, true);
  if (size < 3) return keep;
  for (double tolerance = kSeen; tolerance < 1.0; tolerance *= 2.0) {
    std::fill(keep.begin(), keep.end(), false);
    for (const Curve& curve : drawn) {
      const std::vector<bool> own = curve.kept(tolerance);
      for (std::size_t i = 0; i < size; ++i) keep[i] = keep[i] || own[i];
    }
    if (static_cast<std::size_t>(std::ranges::count(keep, true)) <= most) break;
  }
  return keep;
}

void keep_points(Series& values, const std::vector<bool>& keep) {
  if (values.size() != keep.size()) return;
  std::size_t next = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (keep[i]) values[next++] = values[i];
  }
  values.resize(next);
}

void decimate(Series& x, Series& y, std::size_t most) {
  if (x.size() < 3 || x.size() != y.size()) return;
  const DrawnCurve curve{&x, &y};
  const auto keep = seen_points({&curve, 1}, most);
  keep_points(x, keep);
  keep_points(y, keep);
}

}  // namespace flexspline::reports
