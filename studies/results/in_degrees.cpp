#include <cctype>
#include <cmath>
#include <numbers>
#include <vector>

#include "flexspline/studies/diagnosis_json.hpp"

namespace flexspline::studies {
namespace {

bool is_letter(const std::string& text, std::size_t at) {
  return at < text.size() && std::isalpha(static_cast<unsigned char>(text[at])) != 0;
}

/// The power written behind a symbol: ^2 or ^-1, else 1.
int power_at(const std::string& unit, std::size_t at) {
  if (at >= unit.size() || unit[at] != '^') return 1;
  const bool negative = at + 1 < unit.size() && unit[at + 1] == '-';
  const std::size_t digit = at + (negative ? 2 : 1);
  if (digit >= unit.size() || std::isdigit(static_cast<unsigned char>(unit[digit])) == 0) return 1;
  return negative ? '0' - unit[digit] : unit[digit] - '0';
}

/// Whether what follows stands above or below the fraction bar, bracket by bracket.
class Side {
 public:
  void read(char letter) {
    if (letter == '/') sign_.back() = -outer_.back();
    if (letter == '(') {
      outer_.push_back(sign_.back());
      sign_.push_back(sign_.back());
    }
    if (letter == ')' && sign_.size() > 1) {
      outer_.pop_back();
      sign_.pop_back();
    }
  }
  int sign() const { return sign_.back(); }

 private:
  std::vector<int> outer_{1};
  std::vector<int> sign_{1};
};

}  // namespace

std::pair<double, std::string> in_degrees(const std::string& unit) {
  constexpr std::size_t kLength = 3;
  std::string text;
  int radians = 0;
  Side side;
  for (std::size_t at = 0; at < unit.size();) {
    const bool word = unit.compare(at, kLength, "rad") == 0 && !is_letter(unit, at + kLength) &&
                      (at == 0 || !is_letter(unit, at - 1));
    if (word) {
      radians += side.sign() * power_at(unit, at + kLength);
      text += "deg";
      at += kLength;
      continue;
    }
    side.read(unit[at]);
    text += unit[at++];
  }
  return {std::pow(180.0 / std::numbers::pi, radians), text};
}

}  // namespace flexspline::studies
