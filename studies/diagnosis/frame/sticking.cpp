#include "diagnosis/frame/sticking.hpp"

#include <algorithm>
#include <iterator>
#include <limits>

#include <fmt/format.h>

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr double kSlowest = 0.02;  // of the largest speed

std::vector<double> reversals_in(const Frame& f, const Segment& s) {
  std::vector<double> instants;
  for (Index r = s.first + 1; r < s.first + s.count; ++r) {
    if (f.motor_speed[r] * f.motor_speed[r - 1] > 0.0) continue;
    instants.push_back(0.5 * (f.time[r] + f.time[r - 1]));
  }
  return instants;
}

// Of instants in order; none: infinitely far.
double distance_to_nearest(const std::vector<double>& instants, double time) {
  const auto next = std::ranges::lower_bound(instants, time);
  double distance = std::numeric_limits<double>::infinity();
  if (next != instants.end()) distance = *next - time;
  if (next != instants.begin()) distance = std::min(distance, time - *std::prev(next));
  return distance;
}

}  // namespace

ArrayXd motor_slides(const Frame& f) {
  ArrayXd slides = (f.motor_speed.abs() > kSlowest * f.speed_range).cast<double>();
  for (const Segment& s : f.segments) {
    const auto reversals = reversals_in(f, s);
    for (Index r = s.first; r < s.first + s.count; ++r) {
      if (distance_to_nearest(reversals, f.time[r]) < 1.0 / f.motor_bandwidth[r]) slides[r] = 0.0;
    }
  }
  return slides;
}

std::string sticking_in_words(const Frame& frame) {
  const double share = 1.0 - frame.rows_of(Equation::motor).sum() / frame.usable.sum();
  return fmt::format(
      "the motor equation is not judged where the motor may stick, slower than {:.2g} % of its "
      "largest speed, slower than its encoder tells or about to turn ({:.0f} % of the rows): there "
      "it takes any torque up to its breakaway",
      100.0 * kSlowest, 100.0 * share);
}

}  // namespace flexspline::studies
