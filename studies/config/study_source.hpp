#pragma once

#include <filesystem>
#include <string>

#include <toml++/toml.h>

#include "config/sweep_design.hpp"
#include "config/toml_section.hpp"
#include "flexspline/studies/study_config.hpp"

namespace flexspline::studies {

struct StudySource {
  toml::table root;
  std::filesystem::path file;
  std::filesystem::path data_root;
  std::filesystem::path model_root;
  std::string text;  ///< of the file
};

/// Reads every table of a study; what is wrong goes to the section's findings.
StudyConfig read_tables(TomlSection& root, const StudySource& source);

/// A study's text as if it lay in that file.
StudyReading read_study_text(const std::string& text, const std::filesystem::path& file,
                             const std::filesystem::path& data_root,
                             const std::filesystem::path& model_root);

/// The [[sweep]] tables.
void read_sweeps(TomlSection& root, StudyConfig& study);

/// Refuses sweeps that make a study of any of their points that cannot be: every point of every
/// sweep, up to the first hundreds, with the others at their beginning.
void check_sweeps(TomlSection& root, const StudyConfig& study);

/// Values of one key as a sweep gives them: values, linspace or logspace. Nothing after a refusal.
std::vector<SweepValue> read_sweep_values(TomlSection& section, SweepKey& key);

/// Keys with ranges, sampled together: `keys` of a table, each { key, from, to, unit, log }.
struct SweepRange {
  SweepKey key;
  double from = 0.0;
  double to = 1.0;
  bool log = false;

  /// Of u in [0, 1].
  SweepValue at(double u) const;
};
std::vector<SweepRange> read_sweep_ranges(TomlSection& section);

}  // namespace flexspline::studies
