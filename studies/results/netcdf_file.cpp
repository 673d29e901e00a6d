#include "results/netcdf_file.hpp"

#include <netcdf.h>

namespace flexspline::studies {
namespace {

std::vector<const char*> pointers(std::span<const std::string> words) {
  std::vector<const char*> list;
  list.reserve(words.size());
  for (const std::string& word : words) list.push_back(word.c_str());
  return list;
}

nc_type type_of(Stored stored) {
  if (stored == Stored::text) return NC_STRING;
  return stored == Stored::integer ? NC_INT : NC_DOUBLE;
}

}  // namespace

NetcdfFile::NetcdfFile(const std::filesystem::path& path) {
  check(nc_create(path.c_str(), NC_NETCDF4 | NC_CLOBBER, &file_));
  open_ = ok();
}

void NetcdfFile::attribute(int variable, const std::string& key, const std::string& value) {
  if (ok() && !value.empty())
    check(nc_put_att_text(file_, variable, key.c_str(), value.size(), value.c_str()));
}

void NetcdfFile::text(const std::string& key, const std::string& value) {
  attribute(NC_GLOBAL, key, value);
}

int NetcdfFile::dimension(const std::string& name, std::size_t size) {
  int id = 0;
  if (ok()) check(nc_def_dim(file_, name.c_str(), size, &id));
  return id;
}

int NetcdfFile::variable(const std::string& name, const std::string& says, const std::string& unit,
                         const std::vector<int>& dimensions, Stored stored, bool coordinate) {
  int id = 0;
  if (!ok()) return id;
  check(nc_def_var(file_, name.c_str(), type_of(stored), static_cast<int>(dimensions.size()),
                   dimensions.data(), &id));
  if (ok() && stored == Stored::number && !coordinate) {
    check(nc_def_var_fill(file_, id, NC_FILL, &kNone));
  }
  attribute(id, "long_name", says);
  attribute(id, "units", unit);
  return id;
}

void NetcdfFile::put(int variable, std::span<const double> values) {
  if (ok()) check(nc_put_var_double(file_, variable, values.data()));
}

void NetcdfFile::put(int variable, std::span<const std::string> words) {
  if (ok()) check(nc_put_var_string(file_, variable, pointers(words).data()));
}

void NetcdfFile::put(int variable, std::span<const double> values,
                     const std::vector<std::size_t>& first,
                     const std::vector<std::size_t>& extent) {
  if (ok() && !values.empty())
    check(nc_put_vara_double(file_, variable, first.data(), extent.data(), values.data()));
}

void NetcdfFile::put(int variable, std::span<const std::string> words,
                     const std::vector<std::size_t>& first,
                     const std::vector<std::size_t>& extent) {
  if (ok() && !words.empty())
    check(nc_put_vara_string(file_, variable, first.data(), extent.data(), pointers(words).data()));
}

std::string NetcdfFile::close() {
  if (open_) check(nc_close(file_));
  open_ = false;
  return ok() ? "" : nc_strerror(status_);
}

}  // namespace flexspline::studies
