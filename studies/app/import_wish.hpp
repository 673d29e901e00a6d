#pragma once

#include "command.hpp"
#include "flexspline/data/import.hpp"

namespace flexspline::app {

/// What a person asks of an import, by its options. Errors: usage, naming the option.
Result<data::ImportWish> import_wish(const Arguments& arguments);

}  // namespace flexspline::app
