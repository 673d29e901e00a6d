#include <netcdf.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "flexspline/data/table_reader.hpp"
#include "tables/column_block.hpp"

namespace flexspline::data {
namespace {

using namespace std::string_view_literals;

constexpr std::size_t kMostAcross = 64;
constexpr std::size_t kLongestText = 4096;

struct Variable {
  int id = 0;
  bool wide = false;      ///< has a second dimension
  std::size_t index = 0;  ///< in it
  double scale = 1.0, offset = 0.0;
  double fill = std::numeric_limits<double>::quiet_NaN();
};

struct Found {
  TableHead head;
  std::vector<Variable> variables;
  std::size_t rows = 0;
};

std::string text_of(int file, int variable, const char* name) {
  std::size_t size = 0;
  nc_type type = NC_NAT;
  if (nc_inq_att(file, variable, name, &type, &size) != NC_NOERR) return {};
  if (type != NC_CHAR || size > kLongestText) return {};
  std::string text(size, '\0');
  if (nc_get_att_text(file, variable, name, text.data()) != NC_NOERR) return {};
  return text.substr(0, text.find('\0'));
}

double number_of(int file, int variable, const char* name, double fallback) {
  std::size_t size = 0;
  nc_type type = NC_NAT;
  if (nc_inq_att(file, variable, name, &type, &size) != NC_NOERR || size != 1 || type == NC_CHAR) {
    return fallback;
  }
  double value = fallback;
  return nc_get_att_double(file, variable, name, &value) == NC_NOERR ? value : fallback;
}

/// Variables along one dimension are a table.
class ClassicFile {
 public:
  ClassicFile(int file, const TableLimits& limits) : file_(file), limits_(limits) { look(); }

  const std::map<std::string, Found>& tables() const { return tables_; }

  bool read(const Found& found, std::size_t column, std::size_t from, std::size_t count,
            std::vector<double>& to) const {
    const Variable& one = found.variables[column];
    to.resize(count);
    const std::array<std::size_t, 2> start = {from, one.index};
    const std::array<std::size_t, 2> size = {count, 1};
    if (nc_get_vara_double(file_, one.id, start.data(), size.data(), to.data()) != NC_NOERR)
      return false;
    for (double& value : to) {
      value = value == one.fill                       ? std::numeric_limits<double>::quiet_NaN()
              : one.scale == 1.0 && one.offset == 0.0 ? value
                                                      : one.scale * value + one.offset;
    }
    return true;
  }

 private:
  void look() {
    int count = 0;
    if (nc_inq_nvars(file_, &count) != NC_NOERR) return;
    for (int v = 0; v < count && static_cast<std::size_t>(v) < limits_.columns; ++v) look_at(v);
  }

  void look_at(int v) {
    char name[NC_MAX_NAME + 1] = {};
    nc_type type = NC_NAT;
    int rank = 0;
    int dimensions[NC_MAX_VAR_DIMS] = {};
    if (nc_inq_var(file_, v, name, &type, &rank, dimensions, nullptr) != NC_NOERR) return;
    if (type == NC_CHAR || rank < 1 || rank > 2) return;
    std::size_t rows = 0;
    std::size_t across = 1;
    char along[NC_MAX_NAME + 1] = {};
    if (nc_inq_dim(file_, dimensions[0], along, &rows) != NC_NOERR) return;
    if (rank == 2 && nc_inq_dimlen(file_, dimensions[1], &across) != NC_NOERR) return;
    if (across > kMostAcross || rows < 2) return;
    Found& found = tables_[along];
    found.rows = rows;
    found.head.path = along;
    Variable one{v,
                 rank == 2,
                 0,
                 number_of(file_, v, "scale_factor", 1.0),
                 number_of(file_, v, "add_offset", 0.0),
                 number_of(file_, v, "_FillValue", std::numeric_limits<double>::quiet_NaN())};
    for (one.index = 0; one.index < across; ++one.index) {
      found.head.columns.push_back({across > 1 ? fmt::format("{}[{}]", name, one.index + 1) : name,
                                    text_of(file_, v, "units"), text_of(file_, v, "axis") == "T"});
      found.variables.push_back(one);
    }
  }

  int file_;
  const TableLimits& limits_;
  std::map<std::string, Found> tables_;
};

std::size_t padded(std::size_t bytes) { return (bytes + 3) / 4 * 4; }

std::size_t bytes_of_type(int file, nc_type type) {
  std::size_t bytes = 0;
  return nc_inq_type(file, type, nullptr, &bytes) == NC_NOERR ? bytes : 1;
}

std::size_t attribute_bytes(int file, int variable, int count) {
  std::size_t bytes = 8;
  for (int a = 0; a < count; ++a) {
    char name[NC_MAX_NAME + 1] = {};
    nc_type type = NC_NAT;
    std::size_t size = 0;
    if (nc_inq_attname(file, variable, a, name) != NC_NOERR) continue;
    if (nc_inq_att(file, variable, name, &type, &size) != NC_NOERR) continue;
    bytes += 12 + padded(std::string_view(name).size()) + padded(size * bytes_of_type(file, type));
  }
  return bytes;
}

/// What a whole file of these dimensions, attributes and variables has at least. The library reads
/// zeros behind the end of a file that is cut.
std::size_t least_bytes(int file) {
  int dimensions = 0, variables = 0, attributes = 0;
  if (nc_inq(file, &dimensions, &variables, &attributes, nullptr) != NC_NOERR) return 0;
  std::size_t bytes = 8 + 8 + attribute_bytes(file, NC_GLOBAL, attributes) + 8;
  char name[NC_MAX_NAME + 1] = {};
  for (int d = 0; d < dimensions; ++d) {
    if (nc_inq_dimname(file, d, name) == NC_NOERR)
      bytes += 8 + padded(std::string_view(name).size());
  }
  std::size_t last = 0;  // the padding of the last one may be left out
  for (int v = 0; v < variables; ++v) {
    nc_type type = NC_NAT;
    int rank = 0, count = 0;
    int along[NC_MAX_VAR_DIMS] = {};
    if (nc_inq_var(file, v, name, &type, &rank, along, &count) != NC_NOERR) continue;
    std::size_t size = bytes_of_type(file, type);
    for (int d = 0; d < rank; ++d) {
      std::size_t length = 0;
      nc_inq_dimlen(file, along[d], &length);
      if (length > 0 && size > (std::size_t{1} << 50U) / length) return size;
      size *= length;
    }
    bytes += 20 + 4 * static_cast<std::size_t>(rank) + padded(std::string_view(name).size()) +
             attribute_bytes(file, v, count) + size;
    last = std::max(last, padded(size) - size);
  }
  return bytes - std::min(bytes, last);
}

Result<void> tell(const ClassicFile& file, const TableLimits& limits, TableSink& sink) {
  for (const auto& [name, found] : file.tables()) {
    if (found.rows > limits.rows || found.head.columns.size() > limits.columns) {
      return failure(ErrorCode::bad_data,
                     fmt::format("dimension '{}' has more than {} rows or {} columns", name,
                                 limits.rows, limits.columns));
    }
    const std::vector<std::size_t> wanted = sink.begin(found.head);
    std::vector<std::vector<double>> block(wanted.size());
    for (std::size_t from = 0; from < found.rows && !wanted.empty(); from += kBlockRows) {
      const std::size_t count = std::min(kBlockRows, found.rows - from);
      for (std::size_t w = 0; w < wanted.size(); ++w) {
        if (file.read(found, wanted[w], from, count, block[w])) continue;
        return failure(ErrorCode::bad_data,
                       fmt::format("'{}' cannot be read from row {}",
                                   found.head.columns[wanted[w]].name, from + 1),
                       "the file may be cut");
      }
      sink.rows(block);
    }
  }
  return {};
}

bool knows(std::string_view head) {
  return head.starts_with("CDF\x01"sv) || head.starts_with("CDF\x02"sv) ||
         head.starts_with("CDF\x05"sv);
}

Result<void> read(const std::filesystem::path& path, const TableRequest& request, TableSink& sink) {
  int file = -1;
  const int code = nc_open(path.c_str(), NC_NOWRITE, &file);
  if (code != NC_NOERR) {
    return failure(ErrorCode::bad_data,
                   fmt::format("{}: netCDF cannot open it: {}", path.string(), nc_strerror(code)),
                   "the file may be cut or damaged");
  }
  const ClassicFile classic(file, request.limits);
  if (classic.tables().empty() || least_bytes(file) > std::filesystem::file_size(path)) {
    nc_close(file);
    return failure(ErrorCode::bad_data,
                   path.string() + ": it is shorter than its variables, or has none",
                   "the file is cut; write it again");
  }
  auto told = tell(classic, request.limits, sink);
  nc_close(file);
  if (!told) return tl::unexpected(in_context(told.error(), path.string()));
  return {};
}

}  // namespace

TableReaderRow describe_netcdf() {
  return {.id = "netcdf",
          .says =
              "netCDF classic: the variables along a dimension are a table; units, scale_factor, "
              "add_offset and _FillValue",
          .by_others = true,
          .knows = knows,
          .read = read};
}

}  // namespace flexspline::data
