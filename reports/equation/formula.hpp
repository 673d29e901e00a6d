#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace flexspline::reports {

/// A part of an equation.
struct Formula {
  enum class Kind { row, symbol, number, word, sign, function, fraction, power, root, fence };

  Kind kind = Kind::row;
  std::string text{};            ///< of a leaf; the brackets of a fence, "()" or "||"
  std::string index{};           ///< of a symbol or a sum, "l,measured"
  int primes = 0;                ///< of a symbol
  std::vector<Formula> parts{};  ///< of a row; base and exponent; numerator and denominator; inside
};

/// The tree of an equation in linear notation.
Formula parse_formula(std::string_view text);

/// Whether a name is a Greek letter's.
bool is_greek(std::string_view name);

}  // namespace flexspline::reports
