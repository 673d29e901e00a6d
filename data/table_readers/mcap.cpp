#include "flexspline/data/table_reader.hpp"
#include "tables/mcap_bag.hpp"

namespace flexspline::data {
namespace {

bool knows(std::string_view head) { return head.starts_with(kMcapMark); }

Result<void> read(const std::filesystem::path& path, const TableRequest& request, TableSink& sink) {
  const auto file = InputFile::open(path);
  if (!file) return tl::unexpected(file.error());
  auto bag = McapBag::open(*file, request.limits);
  const Result<void> done =
      bag ? tell_bag(*bag, request.limits, sink) : Result<void>(tl::unexpected(bag.error()));
  if (!done) return tl::unexpected(in_context(done.error(), path.string()));
  return {};
}

}  // namespace

TableReaderRow describe_mcap() {
  return {.id = "mcap",
          .says =
              "MCAP with messages of ROS 2, by the definitions in the file; plain, lz4 and zstd; a "
              "topic is a table",
          .by_others = true,
          .knows = knows,
          .read = read};
}

}  // namespace flexspline::data
