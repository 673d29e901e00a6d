#include "journal_line.hpp"

#include <fmt/format.h>
#include <zlib.h>

namespace flexspline {
namespace {

constexpr std::size_t kSum = 8;  // hex digits of a checksum

std::string sum_of(std::string_view text) {
  const auto* bytes = reinterpret_cast<const Bytef*>(text.data());
  return fmt::format("{:08x}", crc32_z(0, bytes, text.size()));
}

}  // namespace

std::string journal_line(JournalFields fields) {
  std::size_t size = kSum + 1;
  for (const std::string_view field : fields) size += field.size() + 1;
  std::string line(kSum, '0');
  line.reserve(size);
  for (const std::string_view field : fields) line.append(1, '\t').append(field);
  line.replace(0, kSum, sum_of(std::string_view(line).substr(kSum + 1)));
  return line += '\n';
}

std::string_view checked_record(std::string_view line) {
  if (line.size() <= kSum || line[kSum] != '\t') return {};
  const std::string_view record = line.substr(kSum + 1);
  return sum_of(record) == line.substr(0, kSum) ? record : std::string_view{};
}

std::vector<std::string_view> fields_of(std::string_view record) {
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t tab = record.find('\t');
    fields.push_back(record.substr(0, tab));
    if (tab == std::string_view::npos) return fields;
    record.remove_prefix(tab + 1);
  }
}

}  // namespace flexspline
