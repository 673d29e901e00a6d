#include <hdf5.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "flexspline/data/table_reader.hpp"
#include "tables/column_block.hpp"
#include "tables/hdf5_handle.hpp"

namespace flexspline::data {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kMagic = "\x89HDF\r\n\x1A\n"sv;
constexpr hsize_t kMostAcross = 64;  // columns of one array

/// A column of an array: the k-th of its shorter side, or a member of its records.
struct Source {
  std::string dataset;
  std::string member;
  int rank = 1;
  bool rows_first = true;
  hsize_t across = 0;
  hsize_t index = 0;
  double scale = 1.0, offset = 0.0;
  double fill = std::numeric_limits<double>::quiet_NaN();
};

struct Found {
  TableHead head;
  std::vector<Source> sources;
};

std::string joined(const std::string& path, const std::string& name) {
  return path.empty() ? name : path + "/" + name;
}

/// Walks the groups of a file along its hard links; arrays of one group and length are a table.
class Hdf5Tree {
 public:
  Hdf5Tree(hid_t file, const TableLimits& limits) : file_(file), limits_(limits) {}

  Result<void> walk() { return walk_group("/", "", 0); }
  const std::map<std::pair<std::string, hsize_t>, Found>& tables() const { return tables_; }
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  static herr_t collect(hid_t, const char* name, const H5L_info_t* info, void* to) {
    static_cast<std::vector<std::pair<std::string, bool>>*>(to)->emplace_back(
        name, info->type == H5L_TYPE_HARD);
    return 0;
  }

  Result<void> walk_group(const std::string& where, const std::string& path, std::size_t depth) {
    if (depth > limits_.depth) {
      return failure(ErrorCode::bad_data, fmt::format("groups deeper than {}", limits_.depth));
    }
    const Hdf5Handle group(H5Gopen2(file_, where.c_str(), H5P_DEFAULT), H5Gclose);
    H5O_info_t about;
    if (!group || H5Oget_info2(group.id(), &about, H5O_INFO_BASIC) < 0) return {};
    if (!visited_.insert(about.addr).second) return {};
    std::vector<std::pair<std::string, bool>> links;
    hsize_t from = 0;
    if (H5Literate(group.id(), H5_INDEX_NAME, H5_ITER_INC, &from, collect, &links) < 0) {
      notes_.push_back(fmt::format("group '{}' cannot be read", where));
    }
    for (const auto& [name, is_hard] : links) {
      if (name == "#refs#" || name == "#subsystem#")
        continue;  // MATLAB's own, reached by references
      if (!is_hard) {
        notes_.push_back(fmt::format("'{}' is a link, and is not followed", joined(path, name)));
      } else if (auto done = walk_object(where, path, name, depth); !done) {
        return done;
      }
    }
    return {};
  }

  Result<void> walk_object(const std::string& where, const std::string& path,
                           const std::string& name, std::size_t depth) {
    if (++objects_ > 16 * limits_.columns) {
      return failure(ErrorCode::bad_data, "more objects than can be looked at",
                     "give a file of one measurement");
    }
    const std::string inside = (where == "/" ? "/" : where + "/") + name;
    H5O_info_t about;
    if (H5Oget_info_by_name2(file_, inside.c_str(), &about, H5O_INFO_BASIC, H5P_DEFAULT) < 0)
      return {};
    if (about.type == H5O_TYPE_GROUP) return walk_group(inside, joined(path, name), depth + 1);
    if (about.type == H5O_TYPE_DATASET) take_dataset(inside, path, name);
    return {};
  }

  void take_dataset(const std::string& inside, const std::string& path, const std::string& name) {
    const Hdf5Handle set(H5Dopen2(file_, inside.c_str(), H5P_DEFAULT), H5Dclose);
    if (!set || hdf5_text(set.id(), "NAME").starts_with("This is a netCDF dimension but not"))
      return;
    const Hdf5Handle plist(H5Dget_create_plist(set.id()), H5Pclose);
    if (H5Pget_layout(plist.id()) == H5D_VIRTUAL || H5Pget_external_count(plist.id()) > 0) {
      notes_.push_back(
          fmt::format("'{}' lies in another file, and is not read", joined(path, name)));
      return;
    }
    const Hdf5Handle space(H5Dget_space(set.id()), H5Sclose);
    const Hdf5Handle type(H5Dget_type(set.id()), H5Tclose);
    const int rank = H5Sget_simple_extent_ndims(space.id());
    if (rank < 1 || rank > 2) return;
    hsize_t sizes[2] = {0, 1};
    H5Sget_simple_extent_dims(space.id(), sizes, nullptr);
    Source source{inside, "", rank, sizes[0] >= sizes[1], std::min(sizes[0], sizes[1]), 0};
    if (rank == 1) source.across = 1, source.rows_first = true;
    const hsize_t rows = std::max(sizes[0], rank == 1 ? 0 : sizes[1]);
    const H5T_class_t kind = H5Tget_class(type.id());
    if (hdf5_text(set.id(), "MATLAB_class") == "char") return;
    if (kind == H5T_REFERENCE) {
      take_references(set.id(), path, name, rows * source.across);
    } else if (kind == H5T_COMPOUND && rank == 1) {
      take_records(type.id(), source, path, name, rows);
    } else if ((kind == H5T_FLOAT || kind == H5T_INTEGER) && source.across <= kMostAcross) {
      take_array(set.id(), source, path, name, rows);
    }
  }

  /// MATLAB v7.3 lays out a field of a struct array as references to the arrays of its elements.
  void take_references(hid_t set, const std::string& path, const std::string& name, hsize_t count) {
    if (count > limits_.tables || in_reference_) return;
    std::vector<hobj_ref_t> references(count);
    if (H5Dread(set, H5T_STD_REF_OBJ, H5S_ALL, H5S_ALL, H5P_DEFAULT, references.data()) < 0) return;
    in_reference_ = true;
    for (hsize_t k = 0; k < count; ++k) {
      char where[1024] = {};
      const ssize_t length = H5Rget_name(set, H5R_OBJECT, &references[k], where, sizeof where);
      H5O_type_t kind = H5O_TYPE_UNKNOWN;
      const bool is_set = length > 0 && static_cast<std::size_t>(length) < sizeof where &&
                          H5Rget_obj_type2(set, H5R_OBJECT, &references[k], &kind) >= 0 &&
                          kind == H5O_TYPE_DATASET;
      if (is_set) take_dataset(where, fmt::format("{}({})", path, k + 1), name);
    }
    in_reference_ = false;
  }

  void take_array(hid_t set, Source source, const std::string& path, const std::string& name,
                  hsize_t rows) {
    std::string unit;
    for (const char* key : {"units", "unit", "Units", "Unit", "UNITS"}) {
      if (unit.empty()) unit = hdf5_text(set, key);
    }
    source.scale = hdf5_number(set, "scale_factor", 1.0);
    source.offset = hdf5_number(set, "add_offset", 0.0);
    source.fill = hdf5_number(set, "_FillValue", source.fill);
    const std::string given = hdf5_text(set, "long_name");
    const std::string shown = name.starts_with("column") && !given.empty() ? given : name;
    for (source.index = 0; source.index < source.across; ++source.index) {
      const std::string column =
          source.across > 1 ? fmt::format("{}[{}]", shown, source.index + 1) : shown;
      add(path, rows, {column, unit, hdf5_text(set, "axis") == "T"}, source);
    }
  }

  void take_records(hid_t type, Source source, const std::string& path, const std::string& name,
                    hsize_t rows) {
    const int members = H5Tget_nmembers(type);
    for (int m = 0; m < members; ++m) {
      const H5T_class_t kind = H5Tget_member_class(type, static_cast<unsigned>(m));
      char* member = H5Tget_member_name(type, static_cast<unsigned>(m));
      if (member != nullptr && (kind == H5T_FLOAT || kind == H5T_INTEGER)) {
        source.member = member;
        add(joined(path, name), rows, {member, ""}, source);
      }
      H5free_memory(member);
    }
  }

  void add(const std::string& path, hsize_t rows, TableColumn column, const Source& source) {
    if (rows < 2) return;
    Found& found = tables_[{path, rows}];
    if (found.sources.size() >= limits_.columns) return;
    found.head.path = path;
    found.head.columns.push_back(std::move(column));
    found.sources.push_back(source);
  }

  hid_t file_;
  const TableLimits& limits_;
  std::map<std::pair<std::string, hsize_t>, Found> tables_;
  std::set<haddr_t> visited_;
  std::vector<std::string> notes_;
  std::size_t objects_ = 0;
  bool in_reference_ = false;
};

/// So many rows of a column from a place; false: the library gave up.
bool read_rows(hid_t file, const Source& source, hsize_t from, hsize_t count,
               std::vector<double>& to) {
  to.resize(count);
  const Hdf5Handle set(H5Dopen2(file, source.dataset.c_str(), H5P_DEFAULT), H5Dclose);
  const Hdf5Handle space(H5Dget_space(set.id()), H5Sclose);
  const Hdf5Handle memory(H5Screate_simple(1, &count, nullptr), H5Sclose);
  hsize_t start[2] = {from, source.index};
  hsize_t size[2] = {count, 1};
  if (!source.rows_first) std::swap(start[0], start[1]), std::swap(size[0], size[1]);
  if (H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, start, nullptr, size, nullptr) < 0)
    return false;
  Hdf5Handle type(H5Tcopy(H5T_NATIVE_DOUBLE), H5Tclose);
  if (!source.member.empty()) {
    Hdf5Handle record(H5Tcreate(H5T_COMPOUND, sizeof(double)), H5Tclose);
    H5Tinsert(record.id(), source.member.c_str(), 0, H5T_NATIVE_DOUBLE);
    return H5Dread(set.id(), record.id(), memory.id(), space.id(), H5P_DEFAULT, to.data()) >= 0;
  }
  return H5Dread(set.id(), type.id(), memory.id(), space.id(), H5P_DEFAULT, to.data()) >= 0;
}

void unpack(const Source& source, std::vector<double>& values) {
  for (double& value : values) {
    value = value == source.fill || !std::isfinite(value) ? std::numeric_limits<double>::quiet_NaN()
            : source.scale == 1.0 && source.offset == 0.0 ? value
                                                          : source.scale * value + source.offset;
  }
}

Result<void> tell(hid_t file, const Found& found, hsize_t rows, TableSink& sink) {
  const std::vector<std::size_t> wanted = sink.begin(found.head);
  std::vector<std::vector<double>> block(wanted.size());
  for (hsize_t from = 0; from < rows && !wanted.empty(); from += kBlockRows) {
    const hsize_t count = std::min<hsize_t>(kBlockRows, rows - from);
    for (std::size_t w = 0; w < wanted.size(); ++w) {
      const Source& source = found.sources[wanted[w]];
      if (!read_rows(file, source, from, count, block[w])) {
        return failure(ErrorCode::bad_data,
                       fmt::format("'{}' cannot be read from row {}", source.dataset, from + 1),
                       "the file may be damaged, or packed by a filter that is not installed");
      }
      unpack(source, block[w]);
    }
    sink.rows(block);
  }
  return {};
}

bool knows(std::string_view head) {
  for (const std::size_t at : {0, 512, 1024, 2048}) {
    if (head.size() > at && head.substr(at).starts_with(kMagic)) return true;
  }
  return false;
}

Result<void> read(const std::filesystem::path& path, const TableRequest& request, TableSink& sink) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  H5PLset_loading_state(0);  // no code from elsewhere
  const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  const auto refused = [&](Error error) {
    return tl::unexpected(in_context(std::move(error), path.string()));
  };
  if (!file) {
    return refused(
        {ErrorCode::bad_data, "HDF5 cannot open it", "the file may be cut or damaged", {}});
  }
  Hdf5Tree tree(file.id(), request.limits);
  if (auto walked = tree.walk(); !walked) return refused(walked.error());
  for (const auto& [key, found] : tree.tables()) {
    const hsize_t rows = key.second;
    if (rows > request.limits.rows) {
      return refused({ErrorCode::bad_data,
                      fmt::format("'{}' has more than {} rows", key.first, request.limits.rows),
                      "",
                      {}});
    }
    if (auto told = tell(file.id(), found, rows, sink); !told) return refused(told.error());
  }
  for (const std::string& note : tree.notes()) sink.note(note);
  return {};
}

}  // namespace

TableReaderRow describe_hdf5() {
  return {.id = "hdf5",
          .says =
              "HDF5 of any tree, among it netCDF-4 and MATLAB v7.3: arrays of one group and length "
              "are a table, "
              "records are one each; units, scale_factor, add_offset and _FillValue",
          .by_others = true,
          .knows = knows,
          .read = read};
}

}  // namespace flexspline::data
