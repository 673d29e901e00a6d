#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "flexspline/core/error.hpp"
#include "flexspline/core/model_spec.hpp"

namespace flexspline {

/// A motion along which a torque is simulated: phi, phi', phi'' sampled at the same instants. SI.
struct Motion {
  std::vector<double> time;
  std::vector<double> position;
  std::vector<double> velocity;
  std::vector<double> acceleration;
};

struct EffectParameter {
  std::string_view name;
  std::string_view unit;
  double lower;
  double upper;
  double nominal;  ///< for a unit of 226 Nm and ratio 50
  std::string_view source;
};

/// A row of the catalogue of effects: one physical or instrumental term beyond eq. (4).
struct EffectRow {
  std::string_view id;
  std::string_view coordinate;  ///< the variable in which it is organised
  std::string_view equation;
  std::string_view not_modelled;
  std::vector<EffectParameter> parameters;
  bool on_instrument = false;  ///< changes what is measured, so it acts after every force
  bool repeats = false;        ///< the parameters come in groups (elements) of this list
  /// Adds to (or maps) the torque along the motion.
  void (*apply)(const EffectSpec&, const Motion&, std::span<double> torque) = nullptr;
};

/// Every effect, one file each in core/effects.
std::span<const EffectRow> effects();

/// Errors: an effect that does not exist.
Result<const EffectRow*> find_effect(std::string_view id);

}  // namespace flexspline
