#include "findings.hpp"

namespace flexspline::reports {
namespace {

std::optional<Section> draw(const StudyView& view) {
  std::vector<LookedAt> recordings;
  for (const Input& input : view.artefacts().inputs) {
    if (input.findings) recordings.push_back({input.title, *input.findings});
  }
  if (recordings.empty()) return std::nullopt;
  return findings_section(recordings);
}

}  // namespace

SectionRow describe_findings() { return {-8, draw}; }

}  // namespace flexspline::reports
