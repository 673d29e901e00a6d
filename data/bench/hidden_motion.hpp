#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "bench/hidden_jet.hpp"
#include "flexspline/data/hidden_bench.hpp"

namespace flexspline::data {

/// The motion of the held shaft: starts at rest at 0 with three continuous derivatives.
class HeldMotion {
 public:
  /// The phases of a multisine are drawn by (seed, id).
  HeldMotion(const HiddenExcitation& excitation, std::uint64_t seed, std::string_view id);

  Jet at(double t) const;
  double duration() const { return excitation_.cycles / excitation_.frequency_hz; }

 private:
  struct Change {
    double time;
    double by;
  };

  void plan_multisine(std::uint64_t seed, std::string_view id);
  void plan_levels();
  void plan_speeds(const std::vector<double>& speeds);
  Jet multisine(double t) const;

  HiddenExcitation excitation_;
  std::vector<double> phases_;
  double crest_ = 1.0;
  std::vector<Change> changes_;  ///< of level (step_hold) or of speed (ramp, staircase)
  double width_ = 1.0;           ///< s, of a change
};

}  // namespace flexspline::data
