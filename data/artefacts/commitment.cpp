#include "flexspline/data/commitment.hpp"

#include <array>
#include <cerrno>
#include <cstring>

#include <sys/random.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "flexspline/data/artefact.hpp"
#include "flexspline/data/checksum.hpp"

namespace flexspline::data {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kAlgorithm =
    "SHA-256 of the salt, a line feed and the canonical JSON of the answer";

std::string hash_of(const Json& answer, std::string_view salt) {
  return sha256_hex(fmt::format("{}\n{}", salt, answer.dump()));
}

std::string text_of(const Json& content, const char* key) {
  const auto found = content.find(key);
  return found != content.end() && found->is_string() ? found->get<std::string>() : "";
}

tl::unexpected<Error> refused(std::string why) {
  return failure(ErrorCode::bad_data, std::move(why),
                 "an answer counts only with the commitment that was made with it");
}

}  // namespace

Result<std::string> fresh_salt() {
  std::array<unsigned char, 32> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    return failure(ErrorCode::defect, fmt::format("the operating system gives no randomness: {}",
                                                  std::strerror(errno)));
  }
  std::string salt;
  for (const unsigned char byte : bytes) salt += fmt::format("{:02x}", byte);
  return salt;
}

Json commitment_to(const Json& answer, std::string_view salt, std::string_view what) {
  return {{"schema", kCommitmentSchema},
          {"algorithm", kAlgorithm},
          {"hash", hash_of(answer, salt)},
          {"commits_to", what}};
}

Json sealed(const Json& answer, std::string_view salt) {
  return {{"schema", kSealedSchema}, {"salt", salt}, {"answer", answer}};
}

Result<Json> unseal(const Json& commitment, const Json& sealed_answer) {
  if (text_of(commitment, "schema") != kCommitmentSchema) {
    return refused(fmt::format("not a commitment of schema \"{}\"", kCommitmentSchema));
  }
  if (text_of(commitment, "algorithm") != kAlgorithm) {
    return refused(fmt::format("the commitment's algorithm \"{}\" is unknown",
                               text_of(commitment, "algorithm")));
  }
  const std::string salt = text_of(sealed_answer, "salt");
  if (text_of(sealed_answer, "schema") != kSealedSchema || salt.empty() ||
      !sealed_answer.contains("answer")) {
    return refused(fmt::format("not a sealed answer of schema \"{}\"", kSealedSchema));
  }
  const Json answer = sealed_answer.at("answer");
  const std::string hash = hash_of(answer, salt);
  if (hash == text_of(commitment, "hash")) return answer;
  return refused(fmt::format("the answer is not what was committed to: its hash is {}, not {}",
                             hash, text_of(commitment, "hash")));
}

Result<Json> unseal(const std::filesystem::path& commitment,
                    const std::filesystem::path& sealed_answer) {
  const auto open = read_artefact(commitment, kCommitmentSchema);
  if (!open) return tl::unexpected(open.error());
  const auto closed = read_artefact(sealed_answer, kSealedSchema);
  if (!closed) return tl::unexpected(closed.error());
  return unseal(*open, *closed);
}

}  // namespace flexspline::data
