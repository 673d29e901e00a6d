#include "run/wall_times.hpp"

#include <cerrno>
#include <charconv>
#include <sstream>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

#include <fmt/format.h>

#include "flexspline/core/write_file.hpp"
#include "flexspline/studies/run.hpp"

namespace flexspline::studies {
namespace {

constexpr const char* kFile = "seconds.csv";

}  // namespace

Result<void> add_wall_time(const std::filesystem::path& folder, const std::string& key,
                           double seconds) {
  const std::filesystem::path path = folder / kFile;
  const std::string line = fmt::format("{},{}\n", key, seconds);
  const auto whole = writing();
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  const bool written =
      file >= 0 && ::write(file, line.data(), line.size()) == static_cast<ssize_t>(line.size());
  const int code = errno;
  if (file >= 0) ::close(file);
  if (written) return {};
  return failure(
      ErrorCode::cannot_write,
      fmt::format("cannot write {}: {}", path.string(), std::generic_category().message(code)),
      "choose a folder that can be written to and has room");
}

std::map<std::string, double> wall_times(const std::filesystem::path& folder) {
  std::map<std::string, double> times;
  std::istringstream text(read_file(folder / kFile).value_or(""));
  for (std::string line; std::getline(text, line);) {
    const std::size_t comma = line.rfind(',');
    if (comma == std::string::npos) continue;
    double seconds = 0.0;
    const auto read = std::from_chars(line.data() + comma + 1, line.data() + line.size(), seconds);
    if (read.ec == std::errc{}) times[line.substr(0, comma)] = seconds;
  }
  return times;
}

}  // namespace flexspline::studies
