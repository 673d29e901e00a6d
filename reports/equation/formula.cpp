#include "equation/formula.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace flexspline::reports {
namespace {

using Kind = Formula::Kind;

constexpr std::array kGreek = {"alpha", "beta", "delta", "eps", "mu",   "omega",
                               "phi",   "rho",  "sigma", "tau", "theta"};
constexpr std::array kFunctions = {"abs",   "clamp", "cos", "exp",  "ln",  "max", "min",
                                   "round", "sgn",   "sin", "sqrt", "sum", "tanh"};
// Words of two letters, which else are a letter with an index.
constexpr std::array kShortWords = {"an", "as", "at", "by", "if", "in",
                                    "is", "of", "or", "so", "to"};
constexpr int kDeepest = 32;  // brackets within brackets; deeper ones are signs
constexpr std::array kLongNames = {"dtc", "th1"};
constexpr std::array kSigns = {"+=", "-=", ">=", "<=", "+-"};

template <std::size_t Count>
bool among(const std::array<const char*, Count>& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

Formula leaf(Kind kind, std::string text) { return {.kind = kind, .text = std::move(text)}; }

/// Without the brackets that a fraction's bar or a raised place makes needless.
Formula bare(Formula formula) {
  if (formula.kind == Kind::fence && formula.text == "()") formula.kind = Kind::row;
  return formula;
}

class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text) {}

  /// Up to the closing bracket or the end.
  Formula row(char closing = '\0') {
    Formula all;
    while (skip_blanks(), at_ < text_.size() && !closes(closing)) all.parts.push_back(term());
    return all;
  }

 private:
  char here(std::size_t ahead = 0) const {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
  }
  void skip_blanks() {
    while (here() == ' ') ++at_;
  }
  bool opens_bar() const {
    return at_ == 0 || std::string_view(" (-+/=,").find(text_[at_ - 1]) != std::string_view::npos;
  }
  bool closes(char closing) const {
    if (closing == '|') return here() == '|' && !opens_bar();
    return closing != '\0' && here() == closing;
  }

  /// A factor with its powers, over another where a slash follows.
  Formula term() {
    Formula left = raised(factor());
    while (here() == '/' && left.kind != Kind::word && left.kind != Kind::sign) {
      ++at_;
      Formula right = raised(factor());
      left = {.kind = Kind::fraction, .parts = {bare(std::move(left)), bare(std::move(right))}};
    }
    return left;
  }

  Formula raised(Formula base) {
    if (here() == '\'') {
      Formula primes = leaf(Kind::sign, "'");
      ++at_;
      base = {.kind = Kind::power, .parts = {std::move(base), std::move(primes)}};
    }
    if (here() != '^') return base;
    ++at_;
    Formula exponent;
    if (here() == '-') exponent.parts.push_back(leaf(Kind::sign, std::string(1, text_[at_++])));
    exponent.parts.push_back(bare(factor()));
    base = {.kind = Kind::power, .parts = {std::move(base), std::move(exponent)}};
    return base.parts.front().kind == Kind::function ? applied(std::move(base)) : base;
  }

  Formula factor() {
    skip_blanks();
    const char c = here();
    if (is_letter(c)) return name();
    if (is_digit(c)) return number();
    if (depth_ < kDeepest && c == '(') return fence('(', ')');
    if (depth_ < kDeepest && c == '|' && opens_bar()) return fence('|', '|');
    return sign();
  }

  Formula fence(char opening, char closing) {
    ++at_;
    ++depth_;
    Formula inside = row(closing);
    --depth_;
    if (here() == closing) ++at_;
    return {.kind = Kind::fence, .text = {opening, closing}, .parts = std::move(inside.parts)};
  }

  Formula sign() {
    for (const std::string_view two : kSigns) {
      if (text_.substr(at_).starts_with(two)) {
        at_ += two.size();
        return leaf(Kind::sign, std::string(two));
      }
    }
    if (at_ >= text_.size()) return {};
    const std::size_t from = at_++;
    while ((static_cast<unsigned char>(here()) & 0xC0U) == 0x80U)
      ++at_;  // the rest of a letter in UTF-8
    return leaf(Kind::sign, std::string(text_.substr(from, at_ - from)));
  }

  Formula number() {
    const std::size_t from = at_;
    while (is_digit(here()) || (here() == '.' && is_digit(here(1)))) ++at_;
    return leaf(Kind::number, std::string(text_.substr(from, at_ - from)));
  }

  std::string letters() {
    const std::size_t from = at_;
    while (is_letter(here()) || is_digit(here())) ++at_;
    return std::string(text_.substr(from, at_ - from));
  }

  /// A function's argument belongs to it.
  Formula applied(Formula function) {
    if (here() != '(' || depth_ >= kDeepest) return function;
    return {.kind = Kind::row, .parts = {std::move(function), fence('(', ')')}};
  }

  bool is_word(const std::string& text) const {
    if (text == "a") return after_word_ || (here() == ' ' && next_is_word());
    if (text.size() == 2) return among(kShortWords, text);
    return text.size() > 2 && !is_greek(text) && !among(kLongNames, text);
  }
  bool next_is_word() const {
    std::size_t end = at_ + 1;
    while (end < text_.size() && is_letter(text_[end])) ++end;
    const std::string next(text_.substr(at_ + 1, end - at_ - 1));
    return next.size() > 2 && !is_greek(next) && !among(kFunctions, next);
  }

  Formula name() {
    std::string text = letters();
    if (among(kFunctions, text)) return function(text);
    if (here() != '_' && is_word(text)) {
      while (here() == '-' && is_letter(here(1))) {
        text += text_[at_++];
        text += letters();
      }
      after_word_ = true;
      return leaf(Kind::word, text);
    }
    after_word_ = false;
    return symbol(std::move(text));
  }

  Formula function(const std::string& text) {
    after_word_ = false;
    Formula called = leaf(Kind::function, text);
    if (text == "sum") {
      if (here() == '_') called.index = (++at_, letters());
      return called;
    }
    if (text == "sqrt" && here() == '(' && depth_ < kDeepest) {
      return {.kind = Kind::root, .parts = fence('(', ')').parts};
    }
    return here() == '^' ? called : applied(std::move(called));
  }

  Formula symbol(std::string text) {
    Formula one = leaf(Kind::symbol, text);
    if (text == "th1") {
      one.text = "theta";
      one.index += '1';
    } else if (!is_greek(text) && text.size() > 1) {
      one.text = text.substr(0, 1);
      one.index = text.substr(1);
    }
    if (here() == '_') {
      ++at_;
      one.index += letters();
      while (here() == ',' && is_letter(here(1))) {
        ++at_;
        one.index += ',';
        one.index += letters();
      }
    }
    for (; here() == '\''; ++at_) ++one.primes;
    return applied(std::move(one));
  }

  std::string_view text_;
  std::size_t at_ = 0;
  bool after_word_ = false;
  int depth_ = 0;
};

}  // namespace

bool is_greek(std::string_view name) { return among(kGreek, name); }

Formula parse_formula(std::string_view text) { return Parser(text).row(); }

}  // namespace flexspline::reports
