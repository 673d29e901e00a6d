#pragma once

#include <span>
#include <string_view>

#include "flexspline/core/units.hpp"
#include "flexspline/data/hidden_bench.hpp"

namespace flexspline::studies {

/// A setting of the bench's instruments that a file may name, with the range the bench takes.
struct NuisanceSetting {
  std::string_view name;
  double data::HiddenNuisances::*member;
  Dimension dimension;
  double lowest;  ///< SI
};

std::span<const NuisanceSetting> nuisance_settings();

}  // namespace flexspline::studies
