#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "flexspline/data/table_reader.hpp"
#include "tables/column_block.hpp"
#include "tables/mdf_channel.hpp"
#include "tables/mdf_data.hpp"

namespace flexspline::data {
namespace {

constexpr std::uint64_t kHeadAt = 64;
constexpr std::size_t kMostRecord = std::size_t{1} << 24U;

/// A channel group: the records of one clock.
struct Group {
  std::uint64_t id = 0;
  std::uint64_t cycles = 0;
  std::size_t data_bytes = 0;
  std::size_t invalid_bytes = 0;
  bool is_text = false;  ///< its records are texts of varying length
  TableHead head;
  std::vector<MdfChannel> channels;

  std::size_t record_bytes() const { return data_bytes + invalid_bytes; }
};

struct DataGroup {
  std::uint64_t data = 0;
  std::size_t id_bytes = 0;
  std::vector<Group> groups;
};

class MdfReader {
 public:
  MdfReader(const InputFile& input, const TableLimits& limits, TableSink& sink)
      : file_(input), limits_(limits), sink_(sink) {}

  Result<void> run() {
    const auto head = file_.block(kHeadAt, "HD");
    if (!head) return tl::unexpected(head.error());
    const auto places = file_.chain(head->link(0), "DG", limits_.tables);
    if (!places) return tl::unexpected(places.error());
    for (const std::uint64_t place : *places) {
      const auto one = data_group(place);
      if (!one) return tl::unexpected(one.error());
      for (const Group& group : one->groups) {
        if (auto told = tell(*one, group); !told) return told;
      }
    }
    for (const std::string& note : notes_) sink_.note(note);
    return {};
  }

 private:
  Result<DataGroup> data_group(std::uint64_t place) {
    const auto block = file_.block(place, "DG");
    if (!block) return tl::unexpected(block.error());
    DataGroup one{block->link(2), block->number(0, 1), {}};
    if (one.id_bytes > 8)
      return failure(ErrorCode::bad_data, "records whose mark is longer than 8 bytes");
    const auto groups = file_.chain(block->link(1), "CG", limits_.tables);
    if (!groups) return tl::unexpected(groups.error());
    for (const std::uint64_t at : *groups) {
      auto found = group(at);
      if (!found) return tl::unexpected(found.error());
      one.groups.push_back(*std::move(found));
    }
    return one;
  }

  Result<Group> group(std::uint64_t at) {
    const auto block = file_.block(at, "CG");
    if (!block) return tl::unexpected(block.error());
    Group one;
    one.id = block->number(0, 8);
    one.cycles = block->number(8, 8);
    one.is_text = (block->number(16, 2) & 1U) != 0;
    one.data_bytes = block->number(24, 4);
    one.invalid_bytes = block->number(28, 4);
    if (one.record_bytes() > kMostRecord)
      return failure(ErrorCode::bad_data, "records longer than 16 MiB");
    if (!one.is_text && one.cycles > limits_.rows) {
      return failure(ErrorCode::bad_data, fmt::format("more than {} rows", limits_.rows));
    }
    const std::string name = file_.text(block->link(2));
    one.head.path = name.empty() ? fmt::format("group {}", ++numbered_) : name;
    if (!paths_.insert({one.head.path, 1}).second) {
      one.head.path += fmt::format(" {}", ++paths_[one.head.path]);
    }
    const auto channels = file_.chain(block->link(1), "CN", limits_.columns);
    if (!channels) return tl::unexpected(channels.error());
    for (const std::uint64_t place : *channels) take_channel(place, one);
    return one;
  }

  void take_channel(std::uint64_t place, Group& to) {
    const auto block = file_.block(place, "CN");
    if (!block) return;
    if (auto found = mdf_channel(file_, *block, to.data_bytes, to.invalid_bytes)) {
      to.head.columns.push_back(found->column);
      to.channels.push_back(*std::move(found));
    } else if (notes_.size() < 32) {
      notes_.push_back(fmt::format("channel '{}' of '{}' holds no plain numbers",
                                   file_.text(block->link(2)), to.head.path));
    }
  }

  Result<void> tell(const DataGroup& data, const Group& group) {
    if (group.is_text || group.channels.empty() || group.cycles == 0) return {};
    const std::vector<std::size_t> wanted = sink_.begin(group.head);
    if (wanted.empty()) return {};
    auto bytes = MdfData::open(file_, data.data);
    if (!bytes) return tl::unexpected(bytes.error());
    block_.assign(wanted.size(), {});
    std::string record;
    std::uint64_t rows = 0;
    while (rows < group.cycles) {
      const auto next = next_record(data, group, *bytes, record);
      if (!next) return tl::unexpected(next.error());
      if (!*next) break;
      for (std::size_t w = 0; w < wanted.size(); ++w) {
        block_[w].push_back(group.channels[wanted[w]].value(record, group.data_bytes, rows));
      }
      if (++rows % kBlockRows == 0) flush();
    }
    if (!block_[0].empty()) flush();
    if (rows < group.cycles) {
      return failure(ErrorCode::bad_data,
                     fmt::format("group '{}' ends after {} of {} records", group.head.path, rows,
                                 group.cycles),
                     "the file is cut; measure or export it again");
    }
    return {};
  }

  void flush() {
    sink_.rows(block_);
    for (auto& column : block_) column.clear();
  }

  /// The next record of a group, past those of others. False: the data end.
  Result<bool> next_record(const DataGroup& data, const Group& group, MdfData& bytes,
                           std::string& record) {
    while (true) {
      const Group* of = &group;
      if (data.id_bytes > 0) {
        char mark[8] = {};
        const auto got = bytes.read(mark, data.id_bytes);
        if (!got) return tl::unexpected(got.error());
        if (*got < data.id_bytes) return false;
        of = group_of(data, {mark, data.id_bytes});
        if (of == nullptr)
          return failure(ErrorCode::bad_data, "a record of no group", "the file is damaged");
      }
      std::size_t size = of->record_bytes();
      if (of->is_text) {
        char length[4] = {};
        const auto got = bytes.read(length, sizeof length);
        if (!got) return tl::unexpected(got.error());
        size = MdfBlock{"", {}, std::string(length, sizeof length)}.number(0, 4);
        if (size > kMostRecord) return failure(ErrorCode::bad_data, "a record longer than 16 MiB");
      }
      record.resize(size);
      const auto got = bytes.read(record.data(), size);
      if (!got) return tl::unexpected(got.error());
      if (*got < size) return false;
      if (of == &group) return true;
    }
  }

  static const Group* group_of(const DataGroup& data, std::string_view mark) {
    const std::uint64_t id = MdfBlock{"", {}, std::string(mark)}.number(0, mark.size());
    const auto found = std::ranges::find(data.groups, id, &Group::id);
    return found == data.groups.end() ? nullptr : &*found;
  }

  MdfFile file_;
  const TableLimits& limits_;
  TableSink& sink_;
  std::vector<std::vector<double>> block_;
  std::vector<std::string> notes_;
  std::map<std::string, int> paths_;
  int numbered_ = 0;
};

bool knows(std::string_view head) { return head.size() >= 64 && head.starts_with("MDF     4"); }

Result<void> read(const std::filesystem::path& path, const TableRequest& request, TableSink& sink) {
  const auto file = InputFile::open(path);
  if (!file) return tl::unexpected(file.error());
  auto done = MdfReader(*file, request.limits, sink).run();
  if (!done) return tl::unexpected(in_context(done.error(), path.string()));
  return {};
}

}  // namespace

TableReaderRow describe_mdf4() {
  return {.id = "mdf4",
          .says =
              "ASAM MDF 4: sorted and unsorted, plain, deflated and transposed; linear, rational "
              "and table conversions, invalid samples, virtual masters",
          .knows = knows,
          .read = read};
}

}  // namespace flexspline::data
