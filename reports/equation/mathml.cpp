#include <map>

#include "equation/formula.hpp"
#include "flexspline/reports/equation.hpp"
#include "page.hpp"

namespace flexspline::reports {
namespace {

using Kind = Formula::Kind;

std::string element(const char* name, const std::string& inside) {
  return std::string("<") + name + ">" + inside + "</" + name + ">";
}

std::string letter_ml(const std::string& name) {
  static const std::map<std::string, std::string> greek = {
      {"alpha", "α"}, {"beta", "β"}, {"delta", "δ"}, {"eps", "ε"}, {"mu", "μ"},   {"omega", "ω"},
      {"phi", "φ"},   {"rho", "ρ"},  {"sigma", "σ"}, {"tau", "τ"}, {"theta", "θ"}};
  const auto found = greek.find(name);
  return element("mi", found == greek.end() ? escaped(name) : found->second);
}

std::string index_ml(const std::string& index) {
  std::string ml;
  for (std::size_t from = 0; from <= index.size();) {
    const std::size_t comma = std::min(index.find(',', from), index.size());
    const std::string one = escaped(index.substr(from, comma - from));
    ml += (ml.empty() ? "" : "<mo>,</mo>") + element(one.size() > 1 ? "mtext" : "mi", one);
    from = comma + 1;
  }
  return element("mrow", ml);
}

std::string symbol_ml(const Formula& one) {
  const std::string letter = letter_ml(one.text);
  const std::string primes = one.primes == 0 ? "" : element("mo", one.primes == 1 ? "′" : "″");
  if (one.index.empty()) return primes.empty() ? letter : element("msup", letter + primes);
  const std::string index = index_ml(one.index);
  return primes.empty() ? element("msub", letter + index)
                        : element("msubsup", letter + index + primes);
}

std::string sign_ml(const std::string& sign) {
  static const std::map<std::string, std::string> signs = {
      {">=", "≥"}, {"<=", "≤"}, {"+-", "±"}, {"*", "·"}, {"'", "′"}, {"-", "−"}, {"-=", "−="}};
  const auto found = signs.find(sign);
  const std::string drawn = element("mo", found == signs.end() ? escaped(sign) : found->second);
  const bool separates = sign == "," || sign == ";" || sign == ":";
  return separates ? drawn + "<mspace width=\"0.8em\"/>" : drawn;
}

std::string function_ml(const Formula& one) {
  if (one.text != "sum") return element("mi", one.text) + "<mo>&#x2061;</mo>";
  return one.index.empty() ? "<mo>∑</mo>" : element("munder", "<mo>∑</mo>" + index_ml(one.index));
}

std::string ml(const Formula& one);

std::string row_ml(const std::vector<Formula>& parts) {
  std::string text;
  for (const Formula& part : parts) text += ml(part);
  return text;
}

std::string ml(const Formula& one) {
  const auto in_row = [](const Formula& part) { return element("mrow", ml(part)); };
  switch (one.kind) {
    case Kind::row:
      return element("mrow", row_ml(one.parts));
    case Kind::symbol:
      return symbol_ml(one);
    case Kind::sign:
      return sign_ml(one.text);
    case Kind::function:
      return function_ml(one);
    case Kind::number:
      return element("mn", one.text);
    case Kind::word:
      return element("mtext", "&#xa0;" + escaped(one.text) + "&#xa0;");
    case Kind::fraction:
      return element("mfrac", in_row(one.parts[0]) + in_row(one.parts[1]));
    case Kind::power:
      return element("msup", in_row(one.parts[0]) + in_row(one.parts[1]));
    case Kind::root:
      return element("msqrt", row_ml(one.parts));
    case Kind::fence:
      break;
  }
  return element("mrow", element("mo", one.text.substr(0, 1)) + row_ml(one.parts) +
                             element("mo", one.text.substr(1)));
}

}  // namespace

std::string mathml_of(std::string_view equation) {
  return "<math display=\"block\">" + row_ml(parse_formula(equation).parts) + "</math>";
}

}  // namespace flexspline::reports
