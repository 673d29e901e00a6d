#pragma once

#include <string_view>

#include "flexspline/core/drive_spec.hpp"
#include "flexspline/core/error.hpp"

namespace flexspline::data {

/// Whether what turns has an inertia: motor and load of a free rig, the motor of a locked one;
/// where motor and load turn as one (on a servo, and as_one), either of them.
/// Errors: bad_data, naming the keys that are missing and what to state.
Result<void> inertia_there(const RigModel& model, std::string_view form, bool as_one = false);

}  // namespace flexspline::data
