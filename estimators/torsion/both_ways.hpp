#pragma once

#include <vector>

#include "torsion/prepared_record.hpp"

namespace flexspline::estimators {

/// f and g^-1 are told apart where a torsion is passed on the way up and on the way down.
/// Errors: bad_data, with what to record, where less than half of the motion's range is.
Result<void> passed_both_ways(const std::vector<PreparedRecord>& records);

}  // namespace flexspline::estimators
