#include "conceal/nuisances.hpp"

namespace flexspline::studies {

std::span<const NuisanceSetting> nuisance_settings() {
  using data::HiddenNuisances;
  static constexpr NuisanceSetting rows[] = {
      {"torque_noise", &HiddenNuisances::torque_noise, Dimension::dimensionless, 0.0},
      {"coloured_share", &HiddenNuisances::coloured_share, Dimension::dimensionless, 0.0},
      {"coloured_samples", &HiddenNuisances::coloured_samples, Dimension::dimensionless, 1e-3},
      {"motor_encoder_step", &HiddenNuisances::motor_encoder_step, Dimension::angle, 0.0},
      {"load_encoder_step", &HiddenNuisances::load_encoder_step, Dimension::angle, 0.0},
      {"time_jitter", &HiddenNuisances::time_jitter, Dimension::dimensionless, 0.0},
      {"angle_zero", &HiddenNuisances::angle_zero, Dimension::angle, -1.0},
  };
  return rows;
}

}  // namespace flexspline::studies
