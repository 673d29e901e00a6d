#include "export/zip.hpp"

#include <fmt/format.h>
#include <zip.h>

namespace flexspline::data {
namespace {

tl::unexpected<Error> refused(std::string_view what, const char* why) {
  return failure(ErrorCode::cannot_write, fmt::format("the archive's {}: {}", what, why));
}

// Fixed instant and no attributes of a machine: the same model gives the same bytes.
bool add(zip_t* archive, const ExportedFile& file) {
  zip_source_t* source = zip_source_buffer(archive, file.content.data(), file.content.size(), 0);
  if (source == nullptr) return false;
  const zip_int64_t index = zip_file_add(archive, file.path.c_str(), source, ZIP_FL_ENC_UTF_8);
  if (index < 0) {
    zip_source_free(source);
    return false;
  }
  const auto entry = static_cast<zip_uint64_t>(index);
  constexpr zip_uint16_t kFirstOf1980 = 0x21;
  return zip_file_set_dostime(archive, entry, 0, kFirstOf1980, 0) == 0;
}

Result<std::string> bytes_of(zip_source_t* source) {
  if (zip_source_open(source) != 0) return refused("bytes", "cannot be read back");
  zip_stat_t stat;
  zip_stat_init(&stat);
  zip_source_stat(source, &stat);
  std::string bytes(static_cast<std::size_t>(stat.size), '\0');
  const zip_int64_t read = zip_source_read(source, bytes.data(), stat.size);
  zip_source_close(source);
  if (read != static_cast<zip_int64_t>(stat.size)) return refused("bytes", "are incomplete");
  return bytes;
}

}  // namespace

Result<std::string> zipped(const std::vector<ExportedFile>& files) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(nullptr, 0, 0, &error);
  zip_t* archive = source == nullptr ? nullptr : zip_open_from_source(source, ZIP_TRUNCATE, &error);
  if (archive == nullptr) return refused("start", zip_error_strerror(&error));
  zip_source_keep(source);
  bool good = true;
  for (const ExportedFile& file : files) good = good && add(archive, file);
  if (!good || zip_close(archive) != 0) {
    const std::string why = zip_strerror(archive);
    zip_discard(archive);
    zip_source_free(source);
    return refused("files", why.c_str());
  }
  auto bytes = bytes_of(source);
  zip_source_free(source);
  return bytes;
}

}  // namespace flexspline::data
