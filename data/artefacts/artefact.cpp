#include "flexspline/data/artefact.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "flexspline/core/nesting.hpp"
#include "flexspline/core/text_place.hpp"
#include "flexspline/core/write_file.hpp"
#include "flexspline/data/checksum.hpp"

namespace flexspline::data {
namespace {

using Json = nlohmann::ordered_json;

/// Bytes that are no UTF-8 (a name out of an old file) are replaced, so that dumping cannot fail.
std::string canonical(const Json& content) {
  return content.dump(-1, ' ', false, Json::error_handler_t::replace);
}

tl::unexpected<Error> refused(const std::filesystem::path& path, const std::string& why) {
  return failure(ErrorCode::bad_data, fmt::format("{}: {}", path.string(), why),
                 "make it again with the command that wrote it");
}

bool has_text(const Json& content, std::string_view key, std::string_view text) {
  const auto found = content.find(key);
  return found != content.end() && found->is_string() &&
         found->get_ref<const std::string&>() == text;
}

std::string shown(const Json& content, std::string_view key) {
  const auto found = content.find(key);
  return found == content.end() ? "none" : canonical(*found);
}

/// What the writer adds to the canonical dump of a content, in the place of its closing brace.
std::string seal_of(const std::string& sum) { return fmt::format(",\"sha256\":\"{}\"}}\n", sum); }

/// Whether the text is, byte for byte, what the writer makes of its content: then the checksum is
/// that of the text, and nothing has to be dumped again.
bool is_as_written(std::string_view text) {
  while (text.ends_with('\n')) text.remove_suffix(1);
  const std::size_t seal = seal_of(std::string(64, '0')).size() - 1;
  if (text.size() <= seal) return false;
  Sha256 sum;
  sum.add(text.substr(0, text.size() - seal));
  sum.add("}");
  return text.ends_with(std::string_view(seal_of(sum.hex())).substr(0, seal));
}

}  // namespace

Result<Json> parse_json(std::string_view text, const std::filesystem::path& path) {
  if (const auto flat = check_nesting(text); !flat) {
    return refused(path.string(), flat.error().problem);
  }
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    const TextPlace place = place_of(text, error.byte > 0 ? error.byte - 1 : 0);
    return refused(fmt::format("{}:{}:{}", path.string(), place.line, place.column),
                   "from here on it is not JSON; the file may be cut short or damaged");
  } catch (const Json::out_of_range&) {
    return refused(path.string(), "it holds a number beyond 1e308; the file may be damaged");
  }
}

std::string sealed(Json content) {
  content.erase("sha256");
  std::string text = canonical(content);
  const std::string seal = seal_of(sha256_hex(text));
  return text.replace(text.size() - 1, 1, seal, 0, seal.size() - 1);
}

Result<void> write_artefact(const std::filesystem::path& path, Json content) {
  return write_file(path, sealed(std::move(content)) + "\n");
}

Result<Json> read_artefact(const std::filesystem::path& path, std::string_view schema) {
  const Result<std::string> text = read_file(path);
  if (!text) return tl::unexpected<Error>(text.error());
  return parse_artefact(*text, path, schema);
}

Result<Json> parse_artefact(std::string_view text, const std::filesystem::path& path,
                            std::string_view schema) {
  Result<Json> parsed = parse_json(text, path);
  if (!parsed) return parsed;
  Json& content = *parsed;
  if (!content.is_object()) return refused(path, "not a JSON object");
  if (!has_text(content, "schema", schema)) {
    return refused(path, fmt::format("schema is {}, not \"{}\"", shown(content, "schema"), schema));
  }
  const Json written = content.value("sha256", Json());
  content.erase("sha256");
  if (is_as_written(text)) return parsed;
  const std::string sum = sha256_hex(canonical(content));
  if (written != sum) {
    return refused(path, fmt::format("checksum does not hold: sha256 is {}, the content gives {}",
                                     canonical(written), sum));
  }
  return parsed;
}

}  // namespace flexspline::data
