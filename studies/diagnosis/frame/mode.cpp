#include "diagnosis/frame/mode.hpp"

#include <cmath>

namespace flexspline::studies {

using Eigen::ArrayXd;
using Eigen::Index;

ModeAnswer answer_of(const Frame& frame, const ArrayXd& u, const Mode& mode) {
  ModeAnswer answer{ArrayXd::Zero(u.size()), ArrayXd::Zero(u.size())};
  const auto [w, z] = mode;
  const double turn = w * std::sqrt(1.0 - z * z);
  for (const Segment& s : frame.segments) {
    if (s.count < 2) continue;
    const Index last = s.first + s.count - 1;
    const double step = (frame.time[last] - frame.time[s.first]) / static_cast<double>(s.count - 1);
    const double decay = std::exp(-z * w * step);
    const double c = decay * std::cos(turn * step), n = decay * std::sin(turn * step);
    double q = u[s.first], rate = 0.0;
    for (Index r = s.first; r < last; ++r) {
      const double slope = (u[r + 1] - u[r]) / step;
      const double ramp = u[r] - 2.0 * z * slope / w;  // where q would be if it had settled
      const double x = q - ramp, v = rate - slope;
      const double y = (v + z * w * x) / turn;
      q = ramp + slope * step + c * x + n * y;
      rate = slope + c * v - n * (turn * x + z * w * y);
      answer.place[r + 1] = q - u[r + 1];
      answer.speed[r + 1] = rate / w;
    }
  }
  return answer;
}

double slowest_mode(const Frame& frame) { return 1.0 / frame.longest_lag(); }

double fastest_mode(const Frame& frame) {
  constexpr double kRowsPerPeriod = 5.0;
  return kTurn / (kRowsPerPeriod * frame.interval);
}

}  // namespace flexspline::studies
