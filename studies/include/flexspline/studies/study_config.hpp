#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "flexspline/core/error.hpp"
#include "flexspline/data/bench.hpp"
#include "flexspline/data/dataset.hpp"
#include "flexspline/estimators/method.hpp"

namespace flexspline::studies {

/// One sine of the locked-rotor experiment, at the output.
struct Loop {
  double amplitude = 0.0;  ///< rad
  double frequency_hz = 0.0;

  friend bool operator==(const Loop&, const Loop&) = default;
};

/// "a0.2000-f0.00500": amplitude in degrees, frequency in hertz.
std::string recording_id(const Loop& loop);

/// A named set of loops: amplitudes x frequencies, or a list.
struct Grid {
  std::string id;
  std::vector<Loop> loops;
};

/// How the virtual bench records every input that has a truth.
struct BenchConfig {
  data::BenchSensors sensors;
  int cycles = 5;  ///< the first of them runs up from rest
  int samples_per_cycle = 500;
};

/// Where recordings come from: a truth of the virtual bench, or a folder in the data-set format.
struct InputConfig {
  std::string id;
  std::string title;
  std::string truth;              ///< id in the catalogue of truths; empty for a data set
  std::filesystem::path dataset;  ///< as found, relative paths already resolved
  std::string holdout;            ///< id of the grid that is evaluated and never trained on
  /// Of a data set: exactly these recordings are held out, whatever it marks itself.
  std::optional<std::vector<std::string>> held_out{};
  std::size_t rows = data::kMostRows;        ///< of a data set: at most, of a recording; 0: all
  std::optional<BenchConfig> bench{};        ///< of a truth: instead of the study's
  std::map<std::string, double> strength{};  ///< of a truth: factors of its parts
};

/// What an estimator of a study trains on, of a data set.
inline constexpr std::string_view kTrainAll = "all";  ///< every training recording
inline constexpr std::string_view kTrainOne = "one";  ///< the one with the largest motion

/// A method with its options and its training recordings.
struct EstimatorConfig {
  std::string id;
  std::string title;
  std::string method;
  std::string train = std::string(kTrainAll);  ///< id of a grid, or kTrainAll, or kTrainOne
  bool steady = false;  ///< bench: no residuals in the run-up, which only carries the state along
  estimators::Options options;
  std::vector<std::string> inputs;                ///< only these; empty: all
  std::optional<estimators::GivenModel> model{};  ///< for methods that take one
  /// Of one that a kind made out of another: id of the estimator as the study file has it.
  std::string made_from{};

  const std::string& written_id() const { return made_from.empty() ? id : made_from; }
};

/// One step of an ablation: two estimators that differ in one respect.
struct ContrastConfig {
  std::string id;
  std::string title;  ///< what the second has that the first has not
  std::string from;   ///< ids of estimators
  std::string to;
};

/// What a sweep writes in the place of a value of the study file.
using SweepValue = std::variant<double, std::int64_t, bool, std::string>;

/// A key of the study file that takes several values: "bench.cycles",
/// "estimator.<id>.options.samples"; `*` stands for every id.
struct SweepKey {
  std::string path;
  std::string unit;  ///< empty: a plain number or word
};

/// Keys that are set together, point by point.
struct SweepAxis {
  std::string id;
  std::vector<SweepKey> keys;
  std::vector<std::vector<SweepValue>> points;  ///< a value a key
};

/// What a kind was told in its own table, for its answer.
struct KindSettings {
  std::map<std::string, double> numbers;
  std::map<std::string, std::string> words;
  std::map<std::string, std::vector<double>> lists;
  std::map<std::string, std::vector<std::string>> names;
};

/// The study file as it was parsed: what variants are made from.
struct StudySource;

/// A study as read and understood. SI units.
struct StudyConfig {
  std::filesystem::path file;
  std::string name;
  std::string title;
  std::string kind = "grid";  ///< id of a row of studies/kinds
  std::uint64_t seed = 1;
  int replicates = 1;
  bool paper = false;  ///< recompute the facts of Dhaouadi and Ghorbel (2003) beside the cases
  BenchConfig bench;
  std::vector<Grid> grids;
  std::vector<InputConfig> inputs;
  std::vector<EstimatorConfig> estimators;
  std::vector<ContrastConfig> contrasts;
  std::vector<SweepAxis> sweeps;  ///< their product
  KindSettings settings;
  std::shared_ptr<const StudySource> source{};  ///< null for studies that no file describes

  const Grid* find_grid(std::string_view id) const;
  const InputConfig* find_input(std::string_view id) const;
  /// How the virtual bench records an input.
  const BenchConfig& bench_of(const InputConfig& input) const {
    return input.bench ? *input.bench : bench;
  }
};

/// A study as far as it could be read: everything wrong at once.
struct StudyReading {
  std::optional<StudyConfig> study;  ///< present only when there are no errors
  std::vector<data::Finding> errors;
};

/// Reads a study of format "flexspline-study/1" (docs/study-file.md). Relative data-set paths start
/// at data_root, or at the study file's folder where it is empty.
/// Errors: input_missing when the file cannot be read. What is wrong in it is in the reading.
Result<StudyReading> read_study(const std::filesystem::path& file,
                                const std::filesystem::path& data_root = {});

/// The same for callers that go no further on a failure.
/// Errors: input_missing, or bad_data with every finding.
Result<StudyConfig> load_study(const std::filesystem::path& file,
                               const std::filesystem::path& data_root = {});

/// How many studies the sweeps make of one: the product of their points, 1 without any.
std::size_t variants_of(const StudyConfig& study);

/// Which point of every sweep a variant stands at; the last sweep runs fastest.
std::vector<std::size_t> point_of(const StudyConfig& study, std::size_t variant);

/// The study with the values of a variant in the places that the sweeps name. Variant 0 stands at
/// the first point of every sweep. Errors: bad_data, where a value cannot stand there.
Result<StudyConfig> variant_study(const StudyConfig& study, std::size_t variant);

/// The configuration as understood, as TOML with every default written out.
std::string describe_study(const StudyConfig& study);

}  // namespace flexspline::studies
