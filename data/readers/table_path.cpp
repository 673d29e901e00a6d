#include "readers/table_path.hpp"

#include <fmt/format.h>

#include <string>
#include <system_error>

namespace flexspline::data {
namespace {

namespace fs = std::filesystem;

bool climbs(const fs::path& relative) {
  const fs::path plain = relative.lexically_normal();
  return plain.empty() || plain.is_absolute() || *plain.begin() == "..";
}

bool is_inside(const fs::path& folder, const fs::path& path) {
  return !climbs(path.lexically_relative(folder));
}

tl::unexpected<Error> refused(const fs::path& file, const std::string& why,
                              const std::string& remedy) {
  return failure(ErrorCode::bad_data, fmt::format("file '{}' {}", file.string(), why), remedy);
}

}  // namespace

Result<fs::path> table_path(const fs::path& folder, const fs::path& file) {
  const std::string inside =
      "put the table into the folder of dataset.toml, and name it from there";
  if (file.is_absolute()) return refused(file, "is an absolute path", inside);
  if (file.empty() || climbs(file)) return refused(file, "climbs out of the folder", inside);
  const fs::path path = folder / file;
  std::error_code error;
  const fs::path real = fs::canonical(path, error);
  if (error) return refused(file, "is not there", "correct the name; it is case sensitive");
  if (!is_inside(fs::canonical(folder, error), real)) {
    return refused(file, "climbs out of the folder by a link to " + real.string(), inside);
  }
  if (!fs::is_regular_file(real, error)) return refused(file, "is not a file", "name a CSV file");
  if (const std::string kind = file.extension().string();
      kind == ".mat" || kind == ".h5" || kind == ".hdf5") {
    return refused(file, "is no CSV table", "flexspline import makes a data set of it");
  }
  return path;
}

}  // namespace flexspline::data
