#include <cmath>
#include <numeric>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "flexspline/core/write_file.hpp"
#include "flexspline/data/checksum.hpp"
#include "flexspline/studies/results.hpp"
#include "results/results_axes.hpp"
#include "results/results_blocks.hpp"

namespace flexspline::studies {
namespace {

using Attributes = std::vector<std::pair<const char*, std::string>>;

/// Where the file comes from. No date: the same study gives the same file.
Attributes provenance(const StudyPlan& plan, const std::map<std::string, std::string>& versions) {
  const auto version = [&](const char* name) {
    const auto found = versions.find(name);
    return found == versions.end() ? std::string("unknown") : found->second;
  };
  const StudyConfig& study = *plan.study;
  const std::string text = read_file(study.file).value_or(describe_study(study));
  return {{"Conventions", "CF-1.8"},
          {"title", study.title},
          {"source", fmt::format("flexspline {}, commit {}, build {}", version("flexspline"),
                                 version("commit"), version("build"))},
          {"history", fmt::format("computed by flexspline from the study '{}'", study.name)},
          {"study_sha256", data::sha256_hex(text)},
          {"references", "study.lock.toml and ro-crate-metadata.json beside this file"}};
}

std::string unit_of_number(const std::string& name) {
  return name.ends_with("_percent") ? "percent" : "1";
}

/// One file in the making: its axes, then its variables, then a pass over the rows.
class ResultsWriter {
 public:
  ResultsWriter(const StudyRows& rows, NetcdfFile& file)
      : rows_(rows), study_(rows.study()), file_(file), axes_(axes_of(rows)) {}

  void operator()() {
    define_axes();
    define_errors();
    define_parameters();
    define_numbers();
    define_rows();
    rows_.each([&](const CasePlan& one, const CaseRow& row) {
      add_errors(one, row);
      add_parameters(one, row);
      add_numbers(one, row);
      add_rows(one, row);
    });
    for (BlockVariable& one : blocks_) one.flush();
    for (RowVariable& one : of_rows_) one.flush();
  }

 private:
  bool swept() const { return !study_.sweeps.empty(); }

  int names(const char* name, const char* says, const std::vector<std::string>& labels) {
    if (labels.empty()) return -1;  // a dimension of length 0 would mean unlimited
    const int id = file_.dimension(name, labels.size());
    file_.put(file_.variable(name, says, "", {id}, Stored::text), labels);
    return id;
  }
  int numbers(const char* name, const char* says, const char* unit,
              const std::vector<double>& values, Stored stored = Stored::number) {
    if (values.empty()) return -1;
    const int id = file_.dimension(name, values.size());
    file_.put(file_.variable(name, says, unit, {id}, stored, true), values);
    return id;
  }
  int counted(const char* name, const char* says, std::size_t size) {
    std::vector<double> values(size);
    std::iota(values.begin(), values.end(), 0.0);
    return numbers(name, says, "1", values, Stored::integer);
  }

  void define_axes() {
    std::vector<std::string> inputs, estimators;
    for (const InputConfig& one : study_.inputs) inputs.push_back(one.id);
    for (const EstimatorConfig& one : study_.estimators) estimators.push_back(one.id);
    input_ = names("input", "id of the input", inputs);
    estimator_ = names("estimator", "id of the estimator", estimators);
    amplitude_ =
        numbers("amplitude", "amplitude of the output's motion", "degree", axes_.amplitudes);
    frequency_ = numbers("frequency", "frequency of the output's motion", "Hz", axes_.frequencies);
    replicate_ = counted("replicate", "number of the replicate",
                         static_cast<std::size_t>(study_.replicates));
    parameter_ = names("parameter", "name of the parameter", axes_.parameters);
    row_ = counted("row", "number of the row", axes_.rows);
    if (swept()) define_variants();
  }

  /// A coordinate for every key that is swept: what it was at each variant.
  void define_variants() {
    variant_ =
        counted("variant", "number of the variant: a point of every sweep", variants_of(study_));
    for (std::size_t s = 0; s < study_.sweeps.size(); ++s) {
      const SweepAxis& sweep = study_.sweeps[s];
      for (std::size_t k = 0; k < sweep.keys.size(); ++k) define_swept(s, k);
    }
  }

  void define_swept(std::size_t s, std::size_t k) {
    const SweepAxis& sweep = study_.sweeps[s];
    const SweepKey& key = sweep.keys[k];
    const bool words = std::holds_alternative<std::string>(sweep.points.front()[k]);
    const int id = file_.variable("sweep_" + key.path, "value of " + key.path, key.unit, {variant_},
                                  words ? Stored::text : Stored::number);
    RowVariable column(file_, id);
    for (std::size_t v = 0; v < variants_of(study_); ++v) {
      const SweepValue& value = sweep.points[point_of(study_, v)[s]][k];
      if (const auto* word = std::get_if<std::string>(&value))
        column.add(*word);
      else if (const auto* whole = std::get_if<std::int64_t>(&value))
        column.add(double(*whole));
      else if (const auto* flag = std::get_if<bool>(&value))
        column.add(*flag ? 1.0 : 0.0);
      else
        column.add(std::get<double>(value));
    }
    column.flush();
  }

  void define_block(const std::string& name, const std::string& says, const std::string& unit,
                    std::vector<int> dimensions, std::vector<std::size_t> extent) {
    if (swept()) dimensions.insert(dimensions.begin(), variant_);
    blocks_.emplace_back(file_, file_.variable(name, says, unit, dimensions), std::move(extent),
                         swept());
  }

  void define_errors() {
    has_grid_ = amplitude_ >= 0;
    if (!has_grid_) return;
    const std::vector<int> dimensions = {input_, estimator_, amplitude_, frequency_, replicate_};
    const std::vector<std::size_t> extent = {study_.inputs.size(), study_.estimators.size(),
                                             axes_.amplitudes.size(), axes_.frequencies.size(),
                                             static_cast<std::size_t>(study_.replicates)};
    define_block("error_percent", "hold-out rms error of torque (force), of the recording's peak",
                 "percent", dimensions, extent);
    define_block("error", "hold-out rms error of the torque", "N m", dimensions, extent);
  }

  void define_parameters() {
    if (parameter_ < 0) return;
    const std::vector<int> dimensions = {input_, estimator_, replicate_, parameter_};
    const std::vector<std::size_t> extent = {study_.inputs.size(), study_.estimators.size(),
                                             static_cast<std::size_t>(study_.replicates),
                                             axes_.parameters.size()};
    define_block("parameter_value", "estimates, in the units of parameter_unit", "", dimensions,
                 extent);
    define_block("parameter_std", "standard deviations of the estimates, in the same units", "",
                 dimensions, extent);
    const int units = file_.variable("parameter_unit", "units of the estimates", "",
                                     {input_, estimator_, parameter_}, Stored::text);
    file_.put(units, axes_.units);
  }

  void define_numbers() {
    for (const std::string& name : axes_.numbers) {
      define_block("case_" + name, name + " of the case (docs/artefacts.md)", unit_of_number(name),
                   {input_, estimator_, replicate_},
                   {study_.inputs.size(), study_.estimators.size(),
                    static_cast<std::size_t>(study_.replicates)});
    }
  }

  void define_rows() {
    if (row_ < 0) return;
    const auto add = [&](const char* name, const char* says, const char* unit, Stored stored) {
      of_rows_.emplace_back(file_, file_.variable(name, says, unit, {row_}, stored));
    };
    add("row_case", "key of the case", "", Stored::text);
    add("row_recording", "id of the recording", "", Stored::text);
    add("row_role", "train or holdout", "", Stored::text);
    add("row_error_percent", "rms error of torque (force), of the recording's peak", "percent",
        Stored::number);
    add("row_error", "rms error of torque (force), in the unit of row_error_unit", "",
        Stored::number);
    add("row_error_unit", "unit of the torque or force", "", Stored::text);
  }

  /// Offset of a case's number in a block of (input, estimator, …).
  double& in(BlockVariable& block, const CasePlan& one, std::initializer_list<std::size_t> rest) {
    const auto& extent = block.extent();
    std::size_t offset = input_index(study_, one) * extent[1] + estimator_index(study_, one);
    std::size_t axis = 2;
    for (const std::size_t index : rest) offset = offset * extent[axis++] + index;
    return block.at(one.variant)[offset];
  }

  void add_errors(const CasePlan& one, const CaseRow& row) {
    if (!has_grid_) return;
    const auto replicate = static_cast<std::size_t>(one.replicate);
    for (const CaseRow::Recording& recording : row.recordings) {
      if (!on_grid(one, recording)) continue;
      const std::size_t a = index_in(axes_.amplitudes, tidy(recording.amplitude));
      const std::size_t f = index_in(axes_.frequencies, tidy(recording.frequency_hz));
      in(blocks_[0], one, {a, f, replicate}) = recording.error_percent;
      in(blocks_[1], one, {a, f, replicate}) = recording.error;
    }
  }

  void add_parameters(const CasePlan& one, const CaseRow& row) {
    const std::size_t first = has_grid_ ? 2 : 0;
    const auto replicate = static_cast<std::size_t>(one.replicate);
    for (const CaseRow::Parameter& parameter : row.parameters) {
      const std::size_t p = index_in(axes_.parameters, parameter.name);
      in(blocks_[first], one, {replicate, p}) = parameter.value;
      in(blocks_[first + 1], one, {replicate, p}) = parameter.std;
    }
  }

  void add_numbers(const CasePlan& one, const CaseRow& row) {
    const std::size_t first = (has_grid_ ? 2U : 0U) + (parameter_ >= 0 ? 2U : 0U);
    for (std::size_t n = 0; n < axes_.numbers.size(); ++n) {
      in(blocks_[first + n], one, {static_cast<std::size_t>(one.replicate)}) =
          row.number(axes_.numbers[n]);
    }
  }

  void add_rows(const CasePlan& one, const CaseRow& row) {
    for (const CaseRow::Recording& recording : row.recordings) {
      of_rows_[0].add(one.key);
      of_rows_[1].add(recording.id);
      of_rows_[2].add(recording.role);
      of_rows_[3].add(recording.error_percent);
      of_rows_[4].add(recording.error);
      of_rows_[5].add(std::string(row.linear ? "N" : "N m"));
    }
  }

  const StudyRows& rows_;
  const StudyConfig& study_;
  NetcdfFile& file_;
  ResultsAxes axes_;
  int input_ = -1, estimator_ = -1, amplitude_ = -1, frequency_ = -1, replicate_ = -1,
      parameter_ = -1, row_ = -1, variant_ = -1;
  bool has_grid_ = false;
  std::vector<BlockVariable> blocks_;  ///< errors, parameters, numbers, as far as there are any
  std::vector<RowVariable> of_rows_;
};

}  // namespace

Result<void> write_results(const StudyRows& rows,
                           const std::map<std::string, std::string>& versions,
                           const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "results.nc";
  UnfinishedFile half(path);
  NetcdfFile file(half.path());
  for (const auto& [name, value] : provenance(rows.plan(), versions)) file.text(name, value);
  ResultsWriter(rows, file)();
  const std::string problem = file.close();
  const std::error_code error = problem.empty() ? half.finish() : std::error_code{};
  if (problem.empty() && !error) return {};
  return failure(ErrorCode::cannot_write,
                 fmt::format("{} cannot be written: {}", path.string(),
                             problem.empty() ? error.message() : problem),
                 "choose a folder that can be written");
}

}  // namespace flexspline::studies
