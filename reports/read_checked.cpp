#include "read_checked.hpp"

#include <algorithm>
#include <functional>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "checksum.hpp"
#include "flexspline/core/case_store.hpp"
#include "flexspline/core/nesting.hpp"
#include "flexspline/core/text_place.hpp"
#include "flexspline/core/write_file.hpp"
#include "json_fields.hpp"
#include "parse_artefacts.hpp"

namespace flexspline::reports {
namespace {

/// The one artefact that a page is drawn from.
template <class View>
Result<View> read_view(const std::filesystem::path& path, std::string_view schema,
                       View (*parse)(const nlohmann::json&)) {
  const auto artefact = read_checked(path, schema);
  if (!artefact) return tl::unexpected(in_context(artefact.error(), path.string()));
  try {
    return parse(*artefact);
  } catch (const nlohmann::json::exception&) {
    return failure(ErrorCode::bad_data, path.string() + ": " + kOtherKind);
  }
}

/// How long diagnoses took lies beside the artefacts, which do not depend on it.
void add_wall_times(const std::filesystem::path& folder, TrialView& view) {
  std::map<std::string, double, std::less<>> by_key;
  const auto store = CaseStore::open(folder, [&](const CaseHead& head) {
    by_key.insert_or_assign(std::string(head.key), head.seconds);
  });
  if (!store || by_key.empty()) return;
  std::vector<double> all;
  for (ShownTrialCase& one : view.cases) {
    const auto found = by_key.find(one.key);
    if (found == by_key.end()) continue;
    one.seconds = found->second;
    all.push_back(one.seconds);
  }
  if (all.empty()) return;
  std::ranges::sort(all);
  view.scores.numbers["seconds_median"] = all[all.size() / 2];
  view.scores.numbers["seconds_max"] = all.back();
}

}  // namespace

using nlohmann::json;

Result<json> read_checked(const std::filesystem::path& path, std::string_view schema) {
  const auto text = read_file(path);
  if (!text) return tl::unexpected(text.error());
  return check_text(*text, schema);
}

Result<json> check_text(const std::string& text, std::string_view schema) {
  if (const auto flat = check_nesting(text); !flat) return tl::unexpected(flat.error());
  try {
    json artefact = json::parse(text);
    const std::string found = text_in(artefact, "schema");
    if (found != schema) {
      return failure(ErrorCode::bad_data,
                     "schema is \"" + found + "\", not \"" + std::string(schema) + "\"");
    }
    if (checksum_holds(text)) return artefact;
    return failure(ErrorCode::bad_data, "its checksum does not hold");
  } catch (const json::parse_error& error) {
    const TextPlace place = flexspline::place_of(text, error.byte > 0 ? error.byte - 1 : 0);
    return failure(ErrorCode::bad_data,
                   fmt::format("from line {}, column {} on it is not JSON; the file may be cut "
                               "short or damaged",
                               place.line, place.column));
  } catch (const json::exception&) {
    return failure(ErrorCode::bad_data, kOtherKind);
  }
}

Result<DiagnosisView> read_diagnosis(const std::filesystem::path& folder) {
  return read_view(folder / "diagnosis.json", "flexspline-diagnosis/1", parse_diagnosis);
}

Result<TrialView> read_trial(const std::filesystem::path& folder) {
  return read_view(folder / "trial.json", "flexspline-trial-result/1", parse_trial)
      .map([&](TrialView&& view) {
        add_wall_times(folder, view);
        return std::move(view);
      });
}

Result<VerificationView> read_verification(const std::filesystem::path& folder) {
  return read_view(folder / "verification.json", "flexspline-verification/1", parse_verification);
}

}  // namespace flexspline::reports
