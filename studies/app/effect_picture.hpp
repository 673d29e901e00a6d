#pragma once

#include "flexspline/core/effect.hpp"
#include "flexspline/core/error.hpp"
#include "flexspline/reports/figure.hpp"

namespace flexspline::app {

/// What an effect of nominal size does to what a bench records: a channel without and with it, and
/// the difference, which is its signature in the residual. A unit of 226 Nm and ratio 50, without
/// noise; torques along a given sine where they show the effect, else the angles under a sine of
/// motor torque. Errors: those of the simulation.
Result<reports::Figure> picture_of(const EffectRow& row);

}  // namespace flexspline::app
