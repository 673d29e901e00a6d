#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "flexspline/data/table_reader.hpp"
#include "tables/csv_form.hpp"
#include "tables/csv_rows.hpp"
#include "tables/input_file.hpp"

namespace flexspline::data {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 21U;
constexpr std::size_t kLongestLine = std::size_t{1} << 20U;
constexpr double kDay = 86400.0;

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
    return rows_->finish();
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
    if (!wanted.empty()) rows_.emplace(form_, wanted, file_.path().string(), sink_);
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
    const bool commas = form_.numbers.decimal == ',' && form_.delimiter != ',' &&
                        !rows_->has_stamps() && !form_.numbers.grouped &&
                        lines.find('.') == lines.npos;
    if (commas) {
      with_points_.assign(lines);
      std::ranges::replace(with_points_, ',', '.');
      lines = with_points_;
    }
    rows_->use(commas ? NumberForm{'.', false} : form_.numbers);
    while (!lines.empty()) {
      const std::size_t stop = lines.find(form_.line_end);
      const std::string_view line = lines.substr(0, stop);
      lines.remove_prefix(stop + 1);
      if (line_++ < form_.first_line) continue;
      if (line.size() > kLongestLine) return refused_at(line_, "a line longer than 1 MiB", "");
      if (rows_->rows() >= limits_.rows) {
        return refused_at(line_, fmt::format("more than {} rows", limits_.rows), "cut the file");
      }
      if (auto done = rows_->take(line, line_, ended_); !done) return done;
    }
    return {};
  }

  const InputFile& file_;
  const TableLimits& limits_;
  const TextForm& stated_;
  TableSink& sink_;
  CsvForm form_;
  std::optional<CsvRows> rows_;
  std::string with_points_;
  std::size_t line_ = 0;  ///< 1-based, of the line at hand
  bool ended_ = false;    ///< the line at hand is the file's last, without an end
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
