#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "flexspline/core/units.hpp"

namespace flexspline::data {

/// The unit that a bench's word means: those of files, with brackets, and those of other languages
/// (Grad, sek, U/min). Nothing where it may mean another.
std::optional<Unit> unit_of_word(std::string_view word);

/// A name apart from the unit behind it: "tau [Nm]", "Zeit (ms)", "Zeit/ms", "torque in Nm",
/// "tau_Nm". The unit as it is written; empty where there is none.
struct NameAndUnit {
  std::string name;
  std::string unit;
};
NameAndUnit split_name(std::string_view text);

}  // namespace flexspline::data
