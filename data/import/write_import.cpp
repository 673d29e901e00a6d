#include <fmt/format.h>

#include <algorithm>

#include "flexspline/core/write_file.hpp"
#include "flexspline/data/import.hpp"
#include "import/import_parts.hpp"
#include "import/joined_rows.hpp"
#include "import/recording_rows.hpp"
#include "import/short_names.hpp"
#include "readers/toml_text.hpp"

namespace flexspline::data {
namespace {

/// Passes the wanted columns of one table of a file on, row by row.
class RowSink : public TableSink {
 public:
  RowSink(const FoundTable& table, RecordingRows& rows) : table_(table), rows_(rows) {
    for (const FoundChannel& one : table.channels) wanted_.push_back(one.column);
    std::ranges::sort(wanted_);
    for (const FoundChannel& one : table.channels) {
      places_.push_back(
          static_cast<std::size_t>(std::ranges::find(wanted_, one.column) - wanted_.begin()));
    }
  }

  std::vector<std::size_t> begin(const TableHead&) override {
    return index_++ == table_.survey.index ? wanted_ : std::vector<std::size_t>{};
  }

  void rows(std::span<const std::vector<double>> columns) override {
    row_.resize(places_.size());
    for (std::size_t i = 0; i < columns[0].size(); ++i) {
      for (std::size_t c = 0; c < places_.size(); ++c) row_[c] = columns[places_[c]][i];
      rows_.add(row_);
    }
  }

  void note(const std::string&) override {}

 private:
  const FoundTable& table_;
  RecordingRows& rows_;
  std::vector<std::size_t> wanted_;
  std::vector<std::size_t> places_;
  std::vector<double> row_;
  std::size_t index_ = 0;
};

Result<void> read_rows(const FoundTable& table, const TableRequest& request, RecordingRows& rows,
                       std::vector<std::string>& notes) {
  if (table.survey.parts.empty()) {
    RowSink sink(table, rows);
    return read_tables(table.survey.file, request, sink);
  }
  JoinedRows sink(table, request.limits, rows);
  if (auto read = read_tables(table.survey.file, request, sink); !read) return read;
  if (auto joined = sink.join(); !joined) return joined;
  for (std::string& note : sink.notes()) notes.push_back(std::move(note));
  return {};
}

/// A text in a comment: one line, whatever stands in it.
std::string comment(const std::string& text) {
  std::string line = "# " + text;
  std::ranges::replace_if(
      line, [](unsigned char letter) { return letter < 0x20 || letter == 0x7F; }, ' ');
  return line + "\n";
}

std::string head_text(const ImportPlan& plan, const std::vector<std::string>& done) {
  std::string text =
      comment("Made by flexspline import. What was found out, how sure it is, and by what:");
  for (const Inference& one : plan.inferred) {
    text += comment(fmt::format("  {} ({}: {})", one.what, name_of(one.certainty), one.evidence));
  }
  for (const auto* list : {&plan.notes, &done}) {
    for (const std::string& note : *list) text += comment("  " + note);
  }
  text += comment(
      "Correct it here: sign, scale and offset of a channel, constants, names; then flexspline "
      "validate.");
  text += fmt::format("schema = \"flexspline-dataset/1\"\nname = {}\nrig = \"{}\"\n",
                      toml_quoted(plan.wish.name), name_of(*plan.rig));
  text += plan.wish.license.empty()
              ? std::string("# license = \"CC0-1.0\"  # SPDX id: add it before sharing\n")
              : fmt::format("license = {}\n", toml_quoted(plan.wish.license));
  std::string source;
  for (const auto& file : plan.wish.files)
    source += (source.empty() ? "" : ", ") + file.filename().string();
  text += fmt::format("source = {}\n", toml_quoted(source));
  if (!plan.wish.accept.empty()) {
    std::string codes;
    for (const std::string& code : plan.wish.accept)
      codes += (codes.empty() ? "" : ", ") + toml_quoted(code);
    text += fmt::format("accept = [{}]  # findings that are no mistake here\n", codes);
  }
  return text;
}

std::string constants_text(const ImportPlan& plan) {
  std::string text = "\n[constants]\n";
  for (const auto& [name, value] : plan.constants) {
    text += fmt::format("{} = {}\n", toml_quoted(name), toml_number(value));
  }
  if (*plan.rig == Rig::locked || *plan.rig == Rig::free) {
    if (!plan.constants.contains("motor_inertia_kgm2")) {
      text += "# motor_inertia_kgm2 = …  # motor and wave generator\n";
    }
    if (*plan.rig == Rig::free && !plan.constants.contains("load_inertia_kgm2")) {
      text += "# load_inertia_kgm2 = …\n";
    }
  }
  return text;
}

std::string channels_text(const ImportParts& parts) {
  std::string text = "\n[channels]\n";
  bool has_valid = false;
  for (const FoundChannel& one : parts.channels) {
    has_valid = has_valid || one.quantity == Quantity::valid;
    text += fmt::format("{} = {{ quantity = \"{}\", unit = \"{}\"", short_name(one.quantity),
                        name_of(one.quantity), one.unit.symbol);
    if (one.counts_per_rev > 0.0) {
      text += fmt::format(", counts_per_rev = {}", toml_number(one.counts_per_rev));
    }
    if (one.sign < 0.0) text += ", sign = -1";
    text += " }\n";
  }
  if (parts.marks_absent && !has_valid) {
    text += "valid = { quantity = \"valid\", unit = \"1\" }  # 0: a cell of the row was absent\n";
  }
  return text;
}

/// In s from the earliest, by the clocks of the files.
std::vector<double> starts_of(const ImportParts& parts,
                              const std::vector<std::vector<WrittenRecording>>& written) {
  std::vector<double> starts;
  for (std::size_t t = 0; t < parts.tables.size(); ++t) {
    const FoundTable& table = parts.tables[t];
    const auto& epoch = table.survey.columns[table.channels[0].column].column.epoch_s;
    for (const WrittenRecording& one : written[t])
      starts.push_back(one.start_s + epoch.value_or(0.0));
  }
  const double earliest = starts.empty() ? 0.0 : std::ranges::min(starts);
  for (double& start : starts) start -= earliest;
  return starts;
}

}  // namespace

Result<Imported> write_import(const ImportPlan& plan, const std::filesystem::path& folder) {
  expects(plan.open.empty() && plan.rig && plan.parts,
          "a plan that is written has no open question");
  std::error_code error;
  std::filesystem::create_directories(folder, error);  // what fails is told by the first file
  const ImportParts& parts = *plan.parts;
  std::vector<std::vector<WrittenRecording>> written;
  Imported imported;
  for (const FoundTable& table : parts.tables) {
    RecordingRows rows(table, parts, plan.wish.split_s, folder);
    if (auto read = read_rows(table, plan.wish.request, rows, imported.notes); !read) {
      return tl::unexpected(read.error());
    }
    if (auto same = table.survey.check_same_file(); !same) return tl::unexpected(same.error());
    if (auto done = rows.finish(); !done) return tl::unexpected(done.error());
    written.push_back(rows.recordings());
    for (std::string& note : rows.notes()) imported.notes.push_back(std::move(note));
  }
  std::string text = head_text(plan, imported.notes) + constants_text(plan) + channels_text(parts);
  const std::vector<double> starts = starts_of(parts, written);
  std::size_t index = 0;
  for (const auto& recordings : written) {
    for (const WrittenRecording& one : recordings) {
      text +=
          fmt::format("\n[[recording]]  # {} rows\nid = {}\nfile = {}\nstart_s = {}\n", one.rows,
                      toml_quoted(one.id), toml_quoted(one.file), toml_number(starts[index++]));
      imported.files.push_back(one.file);
      imported.recordings.push_back(one.id);
    }
  }
  if (imported.recordings.empty()) {
    return failure(ErrorCode::bad_data, "no recording of 16 rows is left",
                   "take --split away, or give a longer one");
  }
  if (auto done = write_file(folder / "dataset.toml", text); !done)
    return tl::unexpected(done.error());
  imported.files.emplace_back("dataset.toml");
  return imported;
}

}  // namespace flexspline::data
