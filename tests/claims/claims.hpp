#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace flexspline::claims {

/// A number that a page prints, computed again.
struct Number {
  std::string what;    ///< for the message where they differ
  double value = 0.0;  ///< NaN: of the machine (seconds), not compared
};

/// Compares the numbers of a marked block of a page, one after another as they stand, with these,
/// to the digits that are printed. A block is whatever lies between
///   <!-- claim:NAME begin --> and <!-- claim:NAME end -->
/// in the page, a cell of a table included. What stands between backquotes, in a link's target or
/// directly behind a letter is no number; 2e-7 is one, and 1.5 % is 1.5. Constants in the block
/// count too. With FLEXSPLINE_BLESS set in the environment the block is rewritten instead.
void expect(std::string_view page, std::string_view name, const std::vector<Number>& numbers);

/// Compares all of a marked block with a text: verdicts, names and numbers of a table's row or
/// rows.
void expect_text(std::string_view page, std::string_view name, const std::string& text);

/// The tokens that `expect` takes for numbers, and where they stand.
struct Token {
  std::size_t at = 0;
  std::string text;
};
std::vector<Token> numbers_in(std::string_view text);

/// A value as it would be printed in the place of a token: with as many decimals, or significant
/// digits where the token has an exponent.
std::string printed_like(const std::string& token, double value);

}  // namespace flexspline::claims
