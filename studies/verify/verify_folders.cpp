#include <algorithm>
#include <array>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "flexspline/core/case_store.hpp"
#include "flexspline/core/write_file.hpp"
#include "flexspline/data/artefact.hpp"
#include "flexspline/data/manifest.hpp"
#include "flexspline/studies/verify.hpp"
#include "verify/circumstances.hpp"

namespace flexspline::studies {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr std::string_view kCases = "cases/";

/// A folder of artefacts, with what it holds of cases.
struct Folder {
  fs::path path;
  CaseStore cases;
};

/// Artefacts of a folder by their place in it; those that are drawn from others are left out.
std::set<std::string> artefacts_in(const Folder& folder) {
  std::set<std::string> names;
  for (const char* name : {"paper.json", "kind.json", "diagnosis.json", "trial.json"}) {
    if (file_exists(folder.path / name)) names.insert(name);
  }
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder.path / "inputs", ignored)) {
    const fs::path& path = entry.path();
    if (path.extension() == ".json") names.insert("inputs/" + path.filename().string());
  }
  for (const std::string& key : folder.cases.keys()) {
    names.insert(std::string(kCases) + key + ".json");
  }
  return names;
}

/// The text of an artefact, wherever the folder keeps it.
Result<std::string> text_of(const Folder& folder, const std::string& name) {
  if (!name.starts_with(kCases)) return read_file(folder.path / name);
  const std::string file = name.substr(kCases.size());
  return folder.cases.read(file.substr(0, file.size() - std::string_view(".json").size()))
      .map([](const StoredCase& one) { return one.artefact; });
}

/// An artefact whose checksum holds, whatever its schema is.
Result<ordered_json> read_any(const Folder& folder, const std::string& name) {
  const auto text = text_of(folder, name);
  if (!text) return tl::unexpected(text.error());
  const fs::path file = folder.path / name;
  const auto content = data::parse_json(*text, file);
  if (!content) return content;
  const bool named =
      content->is_object() && content->contains("schema") && content->at("schema").is_string();
  return data::parse_artefact(*text, file, named ? content->at("schema").get<std::string>() : "");
}

ArtefactCheck broken(const std::string& name, const char* whose, const Error& error) {
  ArtefactCheck check;
  check.artefact = name;
  check.level = error.code == ErrorCode::input_missing ? Agreement::missing : Agreement::differs;
  check.reason = check.level == Agreement::missing
                     ? fmt::format("only the other run has it, not {}", whose)
                     : fmt::format("in {}: {}", whose, error.problem);
  return check;
}

ArtefactCheck check_one(const std::string& name, const Folder& folder, const Folder& against,
                        bool changed) {
  const auto before = read_any(folder, name);
  if (!before) return broken(name, "the folder to verify", before.error());
  const auto after = read_any(against, name);
  if (!after) return broken(name, "the run to compare with", after.error());
  ArtefactCheck check = compare_artefacts(*before, *after, changed);
  check.artefact = name;
  return check;
}

/// Kinds of what changed, each once.
std::string kinds_of(const std::vector<Circumstance>& changed) {
  std::vector<std::string> kinds;
  for (const Circumstance& one : changed) {
    if (std::ranges::find(kinds, one.kind) == kinds.end()) kinds.push_back(one.kind);
  }
  return fmt::format("{}", fmt::join(kinds, ", "));
}

std::string explanation_of(const Verification& verification) {
  const std::string kinds = kinds_of(verification.changed);
  switch (verification.level) {
    case Agreement::bitwise:
      return kinds.empty() ? "Data, code, libraries, seeds and configuration are the same."
                           : fmt::format("That although these changed: {}.", kinds);
    case Agreement::numeric:
      return kinds.empty()
                 ? "Nothing that is recorded changed: it is rounding, within the tolerances."
                 : fmt::format("What is different is within the tolerances; changed: {}.", kinds);
    default:
      break;
  }
  if (kinds.empty()) {
    return "Data, code, libraries, seeds and configuration are the same, so none of them explains "
           "it: an artefact was changed or lost after it was written, or the computation is not "
           "repeatable.";
  }
  return fmt::format("What changed since, and may explain it: {}.", kinds);
}

std::string result_of(const Verification& verification) {
  std::map<Agreement, std::size_t> counts;
  for (const ArtefactCheck& one : verification.artefacts) ++counts[one.level];
  std::vector<std::string> parts;
  for (const auto& [level, count] : counts) {
    constexpr std::array<const char*, 5> kWords = {
        "the same to the last bit", "the same within tolerance", "in statistical agreement",
        "different", "missing"};
    parts.push_back(fmt::format("{} {}", count, kWords[static_cast<std::size_t>(level)]));
  }
  return fmt::format("Of {} artefacts, {}.", verification.artefacts.size(), fmt::join(parts, ", "));
}

bool is_other_data(const Circumstance& one) {
  return one.kind == "data" && one.name.ends_with("/sha256");
}

void enter(const data::ChangedFile& changed, Verification& verification) {
  auto& checks = verification.artefacts;
  auto check = std::ranges::find(checks, changed.file, &ArtefactCheck::artefact);
  if (check == checks.end()) {
    check = checks.insert(checks.end(), ArtefactCheck{.artefact = changed.file});
  }
  check->level = changed.missing ? Agreement::missing : Agreement::differs;
  check->reason = changed.missing ? "it was written, and is gone"
                                  : "it was changed after it was written (manifest.json)";
  verification.level = std::max(verification.level, check->level);
}

/// Every file of the folder, drawn ones too, against what was written.
void check_files(const fs::path& folder, Verification& verification) {
  const auto manifest = data::read_manifest(folder);
  if (!manifest || !manifest->finished) {
    verification.says +=
        fmt::format(" {}: results.nc, tables and pages were not checked.",
                    manifest ? "The folder was never finished" : "There is no valid manifest.json");
    return;
  }
  const auto changed = data::changed_files(folder, *manifest);
  for (const data::ChangedFile& one : changed) enter(one, verification);
  std::vector<std::string> names;
  for (const data::ChangedFile& one : changed) names.push_back(one.file);
  verification.says +=
      names.empty() ? fmt::format(" All {} files are as they were written.", manifest->files.size())
                    : fmt::format(" Of {} files, {} are not as they were written: {}.",
                                  manifest->files.size(), names.size(), fmt::join(names, ", "));
}

}  // namespace

std::string_view name_of(Agreement agreement) {
  constexpr std::array<std::string_view, 5> names = {"bitwise", "numeric", "statistical", "differs",
                                                     "missing"};
  return names[static_cast<std::size_t>(agreement)];
}

bool Verification::holds() const {
  return level <= Agreement::statistical && std::ranges::none_of(changed, is_other_data);
}

Verification verify_on_other_data(const fs::path& folder, std::vector<Circumstance> other) {
  Verification verification{folder.string(), "", Agreement::differs, {}, std::move(other), {}};
  verification.says =
      "The recordings are not those that this was made from. Nothing was computed again.";
  return verification;
}

Result<Verification> verify_folders(const fs::path& folder, const fs::path& against) {
  Verification verification{folder.string(), against.string(), {}, {}, {}, {}};
  for (const fs::path& path : {folder, against}) {
    std::error_code error;
    const bool there = fs::exists(path, error);
    if (there || !error) continue;
    return failure(ErrorCode::input_missing,
                   fmt::format("cannot use '{:.200}': {}", path.string(), error.message()),
                   "check the path");
  }
  auto own = CaseStore::open(folder);
  auto other = CaseStore::open(against);
  if (!own || !other) return tl::unexpected(own ? other.error() : own.error());
  const Folder before{folder, std::move(*own)};
  const Folder after{against, std::move(*other)};
  std::set<std::string> names = artefacts_in(before);
  if (names.empty()) {
    return failure(ErrorCode::input_missing, folder.string() + " holds no artefact to verify",
                   "give the folder that run, fit, compare, diagnose or trial wrote");
  }
  std::set<std::string> others = artefacts_in(after);
  if (others.empty()) {
    return failure(ErrorCode::input_missing, against.string() + " holds no artefact to compare with",
                   "give the folder of the other run");
  }
  names.merge(others);
  verification.changed = changed_circumstances(folder, against);
  for (const std::string& name : names) {
    verification.artefacts.push_back(check_one(name, before, after, !verification.changed.empty()));
    verification.level = std::max(verification.level, verification.artefacts.back().level);
  }
  verification.says = result_of(verification) + " " + explanation_of(verification);
  check_files(folder, verification);
  return verification;
}

}  // namespace flexspline::studies
