#include "tables/table_message.hpp"

#include <cstring>

namespace flexspline::data {

void MessageWriter::number(std::uint64_t value) {
  bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void MessageWriter::real(double value) {
  bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void MessageWriter::text(std::string_view value) {
  number(value.size());
  bytes_.append(value);
}

void MessageWriter::reals(std::span<const double> values) {
  number(values.size());
  bytes_.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
}

std::optional<std::uint64_t> MessageReader::number() {
  std::uint64_t value = 0;
  if (rest_.size() < sizeof value) return std::nullopt;
  std::memcpy(&value, rest_.data(), sizeof value);
  rest_.remove_prefix(sizeof value);
  return value;
}

std::optional<double> MessageReader::real() {
  double value = 0.0;
  if (rest_.size() < sizeof value) return std::nullopt;
  std::memcpy(&value, rest_.data(), sizeof value);
  rest_.remove_prefix(sizeof value);
  return value;
}

std::optional<std::string> MessageReader::text() {
  const auto size = number();
  if (!size || *size > rest_.size()) return std::nullopt;
  std::string value(rest_.substr(0, *size));
  rest_.remove_prefix(*size);
  return value;
}

std::optional<std::vector<double>> MessageReader::reals() {
  const auto size = number();
  if (!size || *size > rest_.size() / sizeof(double)) return std::nullopt;
  std::vector<double> values(*size);
  if (*size > 0) std::memcpy(values.data(), rest_.data(), *size * sizeof(double));
  rest_.remove_prefix(*size * sizeof(double));
  return values;
}

std::string bytes_of(const TableHead& head) {
  MessageWriter to;
  to.text(head.path);
  to.number(head.columns.size());
  for (const TableColumn& column : head.columns) {
    to.text(column.name);
    to.text(column.unit);
    to.number(column.clock ? 1 : 0);
    to.number(column.epoch_s ? 1 : 0);
    to.real(column.epoch_s.value_or(0.0));
  }
  to.number(head.notes.size());
  for (const std::string& note : head.notes) to.text(note);
  return to.bytes();
}

std::optional<TableHead> table_head(std::string_view bytes, const TableLimits& limits) {
  MessageReader from(bytes);
  TableHead head;
  const auto path = from.text();
  const auto columns = from.number();
  if (!path || !columns || *columns > limits.columns) return std::nullopt;
  head.path = *path;
  for (std::uint64_t i = 0; i < *columns; ++i) {
    const auto name = from.text();
    const auto unit = from.text();
    const auto clock = from.number();
    const auto dated = from.number();
    const auto epoch = from.real();
    if (!name || !unit || !clock || !dated || !epoch) return std::nullopt;
    head.columns.push_back(
        {*name, *unit, *clock == 1, *dated == 1 ? std::optional(*epoch) : std::nullopt});
  }
  const auto notes = from.number();
  if (!notes) return std::nullopt;
  for (std::uint64_t i = 0; i < *notes; ++i) {
    const auto note = from.text();
    if (!note) return std::nullopt;
    head.notes.push_back(*note);
  }
  return from.ended() ? std::optional(std::move(head)) : std::nullopt;
}

}  // namespace flexspline::data
