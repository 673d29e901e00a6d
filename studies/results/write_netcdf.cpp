#include <map>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <netcdf.h>

#include "flexspline/core/write_file.hpp"
#include "flexspline/data/checksum.hpp"
#include "flexspline/studies/results.hpp"
#include "results/results_table.hpp"

namespace flexspline::studies {
namespace {

/// The only place that names netCDF. Remembers the first failure and does nothing after it.
class NetcdfFile {
 public:
  explicit NetcdfFile(const std::filesystem::path& path) {
    check(nc_create(path.c_str(), NC_NETCDF4 | NC_CLOBBER, &file_));
    open_ = status_ == NC_NOERR;
  }
  ~NetcdfFile() { close(); }
  NetcdfFile(const NetcdfFile&) = delete;
  NetcdfFile& operator=(const NetcdfFile&) = delete;

  int dimension(const std::string& name, std::size_t size) {
    int id = 0;
    if (ok()) check(nc_def_dim(file_, name.c_str(), size, &id));
    return id;
  }
  void text(int variable, const char* key, const std::string& value) {
    if (ok() && !value.empty())
      check(nc_put_att_text(file_, variable, key, value.size(), value.c_str()));
  }
  /// CF: a coordinate has no missing values, so that _FillValue is for the others.
  void coordinate(const Axis& axis, int dimension) {
    variable({axis.name, axis.says, axis.unit, {}, axis.values, axis.labels}, {dimension},
             axis.integer ? NC_INT : NC_DOUBLE, false);
  }
  void variable(const Variable& one, const std::vector<int>& dimensions, nc_type type = NC_DOUBLE,
                bool may_be_missing = true) {
    if (!ok()) return;
    int id = 0;
    const bool numbers = one.labels.empty();
    check(nc_def_var(file_, one.name.c_str(), numbers ? type : NC_STRING,
                     static_cast<int>(dimensions.size()), dimensions.data(), &id));
    if (ok() && numbers && may_be_missing) check(nc_def_var_fill(file_, id, NC_FILL, &kNone));
    text(id, "long_name", one.says);
    text(id, "units", one.unit);
    if (!ok()) return;
    if (numbers) {
      check(nc_put_var_double(file_, id, one.values.data()));
      return;
    }
    std::vector<const char*> words;
    for (const std::string& label : one.labels) words.push_back(label.c_str());
    check(nc_put_var_string(file_, id, words.data()));
  }
  /// Empty where all went well.
  std::string close() {
    if (open_) check(nc_close(file_));
    open_ = false;
    return ok() ? "" : nc_strerror(status_);
  }

 private:
  bool ok() const { return status_ == NC_NOERR; }
  void check(int status) {
    if (ok()) status_ = status;
  }

  int file_ = 0;
  int status_ = NC_NOERR;
  bool open_ = false;
};

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

std::string write_table(const ResultsTable& table, const Attributes& attributes,
                        const std::filesystem::path& path) {
  NetcdfFile file(path);
  for (const auto& [name, value] : attributes) file.text(NC_GLOBAL, name, value);
  std::vector<int> dimensions;
  for (const Axis& axis : table.axes) {
    // A dimension of length 0 would mean unlimited.
    dimensions.push_back(axis.size() > 0 ? file.dimension(axis.name, axis.size()) : -1);
    if (axis.size() > 0) {
      file.coordinate(axis, dimensions.back());
    }
  }
  for (const Variable& variable : table.variables) {
    if (variable.values.empty() && variable.labels.empty()) continue;
    std::vector<int> own;
    for (const std::size_t axis : variable.axes) own.push_back(dimensions[axis]);
    file.variable(variable, own);
  }
  return file.close();
}

}  // namespace

Result<void> write_results(const StudyPlan& plan, std::span<const std::optional<CaseRow>> rows,
                           const std::map<std::string, std::string>& versions,
                           const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "results.nc";
  UnfinishedFile file(path);
  const std::string problem =
      write_table(gather_results(plan, rows), provenance(plan, versions), file.path());
  const std::error_code error = problem.empty() ? file.finish() : std::error_code{};
  if (problem.empty() && !error) return {};
  return failure(ErrorCode::cannot_write,
                 fmt::format("{} cannot be written: {}", path.string(),
                             problem.empty() ? error.message() : problem),
                 "choose a folder that can be written");
}

}  // namespace flexspline::studies
