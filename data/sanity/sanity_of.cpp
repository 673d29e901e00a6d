#include <algorithm>

#include <fmt/format.h>

#include "flexspline/data/sanity.hpp"
#include "flexspline/data/sanity_codes.hpp"
#include "sanity/check.hpp"

namespace flexspline::data {
namespace {

void accept(SanityFinding& finding) {
  finding.severity = Severity::warning;
  finding.remedy = "accepted by the data set";
}

}  // namespace

std::string_view name_of(Severity severity) {
  return severity == Severity::error ? "error" : "warning";
}

std::string SanityFinding::message() const {
  const std::string where = recording.empty() ? "" : fmt::format("recording '{}': ", recording);
  return fmt::format("{}: {}{}; {}", code, where, what, remedy);
}

SanityFinding SanityVerdict::on(std::string recording, std::string what) const {
  return {std::string(code),  "", severity, std::move(recording), std::move(what),
          std::string(remedy)};
}

std::vector<SanityFinding> sanity_of(const RecordingSet& set) {
  const ObservedSet observed = observe(set);
  const auto accepted = accepted_findings(set);
  const auto is_accepted = [&](std::string_view code) {
    return std::ranges::find(accepted, code) != accepted.end();
  };
  std::vector<SanityFinding> findings;
  for (const SanityRow& row : sanity_checks()) {
    for (SanityFinding& finding : row.find(observed)) {
      finding.check = row.id;
      if (is_accepted(finding.code) || is_accepted(finding.check)) accept(finding);
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
