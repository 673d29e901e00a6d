#include <algorithm>

#include <fmt/format.h>

#include "flexspline/core/nearest_name.hpp"
#include "flexspline/core/write_file.hpp"

#include "config/study_reader.hpp"
#include "config/study_source.hpp"
#include "config/toml_root.hpp"
#include "flexspline/studies/kind.hpp"

namespace flexspline::studies {
namespace {

constexpr std::string_view kSchema = "flexspline-study/1";

void read_head(TomlSection& root, StudyConfig& study) {
  check_schema(root, kSchema);
  study.name = root.required_text("name");
  study.title = root.text("title").value_or(study.name);
  study.kind = root.text("kind").value_or(study.kind);
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

/// The kind's own table, by its name, and what it makes of the study.
void read_kind(TomlSection& root, StudyConfig& study) {
  static_cast<void>(root.node(study.kind));
  const KindRow* row = find_kind(study.kind);
  if (row == nullptr) {
    std::vector<std::string_view> names;
    for (const KindRow& one : kinds()) names.push_back(one.id);
    return root.refuse("kind", fmt::format("there is no kind of study '{}'", study.kind),
                       suggestion(study.kind, names));
  }
  if (row->schema != kSchema) {
    return root.refuse("kind",
                       fmt::format("a study of kind '{}' has a file of its own form", row->id),
                       fmt::format("write schema = \"{}\", and leave kind out", row->schema));
  }
  if (row->read == nullptr || !root.clean()) return;
  static const toml::table nothing;
  auto own = root.table(study.kind);
  TomlSection section = own ? *own : root.absent(study.kind, nothing);
  row->read(section, study);
  section.refuse_unknown_keys();
}

}  // namespace

const KindRow* find_kind(std::string_view id) {
  const auto row = std::ranges::find(kinds(), id, &KindRow::id);
  return row == kinds().end() ? nullptr : &*row;
}

StudyConfig read_tables(TomlSection& root, const StudySource& source) {
  StudyConfig study;
  read_head(root, study);
  if (auto bench = root.table("bench")) study.bench = read_bench(*bench);
  read_rows(root, "grid", study.grids, read_grid);
  read_rows(root, "input", study.inputs,
            [&](TomlSection& s) { return read_input(s, study, source.data_root); });
  read_rows(root, "estimator", study.estimators,
            [&](TomlSection& s) { return read_estimator(s, study, source.model_root); });
  read_rows(root, "contrast", study.contrasts,
            [&](TomlSection& s) { return read_contrast(s, study); });
  if (study.inputs.empty()) root.refuse("input", "the study has no input", "add an [[input]]");
  if (study.estimators.empty()) {
    root.refuse("estimator", "the study has no estimator", "add an [[estimator]]");
  }
  read_sweeps(root, study);
  read_kind(root, study);
  root.refuse_unknown_keys();
  return study;
}

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
  const auto text = read_file(file);
  if (!text) return tl::unexpected(text.error());
  return read_study_text(*text, file, data_root.empty() ? file.parent_path() : data_root,
                         file.parent_path());
}

StudyReading read_study_text(const std::string& text, const std::filesystem::path& file,
                             const std::filesystem::path& data_root,
                             const std::filesystem::path& model_root) {
  StudyConfig study;
  StudyReading reading;
  reading.errors = read_toml_text(text, file, [&](TomlSection& root) {
    auto source =
        std::make_shared<StudySource>(StudySource{root.raw(), file, data_root, model_root, text});
    study = read_tables(root, *source);
    study.file = file;
    study.source = std::move(source);
    if (root.clean()) check_sweeps(root, study);
  });
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
