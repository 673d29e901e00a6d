#include <algorithm>

#include <fmt/format.h>

#include "config/study_reader.hpp"
#include "config/toml_root.hpp"

namespace flexspline::studies {
namespace {

constexpr std::string_view kSchema = "flexspline-study/1";

void read_head(TomlSection& root, StudyConfig& study) {
  check_schema(root, kSchema);
  study.name = root.required_text("name");
  study.title = root.text("title").value_or(study.name);
  constexpr std::int64_t kLargestSeed = 1LL << 53;
  study.seed = static_cast<std::uint64_t>(root.integer("seed", 0, kLargestSeed).value_or(1));
  study.replicates = static_cast<int>(root.integer("replicates", 1, 10000).value_or(1));
  study.paper = root.flag("paper").value_or(false);
}

/// Reads the tables of one list; read gives the row of one table.
template <class Row, class Read>
void read_rows(TomlSection& root, std::string_view key, std::vector<Row>& rows, const Read& read) {
  std::vector<std::string> ids;
  for (TomlSection& section : root.tables(key)) {
    Row row = read(section);
    if (!row.id.empty()) check_id(section, row.id, ids);
    ids.push_back(row.id);
    rows.push_back(std::move(row));
  }
}

StudyConfig read_tables(TomlSection& root, const std::filesystem::path& data_root,
                        const std::filesystem::path& model_root) {
  StudyConfig study;
  read_head(root, study);
  if (auto bench = root.table("bench")) study.bench = read_bench(*bench);
  read_rows(root, "grid", study.grids, read_grid);
  read_rows(root, "input", study.inputs,
            [&](TomlSection& s) { return read_input(s, study, data_root); });
  read_rows(root, "estimator", study.estimators,
            [&](TomlSection& s) { return read_estimator(s, study, model_root); });
  read_rows(root, "contrast", study.contrasts,
            [&](TomlSection& s) { return read_contrast(s, study); });
  if (study.inputs.empty()) root.refuse("input", "the study has no input", "add an [[input]]");
  if (study.estimators.empty()) {
    root.refuse("estimator", "the study has no estimator", "add an [[estimator]]");
  }
  root.refuse_unknown_keys();
  return study;
}

}  // namespace

const Grid* StudyConfig::find_grid(std::string_view id) const {
  const auto found = std::ranges::find(grids, id, &Grid::id);
  return found == grids.end() ? nullptr : &*found;
}

const InputConfig* StudyConfig::find_input(std::string_view id) const {
  const auto found = std::ranges::find(inputs, id, &InputConfig::id);
  return found == inputs.end() ? nullptr : &*found;
}

Result<StudyReading> read_study(const std::filesystem::path& file,
                                const std::filesystem::path& data_root) {
  StudyConfig study;
  auto findings = read_toml_root(file, [&](TomlSection& root) {
    study =
        read_tables(root, data_root.empty() ? file.parent_path() : data_root, file.parent_path());
  });
  if (!findings) return tl::unexpected(findings.error());
  StudyReading reading{std::nullopt, *std::move(findings)};
  study.file = file;
  if (reading.errors.empty()) reading.study = std::move(study);
  return reading;
}

Result<StudyConfig> load_study(const std::filesystem::path& file,
                               const std::filesystem::path& data_root) {
  Result<StudyReading> reading = read_study(file, data_root);
  if (!reading) return tl::unexpected(reading.error());
  if (!reading->study) return tl::unexpected(as_error(reading->errors));
  return std::move(*reading->study);
}

}  // namespace flexspline::studies
