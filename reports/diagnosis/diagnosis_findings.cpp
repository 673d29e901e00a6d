#include "findings.hpp"
#include "flexspline/reports/diagnosis_view.hpp"

namespace flexspline::reports {
namespace {

std::optional<Section> draw(const DiagnosisView& view) {
  return findings_section({{"", view.findings}});
}

}  // namespace

DiagnosisSectionRow describe_diagnosis_findings() { return {-10, draw}; }

}  // namespace flexspline::reports
