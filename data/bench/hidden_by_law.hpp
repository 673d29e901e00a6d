#pragma once

#include <optional>

#include "flexspline/core/effect.hpp"
#include "flexspline/data/hidden_bench.hpp"

namespace flexspline::data {

/// How an effect of the catalogue is concealed by its own law, one element of it: its linear
/// parameters by the size asked for, shapes and phase drawn, widths of a sign a fiftieth of the
/// largest speed. Nothing where it is not sought by its law, or acts on an angle.
/// Not modelled: what it returns to the other shaft; at the motor, its acceleration.
std::optional<HiddenRow> hidden_by_law(const EffectRow& effect);

}  // namespace flexspline::data
