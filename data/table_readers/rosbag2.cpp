#include <sqlite3.h>

#include <memory>

#include <fmt/format.h>

#include "flexspline/data/table_reader.hpp"
#include "tables/bag_tables.hpp"

namespace flexspline::data {
namespace {

using namespace std::string_view_literals;

using Database = std::unique_ptr<sqlite3, decltype(&sqlite3_close)>;
using Statement = std::unique_ptr<sqlite3_stmt, decltype(&sqlite3_finalize)>;

constexpr int kMostBytes = 1 << 28;

std::string text_at(sqlite3_stmt* row, int column) {
  const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(row, column));
  return text == nullptr
             ? std::string()
             : std::string(text, static_cast<std::size_t>(sqlite3_column_bytes(row, column)));
}

/// The database of a rosbag2: topics, messages and, since Iron, message_definitions.
class SqliteBag : public Bag {
 public:
  static Result<SqliteBag> open(const std::filesystem::path& path, const TableLimits& limits) {
    SqliteBag bag;
    if (auto opened = bag.connect(path); !opened) return tl::unexpected(opened.error());
    if (auto listed = bag.list(limits); !listed) return tl::unexpected(listed.error());
    return bag;
  }

  const std::vector<BagTopic>& topics() const override { return topics_; }

  Result<void> messages(const BagTopic& topic, const BagMessage& take) override {
    const Statement rows =
        prepared("SELECT timestamp, data FROM messages WHERE topic_id = ?1 ORDER BY timestamp");
    if (!rows) return wrong();
    sqlite3_bind_int64(rows.get(), 1, topic.id);
    int code = SQLITE_ROW;
    while ((code = sqlite3_step(rows.get())) == SQLITE_ROW) {
      const auto* bytes = static_cast<const char*>(sqlite3_column_blob(rows.get(), 1));
      const auto size = static_cast<std::size_t>(sqlite3_column_bytes(rows.get(), 1));
      const std::string_view message = bytes == nullptr ? ""sv : std::string_view(bytes, size);
      if (!take(sqlite3_column_int64(rows.get(), 0), message)) return {};
    }
    return code == SQLITE_DONE ? Result<void>{} : Result<void>(wrong());
  }

 private:
  SqliteBag() : database_(nullptr, sqlite3_close) {}

  // Read only and unlocked: nothing is written beside the file, no journal of others is applied.
  Result<void> connect(const std::filesystem::path& path) {
    std::string uri = "file:";
    for (const char c : std::filesystem::absolute(path).string()) {
      uri += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
    uri += "?mode=ro&immutable=1";
    sqlite3* raw = nullptr;
    const int code =
        sqlite3_open_v2(uri.c_str(), &raw, SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr);
    database_.reset(raw);
    if (code != SQLITE_OK) return wrong();
    sqlite3_limit(raw, SQLITE_LIMIT_LENGTH, kMostBytes);
    sqlite3_db_config(raw, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
    sqlite3_db_config(raw, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
    return {};
  }

  Result<void> list(const TableLimits& limits) {
    const Statement any = prepared("SELECT count(*) FROM sqlite_master");
    if (!any || sqlite3_step(any.get()) != SQLITE_ROW) return wrong();
    if (!has_table("topics") || !has_table("messages")) {
      return failure(ErrorCode::bad_data, "it is a database of SQLite, but no rosbag2",
                     "export the table as CSV: sqlite3 -header -csv FILE \"SELECT …\"");
    }
    const Statement rows = prepared(
        has_table("message_definitions")
            ? "SELECT t.id, t.name, t.type, t.serialization_format, (SELECT "
              "encoded_message_definition FROM message_definitions d WHERE d.topic_type = t.type "
              "AND d.encoding = 'ros2msg') FROM topics t ORDER BY t.id"
            : "SELECT id, name, type, serialization_format, '' FROM topics ORDER BY id");
    if (!rows) return wrong();
    int code = SQLITE_ROW;
    while ((code = sqlite3_step(rows.get())) == SQLITE_ROW) {
      if (topics_.size() >= limits.tables) {
        return failure(ErrorCode::bad_data, fmt::format("more than {} topics", limits.tables));
      }
      topics_.push_back({text_at(rows.get(), 1), text_at(rows.get(), 2), text_at(rows.get(), 4),
                         text_at(rows.get(), 3), sqlite3_column_int64(rows.get(), 0)});
    }
    return code == SQLITE_DONE ? Result<void>{} : Result<void>(wrong());
  }

  bool has_table(const char* name) const {
    const Statement rows = prepared("SELECT 1 FROM sqlite_master WHERE type='table' AND name=?1");
    if (!rows) return false;
    sqlite3_bind_text(rows.get(), 1, name, -1, SQLITE_STATIC);
    return sqlite3_step(rows.get()) == SQLITE_ROW;
  }

  Statement prepared(const char* text) const {
    sqlite3_stmt* raw = nullptr;
    sqlite3_prepare_v2(database_.get(), text, -1, &raw, nullptr);
    return {raw, sqlite3_finalize};
  }

  tl::unexpected<Error> wrong() const {
    return failure(ErrorCode::bad_data,
                   fmt::format("SQLite cannot read it: {}", sqlite3_errmsg(database_.get())),
                   "the file may be cut or damaged, or its recording was not ended");
  }

  Database database_;
  std::vector<BagTopic> topics_;
};

bool knows(std::string_view head) { return head.starts_with("SQLite format 3\0"sv); }

Result<void> read(const std::filesystem::path& path, const TableRequest& request, TableSink& sink) {
  auto bag = SqliteBag::open(path, request.limits);
  const Result<void> done =
      bag ? tell_bag(*bag, request.limits, sink) : Result<void>(tl::unexpected(bag.error()));
  if (!done) return tl::unexpected(in_context(done.error(), path.string()));
  return {};
}

}  // namespace

TableReaderRow describe_rosbag2() {
  return {
      .id = "rosbag2",
      .says =
          "rosbag2's SQLite: messages of ROS 2, by the definitions in the file or the published "
          "ones; a topic is a table",
      .by_others = true,
      .knows = knows,
      .read = read};
}

}  // namespace flexspline::data
