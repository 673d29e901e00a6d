#include "import/row_writer.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <iterator>

#include <fmt/format.h>

#include "flexspline/core/write_file.hpp"

namespace flexspline::data {
namespace {

constexpr std::size_t kFlushed = std::size_t{1} << 18U;

std::filesystem::path part_of(const std::filesystem::path& path) {
  std::filesystem::path part = path;
  part += ".part";
  return part;
}

tl::unexpected<Error> not_written(const std::filesystem::path& path) {
  return failure(ErrorCode::cannot_write,
                 "cannot write " + path.string() + ": " + std::strerror(errno),
                 "check the disk's space and the folder's permissions");
}

}  // namespace

Result<RowWriter> RowWriter::open(const std::filesystem::path& path,
                                  const std::vector<std::string>& names) {
  RowWriter writer;
  writer.path_ = path;
  const int file =
      ::open(part_of(path).c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0666);
  if (file < 0) return not_written(path);
  writer.file_.reset(::fdopen(file, "w"));
  for (const std::string& name : names) {
    writer.text_ += writer.text_.empty() ? name : "," + name;
  }
  writer.text_ += '\n';
  return writer;
}

RowWriter& RowWriter::operator=(RowWriter&& other) noexcept {
  drop();
  file_ = std::move(other.file_);
  path_ = std::move(other.path_);
  text_ = std::move(other.text_);
  rows_ = other.rows_;
  failed_ = other.failed_;
  return *this;
}

RowWriter::~RowWriter() { drop(); }

void RowWriter::drop() {
  if (!file_) return;
  file_.reset();
  std::error_code ignored;
  std::filesystem::remove(part_of(path_), ignored);
}

void RowWriter::add(const std::vector<double>& row) {
  const auto out = std::back_inserter(text_);
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (i > 0) text_ += ',';
    if (std::isfinite(row[i])) fmt::format_to(out, "{}", row[i]);
  }
  text_ += '\n';
  ++rows_;
  if (text_.size() > kFlushed) flush();
}

void RowWriter::flush() {
  failed_ = std::fwrite(text_.data(), 1, text_.size(), file_.get()) != text_.size() || failed_;
  text_.clear();
}

Result<void> RowWriter::finish() {
  flush();
  if (failed_ || std::fflush(file_.get()) != 0) return not_written(path_);
  const auto held = writing();
  file_.reset();
  std::error_code error;
  std::filesystem::rename(part_of(path_), path_, error);
  if (!error) return {};
  errno = error.value();
  return not_written(path_);
}

}  // namespace flexspline::data
