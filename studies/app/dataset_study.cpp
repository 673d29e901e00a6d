#include "dataset_study.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>

#include <fmt/format.h>

namespace flexspline::app {
namespace {

/// The folder's name as an id that can be part of a file name.
std::string id_of(const std::filesystem::path& dataset) {
  std::error_code ignored;
  const std::filesystem::path whole = std::filesystem::weakly_canonical(dataset, ignored);
  std::string id = (whole.has_filename() ? whole : whole.parent_path()).filename().string();
  for (char& letter : id) {
    if (std::isalnum(static_cast<unsigned char>(letter)) == 0 && letter != '-' && letter != '.')
      letter = '_';
  }
  for (auto at = id.find("--"); at != std::string::npos; at = id.find("--")) id.erase(at, 1);
  return id.empty() ? "dataset" : id;
}

}  // namespace

Result<studies::StudyConfig> dataset_study(const std::filesystem::path& dataset,
                                           const std::vector<std::string>& methods,
                                           const std::string& train,
                                           const estimators::Options& options) {
  studies::StudyConfig study;
  if (train != studies::kTrainAll && train != studies::kTrainOne) {
    return failure(ErrorCode::usage, fmt::format("--train '{}' is not known", train),
                   "give all, or one for the recording with the largest motion");
  }
  studies::InputConfig input;
  input.id = id_of(dataset);
  input.title = input.id;
  input.dataset = dataset;
  study.name = input.id;
  study.title = input.id;
  study.inputs.push_back(input);
  for (const std::string& id : methods) {
    const auto method = estimators::find_method(id);
    if (!method) return tl::unexpected(method.error());
    if (auto checked = estimators::check_options(**method, options); !checked) {
      return tl::unexpected(in_context(checked.error(), id));
    }
    studies::EstimatorConfig estimator;
    estimator.id = id;
    estimator.title = id;
    estimator.method = id;
    estimator.train = train;
    estimator.options = options;
    study.estimators.push_back(std::move(estimator));
  }
  return study;
}

Result<std::size_t> rows_of(const Arguments& arguments) {
  if (arguments.text("rows") == "all") return data::kAllRows;
  const auto rows = arguments.integer("rows", static_cast<long>(data::kMostRows), 16, 100'000'000);
  if (!rows) return tl::unexpected(rows.error());
  return static_cast<std::size_t>(*rows);
}

ArgumentInfo rows_argument() {
  return {.name = "--rows",
          .meaning = "at most so many rows of a recording, every k-th; 20000 where absent",
          .value = "N|all"};
}

Result<estimators::Options> parse_options(const std::vector<std::string>& given) {
  estimators::Options options;
  for (const std::string& one : given) {
    const std::size_t equals = one.find('=');
    if (equals == std::string::npos || equals == 0) {
      return failure(ErrorCode::usage, fmt::format("--option '{}' has no value", one),
                     "write --option name=value");
    }
    const std::string name = one.substr(0, equals);
    const std::string value = one.substr(equals + 1);
    double number = 0.0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    if (error == std::errc{} && end == value.data() + value.size())
      options.numbers[name] = number;
    else
      options.words[name] = value;
  }
  return options;
}

}  // namespace flexspline::app
