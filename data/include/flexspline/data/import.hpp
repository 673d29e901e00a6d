#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "flexspline/core/error.hpp"
#include "flexspline/core/recording.hpp"
#include "flexspline/core/units.hpp"
#include "flexspline/data/table_reader.hpp"

namespace flexspline::data {

/// "tau=col4:Nm", "theta_m=Motorwinkel:-deg", "theta_l=q:counts/4096", "tau_m=none": what a person
/// says that a column is.
struct ColumnChoice {
  Quantity quantity = Quantity::time;
  std::string column;  ///< its name, or colN; empty: there is none
  std::optional<Unit> unit;
  double counts_per_rev = 0.0;
  double sign = 1.0;
};

/// t, theta_m, theta_l, tau and tau_m stand for their quantities. Errors: usage.
Result<ColumnChoice> parse_column_choice(std::string_view text);

/// What is to be made into a data set, and what a person states of it.
struct ImportWish {
  std::vector<std::filesystem::path> files;
  std::optional<Rig> rig;
  std::map<std::string, double> constants;
  std::vector<ColumnChoice> choices;
  std::vector<std::string> tables;  ///< paths inside the files; empty: all that fit
  bool join = false;                ///< tables of a file are of one recording
  std::optional<double> split_s;    ///< rests and pauses of so long end a recording
  std::vector<std::string> accept;  ///< codes of findings that are no mistake here
  std::string name;
  std::string license;
  TableRequest request;
};

enum class Certainty { stated, sure, likely };
std::string_view name_of(Certainty certainty);

/// Something that was found out, and by what.
struct Inference {
  std::string what;
  Certainty certainty = Certainty::sure;
  std::string evidence;
};

/// Something that could not be found out, and the option that states it.
struct OpenQuestion {
  std::string problem;
  std::string remedy;
};

struct ImportParts;  ///< which column of which table becomes what

/// What an import would write. Only a plan without open questions can be written.
struct ImportPlan {
  ImportWish wish;
  std::optional<Rig> rig;
  std::map<std::string, double> constants;
  std::vector<Inference> inferred;
  std::vector<std::string> notes;
  std::vector<OpenQuestion> open;
  std::shared_ptr<const ImportParts> parts;
};

/// Reads the files once. Errors: a file that cannot be read.
Result<ImportPlan> plan_import(const ImportWish& wish);

/// What was written: names of files in the folder, dataset.toml last, and what was done to rows.
struct Imported {
  std::vector<std::string> files;
  std::vector<std::string> recordings;
  std::vector<std::string> notes;
};

/// Reads the files again, by pieces, and writes one CSV a recording and a commented dataset.toml.
/// The same files and wish write the same bytes. Errors: cannot_write; bad_data, where time falls.
Result<Imported> write_import(const ImportPlan& plan, const std::filesystem::path& folder);

}  // namespace flexspline::data
