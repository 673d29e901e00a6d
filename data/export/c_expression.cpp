#include "export/c_expression.hpp"

#include <map>

#include <fmt/format.h>

namespace flexspline::data {
namespace {

using Does = Traced::Does;
using Step = Traced::Step;

constexpr std::pair<Does, std::string_view> kOperators[] = {
    {Does::add, "+"}, {Does::subtract, "-"}, {Does::multiply, "*"}, {Does::divide, "/"}};
constexpr std::pair<Does, std::string_view> kFunctions[] = {
    {Does::exp, "exp"}, {Does::log, "log"},   {Does::sqrt, "sqrt"}, {Does::sin, "sin"},
    {Does::cos, "cos"}, {Does::tanh, "tanh"}, {Does::atan, "atan"}};

std::string name_of(const std::vector<Step>& steps, int k) {
  const Step& step = steps[static_cast<std::size_t>(k)];
  if (step.does == Does::constant) return c_number(step.value);
  if (step.does == Does::variable) return step.name;
  return fmt::format("v{}", k);
}

std::string expression(const std::vector<Step>& steps, const Step& step) {
  const auto operand = [&](int k) { return name_of(steps, k); };
  for (const auto& [does, sign] : kOperators) {
    if (step.does == does) return fmt::format("{} {} {}", operand(step.a), sign, operand(step.b));
  }
  for (const auto& [does, function] : kFunctions) {
    if (step.does == does) return fmt::format("{}({})", function, operand(step.a));
  }
  if (step.does == Does::negate) return fmt::format("-({})", operand(step.a));
  return fmt::format("{} < 0.0 ? {} : {}", operand(step.a), operand(step.b), operand(step.c));
}

void need(const std::vector<Step>& steps, int k, std::vector<bool>& needed) {
  if (k < 0 || needed[static_cast<std::size_t>(k)]) return;
  needed[static_cast<std::size_t>(k)] = true;
  const Step& step = steps[static_cast<std::size_t>(k)];
  for (int operand : {step.a, step.b, step.c}) need(steps, operand, needed);
}

std::string statements(const std::vector<Step>& steps, const std::vector<int>& results) {
  std::vector<bool> needed(steps.size(), false);
  for (int result : results) need(steps, result, needed);
  std::string text;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const Does does = steps[k].does;
    if (!needed[k] || does == Does::constant || does == Does::variable) continue;
    text += fmt::format("  const double v{} = {};\n", k, expression(steps, steps[k]));
  }
  return text;
}

/// Rules of differentiation over the steps of a tape.
class Slope {
 public:
  Slope(Traced::Tape& tape, const std::string& variable) : tape_(tape), variable_(variable) {}

  Traced of(int k) {
    if (k < 0) return 0.0;
    const auto known = done_.find(k);
    if (known != done_.end()) return known->second;
    const Step step = tape_.steps()[static_cast<std::size_t>(k)];
    const Traced slope = rule(step, k);
    done_.emplace(k, slope);
    return slope;
  }

 private:
  Traced at(int k) const {
    const Step& step = tape_.steps()[static_cast<std::size_t>(k)];
    return step.does == Does::constant ? Traced(step.value) : Traced::at_step(k);
  }

  Traced rule(const Step& s, int self) {
    switch (s.does) {
      case Does::constant:
        return 0.0;
      case Does::variable:
        return s.name == variable_ ? 1.0 : 0.0;
      case Does::add:
        return of(s.a) + of(s.b);
      case Does::subtract:
        return of(s.a) - of(s.b);
      case Does::multiply:
        return of(s.a) * at(s.b) + at(s.a) * of(s.b);
      case Does::divide:
        return (of(s.a) - at(self) * of(s.b)) / at(s.b);
      case Does::negate:
        return -of(s.a);
      case Does::if_negative:
        return chosen(s);
      default:
        return outer(s, self) * of(s.a);
    }
  }

  Traced chosen(const Step& s) {
    const Traced then = of(s.b);
    const Traced otherwise = of(s.c);
    if (then.is_constant() && otherwise.is_constant() && then.constant() == otherwise.constant()) {
      return then;
    }
    return where_negative(at(s.a), then, otherwise);
  }

  Traced outer(const Step& s, int self) const {
    const Traced x = at(s.a);
    const Traced y = at(self);
    switch (s.does) {
      case Does::exp:
        return y;
      case Does::log:
        return 1.0 / x;
      case Does::sqrt:
        return 0.5 / y;
      case Does::sin:
        return cos(x);
      case Does::cos:
        return -sin(x);
      case Does::tanh:
        return 1.0 - y * y;
      default:  // atan
        return 1.0 / (1.0 + x * x);
    }
  }

  Traced::Tape& tape_;
  const std::string& variable_;
  std::map<int, Traced> done_;
};

}  // namespace

std::string c_number(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return value < 0.0 ? "(" + text + ")" : text;
}

std::string c_return(const Traced::Tape& tape, const Traced& result) {
  if (result.is_constant()) return fmt::format("  return {};\n", c_number(result.constant()));
  const int k = result.step();
  return statements(tape.steps(), {k}) + fmt::format("  return {};\n", name_of(tape.steps(), k));
}

std::string c_assign(const Traced::Tape& tape, const std::vector<Traced>& results,
                     const std::string& target) {
  std::vector<int> steps;
  for (const Traced& one : results) steps.push_back(one.step());
  std::string text = statements(tape.steps(), steps);
  for (std::size_t k = 0; k < steps.size(); ++k) {
    text += fmt::format("  {}[{}] = {};\n", target, k, name_of(tape.steps(), steps[k]));
  }
  return text;
}

Traced derivative(Traced::Tape& tape, const Traced& result, const std::string& variable) {
  if (result.is_constant()) return 0.0;
  return Slope(tape, variable).of(result.step());
}

}  // namespace flexspline::data
