#include "tables/bag_tables.hpp"

#include <limits>
#include <optional>

#include <fmt/format.h>

#include "tables/cdr_message.hpp"
#include "tables/column_block.hpp"

namespace flexspline::data {
namespace {

constexpr double kNanosecond = 1e-9;
constexpr std::size_t kMostNotes = 32;

/// A topic as a table.
struct TopicTable {
  BagTopic topic;
  RosDefinition definition;
  TableHead head;
  std::optional<std::size_t> stamp;  ///< of its numbers, which is its clock
  std::vector<std::size_t> kept;     ///< of its numbers, those that are columns behind the clock
  std::size_t numbers = 0;           ///< of a message
  std::int64_t start = 0;            ///< ns since 1970, the clock's zero
};

/// The stamp of a message's own header. One that was never set is no clock.
std::optional<std::size_t> clock_of(const std::vector<CdrLeaf>& leaves, const CdrValues& first) {
  for (std::size_t k = 0; k < leaves.size(); ++k) {
    const bool own = leaves[k].name == "header.stamp" || leaves[k].name == "stamp";
    if (own && leaves[k].stamp && first.stamps[k] > 0) return k;
  }
  return std::nullopt;
}

void add_columns(const std::vector<CdrLeaf>& leaves, TopicTable& to) {
  TableColumn clock{to.stamp ? leaves[*to.stamp].name : "log_time", "s", true};
  clock.epoch_s = kNanosecond * static_cast<double>(to.start);
  to.head.columns.push_back(std::move(clock));
  for (std::size_t k = 0; k < leaves.size(); ++k) {
    if (leaves[k].stamp) continue;
    to.kept.push_back(k);
    to.head.columns.push_back({leaves[k].name, leaves[k].unit});
  }
}

/// Stamps may be anything: where their difference does not fit an integer, it is no time.
double seconds_between(std::int64_t from, std::int64_t to) {
  std::int64_t by = 0;
  return __builtin_sub_overflow(to, from, &by) ? std::numeric_limits<double>::quiet_NaN()
                                               : kNanosecond * static_cast<double>(by);
}

class Telling {
 public:
  Telling(Bag& bag, const TableLimits& limits, TableSink& sink)
      : bag_(bag), limits_(limits), sink_(sink) {}

  Result<void> run() {
    std::size_t told = 0;
    for (const BagTopic& topic : bag_.topics()) {
      const auto table = table_of(topic);
      if (!table) return tl::unexpected(table.error());
      if (!*table) continue;
      if (auto done = tell(**table); !done) return done;
      ++told;
    }
    for (const std::string& note : notes_) sink_.note(note);
    if (told > 0) return {};
    return failure(ErrorCode::bad_data,
                   notes_.empty() ? "it holds no topic"
                                  : "no topic of it holds numbers that are read: " + notes_.front(),
                   "export the topic as CSV");
  }

 private:
  void left_out(const BagTopic& topic, const std::string& why) {
    if (notes_.size() < kMostNotes) notes_.push_back(fmt::format("topic '{}' {}", topic.name, why));
  }

  /// Nothing, with a note, for a topic that is not read.
  Result<std::optional<TopicTable>> table_of(const BagTopic& topic) {
    if (topic.serialisation != "cdr") {
      left_out(topic, fmt::format("is serialised as '{}'; cdr is read", topic.serialisation));
      return std::nullopt;
    }
    const std::string text =
        topic.definition.empty() ? known_ros_definition(topic.type) : topic.definition;
    auto definition = parse_ros_definition(topic.type, text);
    if (text.empty() || !definition) {
      left_out(topic, fmt::format("is of type '{}', {}", topic.type,
                                  text.empty() ? "whose definition is not in the file"
                                               : definition.error().message()));
      return std::nullopt;
    }
    return look_at_first(topic, *std::move(definition));
  }

  Result<std::optional<TopicTable>> look_at_first(const BagTopic& topic, RosDefinition definition) {
    TopicTable table{topic, std::move(definition), {topic.name, {}, {}}, {}, {}, 0, 0};
    const CdrReader reader(table.definition, limits_.columns - 1);
    bool any = false;
    const auto done = bag_.messages(topic, [&](std::int64_t logged, std::string_view bytes) {
      any = true;
      const auto leaves = reader.leaves(bytes);
      CdrValues first;
      if (!leaves || !reader.values(bytes, first)) return false;
      table.stamp = clock_of(*leaves, first);
      table.start = table.stamp ? first.stamps[*table.stamp] : logged;
      table.numbers = leaves->size();
      add_columns(*leaves, table);
      return false;
    });
    if (!done) return tl::unexpected(done.error());
    if (table.kept.empty()) {
      left_out(topic, any ? "holds no numbers, or more than a table may have, or does not fit its "
                            "definition"
                          : "has no message");
      return std::nullopt;
    }
    return table;
  }

  Result<void> tell(const TopicTable& table) {
    wanted_ = sink_.begin(table.head);
    if (wanted_.empty()) return {};
    block_.assign(wanted_.size(), {});
    std::size_t rows = 0;
    std::size_t other = 0;
    const CdrReader reader(table.definition, limits_.columns - 1);
    CdrValues values;
    const auto done = bag_.messages(table.topic, [&](std::int64_t logged, std::string_view bytes) {
      const bool fits = reader.values(bytes, values) && values.numbers.size() == table.numbers;
      other += fits ? 0 : 1;
      if (fits) take(table, logged, values);
      if (block_[0].size() >= kBlockRows) flush();
      return ++rows <= limits_.rows;
    });
    if (!done) return tl::unexpected(done.error());
    if (rows > limits_.rows) {
      return failure(ErrorCode::bad_data, fmt::format("more than {} messages", limits_.rows));
    }
    if (!block_[0].empty()) flush();
    if (other > 0) {
      left_out(table.topic, fmt::format("has {} of {} messages of another shape than the first, "
                                        "which are left out",
                                        other, rows));
    }
    return {};
  }

  void take(const TopicTable& table, std::int64_t logged, const CdrValues& values) {
    for (std::size_t w = 0; w < wanted_.size(); ++w) {
      if (wanted_[w] > 0) {
        block_[w].push_back(values.numbers[table.kept[wanted_[w] - 1]]);
        continue;
      }
      const std::int64_t now = table.stamp ? values.stamps[*table.stamp] : logged;
      block_[w].push_back(seconds_between(table.start, now));
    }
  }

  void flush() {
    sink_.rows(block_);
    for (auto& column : block_) column.clear();
  }

  Bag& bag_;
  const TableLimits& limits_;
  TableSink& sink_;
  std::vector<std::size_t> wanted_;
  std::vector<std::vector<double>> block_;
  std::vector<std::string> notes_;
};

}  // namespace

Result<void> tell_bag(Bag& bag, const TableLimits& limits, TableSink& sink) {
  return Telling(bag, limits, sink).run();
}

}  // namespace flexspline::data
