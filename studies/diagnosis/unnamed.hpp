#pragma once

#include <array>
#include <optional>

#include "diagnosis/prove.hpp"
#include "flexspline/studies/diagnosis.hpp"

namespace flexspline::studies {

/// What a table over one or two coordinates finds in the residual of each equation: log evidence,
/// nats; 0 where nothing.
std::array<double, 3> left_to_tables(const Frame& frame, const Findings& findings);

/// What the final model leaves as a table over one or two coordinates, the most evident of those of
/// an equation, where it lowers the error on recordings held out: each is judged by a table chosen
/// and fitted without it, the 95 % interval of the ratio of the errors ends below 1, and what the
/// table takes there is more than limits.trifle() of the largest torque, rms. None where no
/// table does.
std::optional<UnnamedPart> unnamed_part(const Frame& frame, const Selection& selection,
                                        const Proof& proof, const Limits& limits);

}  // namespace flexspline::studies
