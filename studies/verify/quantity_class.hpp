#pragma once

#include <string_view>

#include "flexspline/studies/verify.hpp"

namespace flexspline::studies {

/// The class of a number, by the last key on the way to it and whether it stands in a list.
const QuantityClass& class_of(std::string_view key, bool listed);

}  // namespace flexspline::studies
