#pragma once

#include <optional>
#include <vector>

#include "flexspline/data/hidden_bench.hpp"

namespace flexspline::data {

/// Why the bench cannot run so, naming the setting and its value, or nothing.
std::optional<Error> refusal(const HiddenBench& bench);

/// The same for what is to be hidden.
std::optional<Error> refusal(const HiddenBench& bench, const std::vector<HiddenEffect>& effects);

}  // namespace flexspline::data
