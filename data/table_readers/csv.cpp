#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

#include "flexspline/data/table_reader.hpp"
#include "readers/cell_text.hpp"
#include "tables/csv_form.hpp"
#include "tables/input_file.hpp"
#include "tables/time_stamp.hpp"

namespace flexspline::data {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kPiece = std::size_t{1} << 21U;
constexpr std::size_t kBlockRows = 4096;
constexpr std::size_t kLongestLine = std::size_t{1} << 20U;
constexpr double kDay = 86400.0;
constexpr std::size_t kNowhere = static_cast<std::size_t>(-1);

/// Where something first happened, and how often.
struct Incident {
  std::size_t count = 0;
  std::size_t line = 0;
  std::string text;

  void add(std::size_t at, std::string_view what) {
    if (count++ > 0) return;
    line = at;
    text = shown(what);
  }
};

/// Only what numbers are written with: digits, marks, signs, an exponent.
bool looks_like_number(std::string_view bare) {
  return bare.find_first_of("0123456789") != bare.npos &&
         bare.find_first_not_of("0123456789.,'+-eE ") == bare.npos;
}

class CsvStream {
 public:
  CsvStream(const InputFile& file, const TableRequest& request, TableSink& sink)
      : file_(file), limits_(request.limits), stated_(request.text), sink_(sink) {}

  Result<void> run() {
    const auto head = file_.read(0, kSniffedBytes);
    if (!head) return tl::unexpected(head.error());
    auto form = sniff_csv(*head, head->size() == file_.size(), stated_);
    if (!form) return refused(form.error());
    form_ = *std::move(form);
    if (form_.names.size() > limits_.columns) {
      return refused(
          {ErrorCode::bad_data, fmt::format("more than {} columns", limits_.columns), "", {}});
    }
    if (!begin()) return {};
    if (auto read = read_pieces(); !read) return read;
    flush();
    return say_incidents();
  }

 private:
  Result<void> refused(Error error) const {
    return tl::unexpected(in_context(std::move(error), file_.path().string()));
  }

  Result<void> refused_at(std::size_t line, const std::string& problem,
                          const std::string& remedy) const {
    return failure(ErrorCode::bad_data,
                   fmt::format("{}:{}: {}", file_.path().string(), line, problem), remedy);
  }

  bool begin() {
    TableHead head;
    for (std::size_t i = 0; i < form_.names.size(); ++i) {
      const bool stamp = form_.kinds[i] == CellKind::stamp;
      std::optional<double> epoch;
      if (stamp && form_.first_day) epoch = kDay * static_cast<double>(*form_.first_day);
      head.columns.push_back({form_.names[i], stamp ? "s" : form_.units[i], stamp, epoch});
    }
    head.notes = form_.notes;
    const std::vector<std::size_t> wanted = sink_.begin(head);
    slots_.assign(form_.names.size(), kNowhere);
    for (std::size_t w = 0; w < wanted.size(); ++w) slots_[wanted[w]] = w;
    block_.assign(wanted.size(), std::vector<double>(kBlockRows));
    last_stamp_.assign(form_.names.size(), -std::numeric_limits<double>::infinity());
    plain_ =
        std::ranges::none_of(form_.kinds, [](CellKind kind) { return kind == CellKind::stamp; });
    unread_.resize(form_.names.size());
    return !wanted.empty();
  }

  Result<void> read_pieces() {
    std::size_t at = form_.encoding.mark_bytes;
    std::string piece;
    std::string raw(kPiece, '\0');
    while (true) {
      const auto got = file_.read(at, raw.data(), raw.size());
      if (!got) return tl::unexpected(got.error());
      if (*got == 0) break;
      at += *got;
      append(piece, {raw.data(), *got});
      const auto cut = piece.rfind(form_.line_end);
      if (cut == piece.npos) {
        if (piece.size() > kLongestLine)
          return refused_at(line_ + 1, "a line longer than 1 MiB", "");
        continue;
      }
      if (auto done = read_lines({piece.data(), cut + 1}); !done) return done;
      piece.erase(0, cut + 1);
    }
    ended_ = true;
    if (piece.empty()) return {};
    piece += form_.line_end;
    return read_lines(piece);
  }

  void append(std::string& piece, std::string_view raw) const {
    const bool wide = form_.encoding.encoding == Encoding::utf16_little ||
                      form_.encoding.encoding == Encoding::utf16_big;
    if (wide) {
      piece += decoded(raw, form_.encoding.encoding);
    } else {
      piece.append(raw);
    }
  }

  /// Whole lines. Where every comma is a decimal one they become points at once.
  Result<void> read_lines(std::string_view lines) {
    const bool commas = form_.numbers.decimal == ',' && form_.delimiter != ',' && plain_ &&
                        !form_.numbers.grouped && lines.find('.') == lines.npos;
    if (commas) {
      with_points_.assign(lines);
      std::ranges::replace(with_points_, ',', '.');
      lines = with_points_;
    }
    numbers_ = commas ? NumberForm{'.', false} : form_.numbers;
    fast_ = plain_ && numbers_.decimal == '.' && !numbers_.grouped;
    while (!lines.empty()) {
      const std::size_t stop = lines.find(form_.line_end);
      const std::string_view line = lines.substr(0, stop);
      lines.remove_prefix(stop + 1);
      if (line_++ < form_.first_line) continue;
      if (line.size() > kLongestLine) return refused_at(line_, "a line longer than 1 MiB", "");
      if (rows_ + filled_ >= limits_.rows) {
        return refused_at(line_, fmt::format("more than {} rows", limits_.rows), "cut the file");
      }
      if (fast_ && read_fast(line)) {
        took_row();
      } else if (auto done = read_slowly(line); !done) {
        return done;
      }
    }
    return {};
  }

  void took_row() {
    if (++filled_ == kBlockRows) flush();
  }

  void flush() {
    if (filled_ == 0) return;
    for (auto& column : block_) column.resize(filled_);
    sink_.rows(block_);
    for (auto& column : block_) column.resize(kBlockRows);
    rows_ += std::exchange(filled_, 0);
  }

  static bool is_blank(char letter) { return letter == ' ' || letter == '\t' || letter == '\r'; }

  bool read_fast(std::string_view line) {
    const char* at = line.data();
    const char* const end = at + line.size();
    for (std::size_t i = 0; i < slots_.size(); ++i) {
      if (i > 0 && form_.delimiter != ' ' && (at == end || *at++ != form_.delimiter)) return false;
      const auto skip = [&] {
        while (at != end && is_blank(*at) && *at != form_.delimiter) ++at;
        if (form_.delimiter == ' ') {
          while (at != end && is_blank(*at)) ++at;
        }
      };
      skip();
      if (slots_[i] == kNowhere) {
        while (at != end && *at != form_.delimiter) {
          if (*at++ == '"') return false;
        }
        continue;
      }
      double value = 0.0;
      const auto [stop, code] = std::from_chars(at, end, value);
      if (code != std::errc{}) return false;
      at = stop;
      if (form_.delimiter == ' ' && at != end && !is_blank(*at)) return false;
      skip();
      block_[slots_[i]][filled_] = std::isfinite(value) ? value : kNothing;
    }
    return at == end;
  }

  Result<void> read_slowly(std::string_view line) {
    if (line.find_first_not_of(" \t\r\f") == line.npos || is_comment_line(line)) return {};
    split_text(line, form_.delimiter, cells_);
    const std::size_t width = slots_.size();
    if (cells_.size() == width + 1 && bare_cell(cells_.back()).empty()) cells_.pop_back();
    if (cells_.size() != width) {
      ragged_.add(line_, line);
      return {};
    }
    bool any = false;
    for (std::size_t i = 0; i < width; ++i) {
      if (slots_[i] == kNowhere) {
        any = any || form_.kinds[i] != CellKind::text;
        continue;
      }
      const auto value = cell(i, bare_cell(cells_[i]));
      if (!value) return tl::unexpected(value.error());
      any = any || std::isfinite(*value) || bare_cell(cells_[i]).empty();
      block_[slots_[i]][filled_] = *value;
    }
    if (any) {
      took_row();
    } else {
      ragged_.add(line_, line);
    }
    return {};
  }

  Result<double> cell(std::size_t column, std::string_view bare) {
    if (is_nothing(bare)) return kNothing;
    if (form_.kinds[column] == CellKind::stamp) {
      if (const auto stamp = parse_time_stamp(bare)) return seconds(column, *stamp);
    } else if (const auto number = text_number(bare, numbers_)) {
      return *number;
    }
    if (form_.kinds[column] == CellKind::number && looks_like_number(bare) && !is_cut()) {
      return tl::unexpected(
          refused_at(line_,
                     fmt::format("column {} '{}': '{}' is no number with a decimal {}{}",
                                 column + 1, shown(form_.names[column]), shown(bare),
                                 form_.numbers.decimal == ',' ? "comma" : "point",
                                 form_.numbers.grouped ? "" : " and no groups of digits"),
                     "state how numbers are written by --decimal and --delimiter, or mend the line")
              .error());
    }
    if (form_.kinds[column] != CellKind::text) unread_[column].add(line_, bare);
    return kNothing;
  }

  bool is_cut() const { return ended_; }

  /// Since midnight of the first day; a time of day that falls by more than half a day is of the
  /// next one.
  double seconds(std::size_t column, const TimeStamp& stamp) {
    double value = stamp.second;
    if (stamp.day)
      value += kDay * static_cast<double>(*stamp.day - form_.first_day.value_or(*stamp.day));
    double& last = last_stamp_[column];
    if (!stamp.day && std::isfinite(last)) value += kDay * std::round((last - value) / kDay);
    return last = value;
  }

  Result<void> say_incidents() {
    const std::size_t bearable = std::max<std::size_t>(3, rows_ / 100);
    if (ragged_.count > bearable) {
      return refused_at(ragged_.line,
                        fmt::format("'{}' is no row of {} cells, nor are {} other lines",
                                    ragged_.text, slots_.size(), ragged_.count - 1),
                        "give every row one cell a column");
    }
    if (ragged_.count > 0) {
      sink_.note(fmt::format("{} line{} left out that are no rows; the first is line {}, '{}'",
                             ragged_.count, ragged_.count == 1 ? "" : "s", ragged_.line,
                             ragged_.text));
    }
    for (std::size_t i = 0; i < unread_.size(); ++i) {
      if (unread_[i].count == 0) continue;
      sink_.note(fmt::format("column {} '{}': {} cells are no numbers; the first, '{}', on line {}",
                             i + 1, shown(form_.names[i]), unread_[i].count, unread_[i].text,
                             unread_[i].line));
    }
    return {};
  }

  const InputFile& file_;
  const TableLimits& limits_;
  const TextForm& stated_;
  TableSink& sink_;
  CsvForm form_;
  NumberForm numbers_;  ///< of the lines at hand
  std::vector<std::size_t> slots_;
  std::vector<std::vector<double>> block_;
  std::vector<std::string_view> cells_;
  std::vector<double> last_stamp_;
  std::vector<Incident> unread_;  ///< by column
  Incident ragged_;
  std::string with_points_;
  std::size_t line_ = 0;  ///< 1-based, of the line at hand
  std::size_t rows_ = 0;
  std::size_t filled_ = 0;  ///< of the block at hand
  bool plain_ = true;
  bool fast_ = true;
  bool ended_ = false;  ///< the line at hand is the file's last, without an end
};

Result<void> read(const std::filesystem::path& path, const TableRequest& request, TableSink& sink) {
  const auto file = InputFile::open(path);
  if (!file) return tl::unexpected(file.error());
  return CsvStream(*file, request, sink).run();
}

}  // namespace

TableReaderRow describe_csv() {
  return {.id = "csv",
          .says =
              "text tables: any delimiter, decimal comma, thousands, quotes, UTF-8, UTF-16 and "
              "Latin-1, comments, names on any line, units in them or below, time stamps",
          .knows = looks_like_text,
          .read = read};
}

}  // namespace flexspline::data
