#pragma once

#include <array>
#include <optional>

#include "diagnosis/proof/prove.hpp"
#include "flexspline/studies/diagnosis.hpp"

namespace flexspline::studies {

/// What a model leaves to the best table over one or two coordinates, by equation: log evidence,
/// nats.
std::array<double, 3> left_to_tables(const Frame& frame, const Findings& model);

/// The best table of all, where it lowers the error on recordings held out: it is judged by tables
/// chosen and fitted without them, the 95 % interval of the ratio of the errors ends below 1, and
/// what the table takes there is more than limits.trifle() of the largest torque, rms.
std::optional<UnnamedPart> unnamed_part(const Frame& frame, const Selection& selection,
                                        const Proof& proof, const Limits& limits);

}  // namespace flexspline::studies
