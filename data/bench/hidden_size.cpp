#include "bench/hidden_size.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bench/hidden_differences.hpp"

namespace flexspline::data {
namespace {

constexpr double kSizeTolerance = 0.02;
constexpr int kMostTrials = 30;

std::vector<double> torsion_residual(const HiddenGear& gear, const HiddenSignals& s) {
  std::vector<double> torsion = s.motor_angle;
  for (std::size_t k = 0; k < s.size(); ++k) {
    torsion[k] = torsion[k] / gear.gear_ratio - s.load_angle[k];
  }
  const std::vector<double> rate = slopes(torsion, s.step);
  std::vector<double> left(s.size());
  for (std::size_t k = 0; k < s.size(); ++k) {
    left[k] = s.torque[k] - gear.stiffness(torsion[k]) -
              gear.damping(rate[k] / gear.modulation(torsion[k]));
  }
  return left;
}

std::vector<double> load_residual(const HiddenGear& gear, const HiddenSignals& s) {
  const std::vector<double> speed = slopes(s.load_angle, s.step);
  const std::vector<double> bend = bends(s.load_angle, s.step);
  std::vector<double> left(s.size());
  for (std::size_t k = 0; k < s.size(); ++k) {
    left[k] = s.torque[k] - gear.load_inertia * bend[k] - gear.load_drag * speed[k];
  }
  return left;
}

std::vector<double> motor_residual(const HiddenGear& gear, const HiddenSignals& s) {
  const std::vector<double> speed = slopes(s.motor_angle, s.step);
  const std::vector<double> bend = bends(s.motor_angle, s.step);
  std::vector<double> left(s.size());
  for (std::size_t k = 0; k < s.size(); ++k) {
    left[k] = s.motor_torque[k] - gear.motor_inertia * bend[k] - gear.motor_drag * speed[k] -
              gear.motor_coulomb * soft_sign(speed[k], gear.motor_coulomb_speed) -
              s.torque[k] / gear.gear_ratio;
  }
  return left;
}

std::vector<double> drive_residual(const HiddenSignals& s, const HiddenSignals& null_run) {
  std::vector<double> left(s.size());
  for (std::size_t k = 0; k < s.size(); ++k) left[k] = s.motor_torque[k] - null_run.motor_torque[k];
  return left;
}

/// Finds the amount: proportion first, halving the bracket where proportion leaves it.
class AmountSearch {
 public:
  AmountSearch(double size, double first) : size_(size), amount_(first) {}

  double amount() const { return amount_; }
  bool found(double share) const { return std::abs(share / size_ - 1.0) <= kSizeTolerance; }

  void learn(double share) {
    (share < size_ ? low_ : high_) = amount_;
    const double proportion = amount_ * std::clamp(size_ / share, 0.1, 10.0);
    const bool inside = proportion > low_ && (high_ == 0.0 || proportion < high_);
    const bool late = ++trials_ > 6 && low_ > 0.0 && high_ > 0.0;
    if (inside && !late) {
      amount_ = proportion;
    } else {
      amount_ = low_ > 0.0 && high_ > 0.0 ? std::sqrt(low_ * high_) : 0.1 * amount_;
    }
  }

 private:
  double size_;
  double amount_;
  double low_ = 0.0;
  double high_ = 0.0;
  int trials_ = 0;
};

}  // namespace

std::vector<double> equation_residual(const HiddenGear& gear, HiddenEquation equation,
                                      const HiddenSignals& signals, const HiddenSignals& null_run) {
  switch (equation) {
    case HiddenEquation::torsion:
      return torsion_residual(gear, signals);
    case HiddenEquation::load:
      return load_residual(gear, signals);
    case HiddenEquation::motor:
      return motor_residual(gear, signals);
    case HiddenEquation::drive:
      break;
  }
  return drive_residual(signals, null_run);
}

Result<HiddenSizing> size_effect(const HiddenBench& bench,
                                 const std::vector<HiddenSession>& sessions,
                                 const std::vector<HiddenSignals>& null_runs,
                                 const HiddenScale& scale, const HiddenRow& row, double size) {
  const HiddenEquation equation = hidden_equation(row.site, bench.rig);
  const bool at_output = equation == HiddenEquation::torsion || equation == HiddenEquation::load;
  const double peak = at_output ? scale.torque : scale.motor_torque;
  AmountSearch search(size, size);
  double share = 0.0;
  for (int trial = 0; trial < kMostTrials; ++trial) {
    double largest = 0.0;
    for (std::size_t k = 0; k < sessions.size(); ++k) {
      const HiddenSignals run = run_session(bench, sessions[k], scale, {{&row, search.amount()}});
      const HiddenGear gear = gear_of(bench, sessions[k]);
      for (const double left : equation_residual(gear, equation, run, null_runs[k])) {
        largest = std::max(largest, std::abs(left));
      }
    }
    share = largest / peak;
    if (!std::isfinite(share) || share == 0.0) break;
    if (search.found(share)) return HiddenSizing{{&row, search.amount()}, share};
    search.learn(share);
  }
  return failure(ErrorCode::usage,
                 fmt::format("effect \"{}\" does not come to size_fraction = {} of peak torque on "
                             "this bench; it came to {:.3g}",
                             row.id, size, share),
                 "ask for another size, or for a design that moves what the effect depends on");
}

}  // namespace flexspline::data
