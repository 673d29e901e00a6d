#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "flexspline/core/error.hpp"

namespace flexspline::data {

inline constexpr std::string_view kCommitmentSchema = "flexspline-commitment/1";
inline constexpr std::string_view kSealedSchema = "flexspline-answer/1";

/// 64 hexadecimal digits from the operating system's randomness: an answer with few possible values
/// cannot be found by hashing them all.
/// Errors: defect where the system has no randomness.
Result<std::string> fresh_salt();

/// What is shown of an answer before it is asked for: the SHA-256 of the salt, a line feed and the
/// answer's canonical JSON (no white space, keys in their order: as it stands in the sealed file),
/// and what it is a commitment to.
nlohmann::ordered_json commitment_to(const nlohmann::ordered_json& answer, std::string_view salt,
                                     std::string_view what);

/// The answer with its salt, to be kept from who is asked.
nlohmann::ordered_json sealed(const nlohmann::ordered_json& answer, std::string_view salt);

/// The answer, if it is the one that was committed to.
/// Errors: bad_data when either is of another format, or the hash does not hold.
Result<nlohmann::ordered_json> unseal(const nlohmann::ordered_json& commitment,
                                      const nlohmann::ordered_json& sealed_answer);

/// The same for artefacts on disk.
/// Errors: input_missing, bad_data.
Result<nlohmann::ordered_json> unseal(const std::filesystem::path& commitment,
                                      const std::filesystem::path& sealed_answer);

}  // namespace flexspline::data
