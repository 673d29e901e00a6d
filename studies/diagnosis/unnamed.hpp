#pragma once

#include <array>
#include <optional>

#include "diagnosis/prove.hpp"
#include "flexspline/studies/diagnosis.hpp"

namespace flexspline::studies {

/// What the final model leaves to tables over one or two coordinates.
struct LeftToTables {
  std::array<double, 3> evidence{};  ///< of the best table by equation: log evidence, nats
  /// The best one of all, where it lowers the error on recordings held out: it is judged by tables
  /// chosen and fitted without them, the 95 % interval of the ratio of the errors ends below 1, and
  /// what the table takes there is more than limits.trifle() of the largest torque, rms.
  std::optional<UnnamedPart> part;
};

/// remains: whether something is left that a part is wanted of.
LeftToTables left_to_tables(const Frame& frame, const Selection& selection, const Proof& proof,
                            const Limits& limits, bool remains);

}  // namespace flexspline::studies
