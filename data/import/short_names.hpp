#pragma once

#include <optional>
#include <string_view>

#include "flexspline/core/recording.hpp"

namespace flexspline::data {

/// Names of columns in tables that an import writes: t, theta_m, theta_l, tau, tau_m; else the
/// quantity's own.
std::string_view short_name(Quantity quantity);
std::optional<Quantity> quantity_of_short_name(std::string_view name);

}  // namespace flexspline::data
