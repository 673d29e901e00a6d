#include <fmt/format.h>

#include <algorithm>

#include "flexspline/data/table_reader.hpp"
#include "tables/contained.hpp"
#include "tables/foreign_form.hpp"
#include "tables/input_file.hpp"

namespace flexspline::data {
namespace {

constexpr std::size_t kHeadBytes = 4096;

Result<const TableReaderRow*> reader_for(const InputFile& file) {
  const auto head = file.read(0, kHeadBytes);
  if (!head) return tl::unexpected(head.error());
  const std::string name = file.path().string();
  if (head->empty()) return failure(ErrorCode::bad_data, name + " is empty");
  if (const auto foreign = foreign_form(*head)) {
    return failure(ErrorCode::bad_data,
                   fmt::format("{} is {}, which is not read", name, foreign->is),
                   std::string(foreign->way_out));
  }
  const auto found = std::ranges::find_if(
      table_readers(), [&](const TableReaderRow& row) { return row.knows(*head); });
  if (found != table_readers().end()) return &*found;
  return failure(ErrorCode::bad_data, name + " is of no form that is read",
                 "flexspline list readers says which are; export it as CSV");
}

}  // namespace

Result<const TableReaderRow*> reader_of(const std::filesystem::path& path) {
  const auto file = InputFile::open(path);
  if (!file) return tl::unexpected(file.error());
  return reader_for(*file);
}

Result<void> read_tables(const std::filesystem::path& path, const TableRequest& request,
                         TableSink& sink) {
  const auto file = InputFile::open(path);
  if (!file) return tl::unexpected(file.error());
  const auto reader = reader_for(*file);
  if (!reader) return tl::unexpected(reader.error());
  const auto done = (*reader)->by_others ? read_contained(**reader, path, request, sink)
                                         : (*reader)->read(path, request, sink);
  if (auto unchanged = file->check_unchanged(); !unchanged) return unchanged;
  return done;
}

}  // namespace flexspline::data
