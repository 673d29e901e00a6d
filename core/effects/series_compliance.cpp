#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

struct SeriesCompliance {
  template <class S>
  static S term(const Instant<S>& x, std::span<const S> p, std::span<const S>) {
    return -p[0] * x.transmitted_torque;
  }
};

}  // namespace

EffectRow describe_series_compliance() {
  EffectRow row{
      .id = "series_compliance",
      .coordinate = "torsion",
      .site = Site::kinematics,
      .equation =
          "phi_e = phi - c tau: the law sees the torsion without that of sensor and fixture",
      .range = "below the resonance of the sensor with what it carries",
      .not_modelled = "mass and damping of what yields; a compliance on one side only",
      .source = "two springs in series: 1/K = 1/K_gear + c; torsion bars of torque sensors",
      .parameters = {{"compliance", "rad/Nm", 0.0, 10.0, 4.8e-5,
                      "torsion bar of 2.1e4 Nm/rad, N = 50 joint of the Compliant Joint Toolbox"}},
      .rigs = {Rig::locked, Rig::free, Rig::specimen},
      .rate_independent = true};
  instantiate<SeriesCompliance>(row);
  return row;
}

}  // namespace flexspline
