#pragma once

#include <string>
#include <string_view>

namespace flexspline::reports {

/// The catalogue writes equations in a linear notation: `tau_f += mu |tau|/N tanh(w/we)`. A name is one
/// quantity, of Greek letters by their names, with what follows its first letter or `_` as index;
/// `'` is a derivative, `sum_k` a sum; words of three letters and more are words. These set it as
/// mathematics. Whatever does not parse stands as it was written.

/// LaTeX for the middle of a line: `\tau_{f} \mathrel{\text{+=}} \mu \frac{|\tau|}{N} ...`.
std::string tex_of(std::string_view equation);

/// A MathML element <math display="block">, which browsers set without any script.
std::string mathml_of(std::string_view equation);

}  // namespace flexspline::reports
