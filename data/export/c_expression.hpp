#pragma once

#include <string>
#include <vector>

#include "flexspline/core/traced.hpp"

namespace flexspline::data {

/// A number as a literal of C that reads back to the same bits.
std::string c_number(double value);

/// Statements that compute a traced result in C, the last of them "return ...;", indented by two
/// spaces. Steps that it does not need are left out.
std::string c_return(const Traced::Tape& tape, const Traced& result);

/// The same for several results: "target[k] = ...;".
std::string c_assign(const Traced::Tape& tape, const std::vector<Traced>& results,
                     const std::string& target);

/// d result / d variable, traced on the same tape; exact.
Traced derivative(Traced::Tape& tape, const Traced& result, const std::string& variable);

}  // namespace flexspline::data
