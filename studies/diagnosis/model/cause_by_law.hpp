#pragma once

#include <optional>

#include "diagnosis/model/cause.hpp"
#include "flexspline/core/effect.hpp"

namespace flexspline::studies {

/// The cause that an effect of the catalogue is by its own law, one element of it, as its
/// parameters say how they are found:
///   at a torque's equation  column_k = T(x; a_k = 1, other a = 0, shapes) along every recording,
/// a_k >= 0 where the effect's are. A friction at the motor, one with a rounded sign of speed, is
/// sought across the transmission too, with the rounding of g^-1 and, on a specimen, with one of
/// its own. Nothing where the effect is not sought by its law, or acts on an angle, which is not
/// linear.
std::optional<CauseRow> cause_by_law(const EffectRow& effect);

}  // namespace flexspline::studies
