#include "checksum.hpp"

#include <array>

#include <fmt/format.h>
#include <openssl/evp.h>
#include <nlohmann/json.hpp>

namespace flexspline::reports {

std::string sha256_of(std::string_view bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int length = 0;
  EVP_Digest(bytes.data(), bytes.size(), digest.data(), &length, EVP_sha256(), nullptr);
  std::string text;
  for (unsigned int i = 0; i < length; ++i) text += fmt::format("{:02x}", digest.at(i));
  return text;
}

namespace {

/// Byte for byte what a writer makes of its content: the canonical dump, the checksum last. A file
/// ends with its line, a record of a journal does not.
bool is_as_written(std::string_view artefact) {
  if (artefact.ends_with('\n')) artefact.remove_suffix(1);
  const auto seal = [](const std::string& sum) { return ",\"sha256\":\"" + sum + "\"}"; };
  const std::size_t length = seal(std::string(64, '0')).size();
  if (artefact.size() <= length) return false;
  std::string content(artefact.substr(0, artefact.size() - length));
  content += '}';
  return artefact.ends_with(seal(sha256_of(content)));
}

}  // namespace

bool checksum_holds(const std::string& artefact) {
  if (is_as_written(artefact)) return true;
  auto content = nlohmann::ordered_json::parse(artefact);
  if (!content.is_object() || !content.contains("sha256")) return false;
  const auto stated = content["sha256"];
  content.erase("sha256");
  const auto replace = nlohmann::ordered_json::error_handler_t::replace;
  return stated.is_string() &&
         stated.get<std::string>() == sha256_of(content.dump(-1, ' ', false, replace));
}

}  // namespace flexspline::reports
