#pragma once

#include <span>
#include <string_view>

#include "flexspline/core/effect.hpp"

namespace flexspline {

/// A variable of an instant, and its name for messages.
struct NamedVariable {
  Complex Instant<Complex>::*member;
  std::string_view name;
};

/// Whether an effect's term, or the rate of its memory, depends on a variable: by a complex step at
/// an instant where nothing is zero. A dependence that begins beyond a threshold may be missed.
bool depends_on(const EffectRow& row, std::span<const double> values,
                Complex Instant<Complex>::*variable);

/// The same of the term alone.
bool term_depends_on(const EffectRow& row, std::span<const double> values,
                     Complex Instant<Complex>::*variable);

}  // namespace flexspline
