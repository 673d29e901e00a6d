#include <algorithm>

#include <fmt/format.h>

#include "config/study_reader.hpp"
#include "flexspline/core/nearest_name.hpp"
#include "flexspline/data/model_toml.hpp"
#include "flexspline/studies/kind.hpp"

namespace flexspline::studies {
namespace {

std::vector<std::string_view> grid_ids(const StudyConfig& study) {
  std::vector<std::string_view> ids;
  for (const Grid& grid : study.grids) ids.emplace_back(grid.id);
  return ids;
}

void check_grid(TomlSection& section, std::string_view key, const std::string& id,
                const StudyConfig& study, std::vector<std::string_view> also) {
  if (id.empty() || study.find_grid(id) != nullptr) return;
  if (std::ranges::find(also, id) != also.end()) return;
  std::ranges::copy(grid_ids(study), std::back_inserter(also));
  section.refuse(key,
                 fmt::format("'{}' = \"{}\" is not a grid of this study", section.name_of(key), id),
                 suggestion(id, also));
}

void check_truth(TomlSection& section, const InputConfig& input) {
  if (data::find_truth(input.truth)) return;
  std::vector<std::string_view> names;
  for (const data::TruthRow& row : data::truths()) names.push_back(row.id);
  section.refuse("truth", fmt::format("there is no truth '{}'", input.truth),
                 suggestion(input.truth, names));
}

/// The row of a method, or null after saying that there is none.
const estimators::MethodRow* check_method(TomlSection& section, const std::string& id) {
  if (id.empty()) return nullptr;
  if (const auto row = estimators::find_method(id)) return *row;
  std::vector<std::string_view> names;
  for (const estimators::MethodRow& row : estimators::methods()) names.push_back(row.id);
  section.refuse("method", fmt::format("there is no estimator method '{}'", id),
                 suggestion(id, names));
  return nullptr;
}

estimators::Options read_options(TomlSection& section, const estimators::MethodRow* method) {
  estimators::Options options;
  std::optional<TomlSection> table = section.table("options");
  if (!table) return options;
  for (const auto& [key, value] : table->raw()) {
    const std::string name(key.str());
    if (value.is_number())
      options.numbers[name] = *value.value<double>();
    else if (const auto* flag = value.as_boolean())
      options.numbers[name] = flag->get() ? 1.0 : 0.0;
    else if (const auto* word = value.as_string())
      options.words[name] = word->get();
    else
      table->refuse_at(value,
                       fmt::format("'{}' is neither a number nor a word", table->name_of(name)));
    if (method == nullptr) continue;
    estimators::Options one;
    if (options.numbers.contains(name)) one.numbers[name] = options.numbers[name];
    if (options.words.contains(name)) one.words[name] = options.words[name];
    const Result<void> checked = estimators::check_options(*method, one);
    if (!checked) table->refuse_at(value, checked.error().problem, checked.error().remedy);
  }
  return options;
}

/// The model that a method takes, with what of it is held.
std::optional<estimators::GivenModel> read_given_model(TomlSection& section,
                                                       const estimators::MethodRow* method,
                                                       const std::filesystem::path& root) {
  const auto file = section.text("model");
  estimators::GivenModel given{{}, section.texts("hold"), section.texts("free")};
  if (method == nullptr) return std::nullopt;
  if (file.has_value() != method->takes_model) {
    section.refuse("model",
                   fmt::format("method '{}' {}", method->id,
                               file ? "takes no model" : "fits a model and is given none"),
                   file ? "use method = \"model_file\", or leave the model out"
                        : "add model = \"FILE.toml\" (docs/model-file.md)");
    return std::nullopt;
  }
  if (!file) return std::nullopt;
  auto model = data::read_model(root / *file);
  if (!model) {
    section.refuse("model", model.error().message());
    return std::nullopt;
  }
  given.model = std::move(*model);
  return given;
}

/// The recordings to hold out, where the study names them.
std::optional<std::vector<std::string>> read_held_out(TomlSection& section,
                                                      const InputConfig& input) {
  if (!section.has("held_out")) return std::nullopt;
  auto ids = section.texts("held_out");
  if (input.dataset.empty()) {
    section.refuse("held_out", fmt::format("input '{}' is no data set", input.id),
                   "use holdout = \"<id of a grid>\"");
  }
  return ids;
}

/// How the bench records this input, where it says more than the study does.
std::optional<BenchConfig> read_own_bench(TomlSection& section, const InputConfig& input,
                                          const BenchConfig& otherwise) {
  auto table = section.table("bench");
  if (!table) return std::nullopt;
  if (input.truth.empty()) {
    section.refuse("bench", fmt::format("input '{}' is a data set, not recorded here", input.id),
                   "leave 'bench' out");
  }
  return read_bench(*table, otherwise);
}

/// Factors of the parts of a truth.
std::map<std::string, double> read_strength(TomlSection& section, const InputConfig& input) {
  std::map<std::string, double> strength;
  auto table = section.table("strength");
  if (!table) return strength;
  for (const auto& [key, value] : table->raw()) {
    strength[std::string(key.str())] = value.value<double>().value_or(-1.0);
  }
  const auto row = data::find_truth(input.truth);
  if (!row) {
    section.refuse("strength", fmt::format("input '{}' has no truth to be stronger", input.id),
                   "leave 'strength' out");
  } else if (const auto made = data::strengthened((*row)->make(), strength); !made) {
    section.refuse("strength", made.error().problem, made.error().remedy);
  }
  return strength;
}

}  // namespace

void check_id(TomlSection& section, const std::string& id, const std::vector<std::string>& before) {
  if (std::ranges::find(before, id) != before.end()) {
    section.refuse("id", fmt::format("'{}' = \"{}\" was given before", section.name_of("id"), id),
                   "ids are unique");
  }
  const auto plain = [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.';
  };
  if (!std::ranges::all_of(id, plain) || id.find("--") != std::string::npos ||
      id.starts_with('.')) {
    section.refuse("id", fmt::format("'{}' = \"{}\" cannot name a file", section.name_of("id"), id),
                   "use letters, digits, _ . and single -");
  }
}

InputConfig read_input(TomlSection& section, const StudyConfig& study,
                       const std::filesystem::path& data_root) {
  InputConfig input;
  input.id = section.required_text("id");
  input.title = section.text("title").value_or(input.id);
  input.truth = section.text("truth").value_or("");
  input.dataset = section.text("dataset").value_or("");
  input.holdout = section.text("holdout").value_or("");
  if (input.truth.empty() == input.dataset.empty()) {
    section.refuse("id", fmt::format("input '{}' needs either a truth or a dataset", input.id),
                   "give one of: truth = \"…\" (flexspline list truths), dataset = \"folder\"");
  }
  if (!input.truth.empty()) check_truth(section, input);
  if (!input.dataset.empty() && !input.holdout.empty()) {
    section.refuse("holdout",
                   fmt::format("input '{}' is a data set and takes no hold-out grid", input.id),
                   "name recordings: held_out = [\"<id>\"]");
  }
  check_grid(section, "holdout", input.holdout, study, {});
  input.held_out = read_held_out(section, input);
  input.bench = read_own_bench(section, input, study.bench);
  input.strength = read_strength(section, input);
  if (section.has("rows")) {
    input.rows = static_cast<std::size_t>(section.integer("rows", 0, 100'000'000).value_or(0));
  }
  if (input.dataset.is_relative() && !input.dataset.empty()) {
    input.dataset = (data_root / input.dataset).lexically_normal();
  }
  section.refuse_unknown_keys();
  return input;
}

EstimatorConfig read_estimator(TomlSection& section, const StudyConfig& study,
                               const std::filesystem::path& model_root) {
  EstimatorConfig estimator;
  estimator.id = section.required_text("id");
  estimator.title = section.text("title").value_or(estimator.id);
  estimator.method = section.required_text("method");
  estimator.train = section.text("train").value_or(estimator.train);
  estimator.steady = section.flag("steady").value_or(false);
  estimator.inputs = section.texts("inputs");
  check_grid(section, "train", estimator.train, study, {kTrainAll, kTrainOne});
  const estimators::MethodRow* method = check_method(section, estimator.method);
  estimator.options = read_options(section, method);
  estimator.model = read_given_model(section, method, model_root);
  std::vector<std::string_view> names;
  for (const InputConfig& input : study.inputs) names.emplace_back(input.id);
  for (const std::string& input : estimator.inputs) {
    if (study.find_input(input) != nullptr) continue;
    section.refuse("inputs",
                   fmt::format("'{}' names no input '{}'", section.name_of("inputs"), input),
                   suggestion(input, names));
  }
  const KindRow* kind = find_kind(study.kind);
  const bool grid_wanted = (estimator.train == kTrainAll || estimator.train == kTrainOne) &&
                           (kind == nullptr || !kind->chooses_training);
  for (const InputConfig& input : study.inputs) {
    const bool selected = estimator.inputs.empty() ||
                          std::ranges::find(estimator.inputs, input.id) != estimator.inputs.end();
    if (!grid_wanted || !selected || input.truth.empty()) continue;
    section.refuse("train",
                   fmt::format("estimator '{}' names no grid to train on, which input '{}' of the "
                               "virtual bench needs",
                               estimator.id, input.id),
                   "add train = \"<id of a grid>\"");
  }
  section.refuse_unknown_keys();
  return estimator;
}

ContrastConfig read_contrast(TomlSection& section, const StudyConfig& study) {
  ContrastConfig contrast;
  contrast.id = section.required_text("id");
  contrast.title = section.text("title").value_or(contrast.id);
  contrast.from = section.required_text("from");
  contrast.to = section.required_text("to");
  std::vector<std::string_view> names;
  for (const EstimatorConfig& one : study.estimators) names.emplace_back(one.id);
  for (const auto& [key, id] : {std::pair("from", contrast.from), std::pair("to", contrast.to)}) {
    if (id.empty() || std::ranges::find(names, id) != names.end()) continue;
    section.refuse(key, fmt::format("'{}' names no estimator '{}'", section.name_of(key), id),
                   suggestion(id, names));
  }
  section.refuse_unknown_keys();
  return contrast;
}

}  // namespace flexspline::studies
