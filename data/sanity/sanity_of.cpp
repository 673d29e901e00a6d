#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "flexspline/core/nearest_name.hpp"
#include "flexspline/data/sanity.hpp"
#include "sanity/check.hpp"

namespace flexspline::data {
namespace {

constexpr std::array<std::string_view, 4> kCodes = {"check_units", "check_sign", "check_ratio",
                                                    "check_channel"};

bool is_accepted(const RecordingSet& set, const SanityFinding& finding) {
  return std::ranges::any_of(set.accepted, [&](const std::string& one) {
    return one == finding.code || one == finding.check;
  });
}

void accept(SanityFinding& finding) {
  finding.severity = Severity::warning;
  finding.remedy = "accepted by the data set";
}

std::vector<std::string_view> known_codes() {
  std::vector<std::string_view> known(kCodes.begin(), kCodes.end());
  for (const SanityRow& row : sanity_checks()) known.push_back(row.id);
  return known;
}

}  // namespace

bool is_sanity_code(std::string_view code) {
  const auto known = known_codes();
  return std::ranges::find(known, code) != known.end();
}

std::string sanity_code_suggestion(std::string_view code) {
  return suggestion(code, known_codes());
}

std::string_view name_of(Severity severity) {
  return severity == Severity::error ? "error" : "warning";
}

std::string SanityFinding::message() const {
  const std::string where = recording.empty() ? "" : fmt::format("recording '{}': ", recording);
  return fmt::format("{}: {}{}; {}", code, where, what, remedy);
}

std::vector<SanityFinding> sanity_of(const RecordingSet& set) {
  const ObservedSet observed = observe(set);
  std::vector<SanityFinding> findings;
  for (const SanityRow& row : sanity_checks()) {
    for (SanityFinding& finding : row.find(observed)) {
      finding.check = row.id;
      if (is_accepted(set, finding)) accept(finding);
      findings.push_back(std::move(finding));
    }
  }
  std::ranges::stable_sort(findings, std::ranges::greater{}, &SanityFinding::severity);
  return findings;
}

bool stops_science(const std::vector<SanityFinding>& findings) {
  return std::ranges::any_of(
      findings, [](const SanityFinding& one) { return one.severity == Severity::error; });
}

}  // namespace flexspline::data
