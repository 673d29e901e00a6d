#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "flexspline/core/error.hpp"
#include "flexspline/studies/study_config.hpp"

namespace flexspline::studies {

inline constexpr std::string_view kVerificationSchema = "flexspline-verification/1";

/// How well two runs agree, best first. Bitwise: the same artefact but for wall-clock time.
/// Numeric: every number within the tolerance of its class. Statistical: as two measurements of one
/// thing agree, given their standard deviations. missing: only one of the runs has it.
enum class Agreement { bitwise, numeric, statistical, differs, missing };

std::string_view name_of(Agreement agreement);

/// What numbers of one kind are held to.
struct QuantityClass {
  std::string_view name;
  double relative = 0.0;     ///< numeric level: of the number, or of the largest in its list
  double of_std = 0.0;       ///< and this share of its standard deviation where it has one
  double statistical = 0.0;  ///< relative, at the statistical level
  std::string_view says;
};

/// Every class, as reports show it.
const std::vector<QuantityClass>& quantity_classes();

/// A number or text that is not the same.
struct Difference {
  std::string where;  ///< "estimate/parameters/a1/value"
  std::string quantity;
  std::string before, after;
  double over_tolerance = std::numeric_limits<double>::quiet_NaN();  ///< numbers only
  Agreement level = Agreement::differs;
};

struct ArtefactCheck {
  std::string artefact;  ///< relative to the folder
  Agreement level = Agreement::bitwise;
  std::size_t numbers = 0;          ///< compared
  std::size_t unequal = 0;          ///< of these, not the same to the last bit
  double largest = 0.0;             ///< difference over its tolerance
  std::vector<Difference> worst{};  ///< the largest few
  std::string reason{};             ///< why there was nothing to compare
};

/// What the two runs did not share: data, code, library, seed or configuration.
struct Circumstance {
  std::string kind, name, before, after;
};

struct Verification {
  std::string folder, against;
  Agreement level = Agreement::bitwise;
  std::string says;  ///< the result and its explanation in a sentence or two
  std::vector<Circumstance> changed;
  std::vector<ArtefactCheck> artefacts;

  /// Whether DIR says what the study gives: to within rounding, or as closely as changed
  /// circumstances let it. Never where the recordings are others.
  bool holds() const;
};

/// Compares two artefacts key by key. Wall-clock times, checksums and what names the program are
/// left out. The statistical level is granted only where something is known to have changed.
ArtefactCheck compare_artefacts(const nlohmann::ordered_json& before,
                                const nlohmann::ordered_json& after, bool something_changed);

/// Compares every artefact of two folders of one kind (study, fit, comparison, diagnosis, trial).
/// An artefact whose checksum does not hold differs, and says so; so does every other file of the
/// first that its manifest says was written otherwise.
/// Errors: input_missing where the first holds no artefact.
Result<Verification> verify_folders(const std::filesystem::path& folder,
                                    const std::filesystem::path& against);

/// Data sets, by their ids and the SHA-256 of their contents, that are not what a folder was made
/// from. A diagnosis calls its only one "recordings".
std::vector<Circumstance> other_data(const std::filesystem::path& folder,
                                     const std::map<std::string, std::string>& sha256);

/// The verification of a folder on other data: nothing is compared.
Verification verify_on_other_data(const std::filesystem::path& folder,
                                  std::vector<Circumstance> other);

/// flexspline-verification/1 (docs/artefacts.md).
nlohmann::ordered_json to_json(const Verification& verification);

/// The study that study.lock.toml holds. Relative data-set paths that are not found from here are
/// tried from data_root.
/// Errors: input_missing; bad_data when it is no lock file, or holds what only the study file says.
Result<StudyConfig> read_locked_study(const std::filesystem::path& lock,
                                      const std::filesystem::path& data_root = {});

}  // namespace flexspline::studies
