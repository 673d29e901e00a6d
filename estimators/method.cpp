#include "flexspline/estimators/method.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "flexspline/core/nearest_name.hpp"

namespace flexspline::estimators {
namespace {

template <class Names>
std::string suggestion(std::string_view given, const Names& names) {
  const auto nearest = nearest_name(given, names);
  return nearest ? fmt::format("did you mean '{}'?", *nearest)
                 : fmt::format("it is one of: {}", fmt::join(names, ", "));
}

Result<const OptionInfo*> find_option(const MethodRow& method, std::string_view name) {
  const auto option = std::ranges::find(method.options, name, &OptionInfo::name);
  if (option != method.options.end()) return &*option;
  std::vector<std::string_view> names;
  for (const auto& known : method.options) names.push_back(known.name);
  return failure(ErrorCode::bad_data,
                 fmt::format("estimator {} has no option '{}'", method.id, name),
                 names.empty() ? "it has none" : suggestion(name, names));
}

Result<void> check_number(const MethodRow& method, const std::string& name, double value) {
  const auto option = find_option(method, name);
  if (!option) return tl::unexpected(option.error());
  if (!(*option)->choices.empty()) {
    return failure(ErrorCode::bad_data, fmt::format("option '{}' of {} is a word", name, method.id),
                   fmt::format("one of: {}", fmt::join((*option)->choices, ", ")));
  }
  if (!(value >= (*option)->lower && value <= (*option)->upper)) {
    return failure(ErrorCode::bad_data,
                   fmt::format("option '{}' of {} is {}", name, method.id, value),
                   fmt::format("it lies in [{}, {}]", (*option)->lower, (*option)->upper));
  }
  return {};
}

Result<void> check_word(const MethodRow& method, const std::string& name,
                        const std::string& value) {
  const auto option = find_option(method, name);
  if (!option) return tl::unexpected(option.error());
  const auto& choices = (*option)->choices;
  if (std::ranges::find(choices, value) == choices.end()) {
    return failure(ErrorCode::bad_data,
                   fmt::format("option '{}' of {} is '{}'", name, method.id, value),
                   choices.empty() ? "it is a number" : suggestion(value, choices));
  }
  return {};
}

}  // namespace

Result<const MethodRow*> find_method(std::string_view id) {
  const auto rows = methods();
  const auto row = std::ranges::find(rows, id, &MethodRow::id);
  if (row != rows.end()) return &*row;
  std::vector<std::string_view> names;
  for (const auto& known : rows) names.push_back(known.id);
  return failure(ErrorCode::usage, fmt::format("there is no estimator '{}'", id),
                 suggestion(id, names));
}

Result<void> check_options(const MethodRow& method, const Options& options) {
  for (const auto& [name, value] : options.numbers) {
    if (auto checked = check_number(method, name, value); !checked) return checked;
  }
  for (const auto& [name, value] : options.words) {
    if (auto checked = check_word(method, name, value); !checked) return checked;
  }
  return {};
}

double number(const FitProblem& problem, const MethodRow& method, std::string_view name) {
  const auto given = problem.options.numbers.find(std::string(name));
  if (given != problem.options.numbers.end()) return given->second;
  const auto option = std::ranges::find(method.options, name, &OptionInfo::name);
  expects(option != method.options.end(), "a method asks for its own options only");
  return option->value;
}

std::string word(const FitProblem& problem, const MethodRow& method, std::string_view name) {
  const auto given = problem.options.words.find(std::string(name));
  if (given != problem.options.words.end()) return given->second;
  const auto option = std::ranges::find(method.options, name, &OptionInfo::name);
  expects(option != method.options.end(), "a method asks for its own options only");
  return std::string(option->choices.front());
}

}  // namespace flexspline::estimators
