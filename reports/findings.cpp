#include "findings.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "json_fields.hpp"

namespace flexspline::reports {
namespace {

constexpr const char* kNothing =
    "Nothing in the recordings looks mistaken: units, signs, the gear ratio, every channel and the "
    "time were looked at.";

std::string counted(long count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

}  // namespace

ShownFinding parse_finding(const nlohmann::json& from) {
  return {text_in(from, "severity"), text_in(from, "says")};
}

Section findings_section(const std::vector<LookedAt>& recordings) {
  Section section{"recordings", "Before any physics: the recordings", {}};
  long errors = 0;
  long all = 0;
  std::vector<Paragraph> says;
  for (const LookedAt& one : recordings) {
    for (const ShownFinding& finding : one.findings) {
      ++all, errors += finding.severity == "error" ? 1 : 0;
      says.push_back(
          {(one.name.empty() ? "" : one.name + ": ") + finding.severity + ": " + finding.says});
    }
  }
  if (all == 0) {
    section.add(Paragraph{kNothing});
    return section;
  }
  const std::string found =
      errors == 0     ? counted(all, "warning")
      : errors == all ? counted(errors, "error")
                      : counted(errors, "error") + " and " + counted(all - errors, "warning");
  section.add(Verdict{"The recordings look mistaken: " + found + "."});
  for (Paragraph& one : says) section.add(std::move(one));
  return section;
}

}  // namespace flexspline::reports
