#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "flexspline/core/error.hpp"
#include "flexspline/core/estimate.hpp"
#include "flexspline/core/model_spec.hpp"
#include "flexspline/core/recording.hpp"

namespace flexspline::estimators {

/// One setting of a method: a number (flags are 0 or 1), or a word out of a list.
struct OptionInfo {
  std::string_view name;
  std::string_view meaning;
  double value = 0.0;  ///< default of a number
  double lower = 0.0;  ///< smallest and largest admissible number
  double upper = 0.0;
  std::vector<std::string_view>
      choices{};  ///< admissible words, the default first; empty: a number
};

/// Options as given; a method takes its default for what is absent.
struct Options {
  std::map<std::string, double> numbers;
  std::map<std::string, std::string> words;
};

/// A model whose form is given: its numbers are starts. Entries of hold and free name parameters
/// (stribeck_friction.excess), laws or effects with all of theirs (f, stribeck_friction), or an
/// ending that several share (.yield).
struct GivenModel {
  ModelSpec model;
  std::vector<std::string> hold;  ///< stay as they are
  std::vector<std::string> free;  ///< are fitted though they would be held
};

/// What is to be fitted: the training recordings alone. What is held out never comes here.
struct FitProblem {
  std::vector<TorsionRecord> records;
  Options options;
  std::optional<GivenModel> model{};  ///< for methods that take one
};

/// A row of the catalogue of estimators.
struct MethodRow {
  std::string_view id;
  std::string_view summary;
  std::string_view source;
  std::vector<OptionInfo> options;
  Result<Estimate> (*fit)(const FitProblem&);
  bool takes_model = false;  ///< fits the form it is given, and cannot do without
};

/// Every method, one file each in estimators/methods.
std::span<const MethodRow> methods();

/// Errors: usage, with the nearest name, for a method that does not exist.
Result<const MethodRow*> find_method(std::string_view id);

/// Errors: bad_data, for an option that the method does not have or a value outside its range.
Result<void> check_options(const MethodRow& method, const Options& options);

/// Number of an option: as given, else its default.
double number(const FitProblem& problem, const MethodRow& method, std::string_view name);
/// Word of an option: as given, else its default.
std::string word(const FitProblem& problem, const MethodRow& method, std::string_view name);

}  // namespace flexspline::estimators
