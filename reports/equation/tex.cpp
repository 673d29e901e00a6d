#include <map>

#include <fmt/format.h>

#include "equation/formula.hpp"
#include "flexspline/reports/equation.hpp"

namespace flexspline::reports {
namespace {

using Kind = Formula::Kind;

std::string letter_tex(const std::string& name) {
  if (name == "eps") return "\\varepsilon";
  return is_greek(name) ? "\\" + name : name;
}

/// An index of one letter or number is set like it, a word upright.
std::string index_tex(const std::string& index) {
  std::string tex;
  for (std::size_t from = 0; from <= index.size();) {
    const std::size_t comma = std::min(index.find(',', from), index.size());
    const std::string one = index.substr(from, comma - from);
    tex += (tex.empty() ? "" : ",") + (one.size() > 1 ? "\\mathrm{" + one + "}" : one);
    from = comma + 1;
  }
  return "_{" + tex + "}";
}

std::string symbol_tex(const Formula& one) {
  return letter_tex(one.text) + (one.index.empty() ? "" : index_tex(one.index)) +
         std::string(static_cast<std::size_t>(one.primes), '\'');
}

std::string sign_tex(const std::string& sign) {
  static const std::map<std::string, std::string> signs = {{"+=", "\\mathrel{\\text{+=}}"},
                                                           {"-=", "\\mathrel{\\text{-=}}"},
                                                           {">=", "\\ge"},
                                                           {"<=", "\\le"},
                                                           {"+-", "\\pm"},
                                                           {"*", "\\cdot"},
                                                           {",", ",\\;\\;"},
                                                           {";", ";\\;\\;"},
                                                           {":", ":\\;"},
                                                           {"'", "\\prime"}};
  const auto found = signs.find(sign);
  return found == signs.end() ? sign : found->second;
}

std::string function_tex(const Formula& one) {
  if (one.text == "sum") return "\\sum" + (one.index.empty() ? "" : index_tex(one.index));
  for (const char* own : {"sin", "cos", "exp", "ln", "tanh", "max", "min"}) {
    if (one.text == own) return "\\" + one.text;
  }
  return "\\operatorname{" + one.text + "}";
}

std::string tex(const Formula& one);

std::string row_tex(const std::vector<Formula>& parts) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].kind != Kind::word) {
      if (!text.empty()) text += ' ';
      text += tex(parts[i]);
      continue;
    }
    std::string words = parts[i].text;
    while (i + 1 < parts.size() && parts[i + 1].kind == Kind::word) words += " " + parts[++i].text;
    text += (text.empty() ? "\\text{" : " \\text{ ") + words + " }";
  }
  return text;
}

std::string tex(const Formula& one) {
  switch (one.kind) {
    case Kind::row:
      return row_tex(one.parts);
    case Kind::symbol:
      return symbol_tex(one);
    case Kind::sign:
      return sign_tex(one.text);
    case Kind::function:
      return function_tex(one);
    case Kind::fraction:
      return fmt::format("\\frac{{{}}}{{{}}}", tex(one.parts[0]), tex(one.parts[1]));
    case Kind::power:
      return fmt::format("{{{}}}^{{{}}}", tex(one.parts[0]), tex(one.parts[1]));
    case Kind::root:
      return "\\sqrt{" + row_tex(one.parts) + "}";
    case Kind::fence:
      return (one.text == "||" ? "\\left|" : "\\left(") + row_tex(one.parts) +
             (one.text == "||" ? "\\right|" : "\\right)");
    case Kind::number:
    case Kind::word:
      break;
  }
  return one.text;
}

}  // namespace

std::string tex_of(std::string_view equation) { return tex(parse_formula(equation)); }

}  // namespace flexspline::reports
