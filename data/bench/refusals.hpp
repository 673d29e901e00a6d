#pragma once

#include <optional>

#include "flexspline/data/bench.hpp"

namespace flexspline::data {

/// Why the bench cannot run so, naming the setting and its value, or nothing.
std::optional<Error> refusal(const BenchTruth& truth, const BenchExcitation& excitation,
                             const BenchSensors& sensors);

}  // namespace flexspline::data
