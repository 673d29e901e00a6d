#include "tables/mdf_blocks.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <set>

#include "readers/cell_text.hpp"

namespace flexspline::data {
namespace {

constexpr std::uint64_t kHeadBytes = 24;
constexpr std::uint64_t kMostLinks = 65536;
constexpr std::uint64_t kMostData = std::uint64_t{1} << 22U;  // of a block that describes

std::uint64_t little(std::string_view bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = bytes.size(); i-- > 0;) {
    value = (value << 8U) | static_cast<unsigned char>(bytes[i]);
  }
  return value;
}

tl::unexpected<Error> damaged(std::uint64_t at, const std::string& why) {
  return failure(ErrorCode::bad_data, fmt::format("at byte {}: {}", at, why),
                 "the file is cut or damaged; measure or export it again");
}

/// "<CNunit><TX>Nm</TX></CNunit>" -> "Nm"
std::string text_in_xml(std::string_view xml) {
  const auto open = xml.find("<TX>");
  const auto close = xml.find("</TX>");
  if (open == xml.npos || close == xml.npos || close < open) return {};
  return std::string(xml.substr(open + 4, close - open - 4));
}

}  // namespace

std::uint64_t MdfBlock::number(std::size_t at, std::size_t bytes) const {
  if (at > data.size() || data.size() - at < bytes) return 0;
  return little(std::string_view(data).substr(at, bytes));
}

double MdfBlock::real(std::size_t at) const { return std::bit_cast<double>(number(at, 8)); }

Result<MdfFile::Head> MdfFile::head(std::uint64_t at) const {
  if (at > file_.size() || file_.size() - at < kHeadBytes) return damaged(at, "no block is there");
  const auto bytes = file_.read(at, kHeadBytes);
  if (!bytes) return tl::unexpected(bytes.error());
  if (bytes->size() < kHeadBytes || !bytes->starts_with("##"))
    return damaged(at, "no block is there");
  const std::string_view view(*bytes);
  const Head found{std::string(view.substr(2, 2)), little(view.substr(8, 8)),
                   little(view.substr(16, 8))};
  const bool holds = found.bytes >= kHeadBytes && found.bytes <= file_.size() - at &&
                     found.links <= kMostLinks && kHeadBytes + 8 * found.links <= found.bytes;
  if (!holds)
    return damaged(at, fmt::format("the block '{}' goes beyond the file", shown(found.kind)));
  return found;
}

Result<MdfFile::Extent> MdfFile::extent(std::uint64_t at, std::string_view kind) const {
  const auto found = head(at);
  if (!found) return tl::unexpected(found.error());
  if (found->kind != kind) {
    return damaged(at, fmt::format("block '{}' where '{}' belongs", shown(found->kind), kind));
  }
  const std::uint64_t skipped = kHeadBytes + 8 * found->links;
  return Extent{at + skipped, found->bytes - skipped};
}

Result<MdfBlock> MdfFile::block(std::uint64_t at, std::string_view kind) const {
  const auto found = head(at);
  if (!found) return tl::unexpected(found.error());
  const auto where = extent(at, kind);
  if (!where) return tl::unexpected(where.error());
  const auto links = file_.read(at + kHeadBytes, 8 * found->links);
  const auto data = file_.read(where->at, std::min(where->bytes, kMostData));
  if (!links || !data) return damaged(at, "it cannot be read");
  MdfBlock block{found->kind, {}, *data};
  for (std::size_t i = 0; 8 * i + 8 <= links->size(); ++i) {
    block.links.push_back(little(std::string_view(*links).substr(8 * i, 8)));
  }
  return block;
}

std::string MdfFile::kind_at(std::uint64_t at) const {
  const auto found = head(at);
  return found ? found->kind : std::string();
}

std::string MdfFile::text(std::uint64_t at) const {
  if (at == 0) return {};
  const bool is_xml = kind_at(at) == "MD";
  const auto found = block(at, is_xml ? "MD" : "TX");
  if (!found) return {};
  std::string text = found->data.substr(0, found->data.find('\0'));
  if (is_xml) text = text_in_xml(text);
  return is_utf8(text) ? text : utf8_of_latin1(text);
}

Result<std::vector<std::uint64_t>> MdfFile::chain(std::uint64_t first, std::string_view kind,
                                                  std::size_t most) const {
  std::vector<std::uint64_t> places;
  std::set<std::uint64_t> seen;
  for (std::uint64_t at = first; at != 0;) {
    if (!seen.insert(at).second) return damaged(at, "its links go round in a circle");
    if (places.size() == most)
      return damaged(at, fmt::format("more than {} blocks '{}'", most, kind));
    const auto found = block(at, kind);
    if (!found) return tl::unexpected(found.error());
    places.push_back(at);
    at = found->link(0);
  }
  return places;
}

}  // namespace flexspline::data
