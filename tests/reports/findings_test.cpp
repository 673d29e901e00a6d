#include "findings.hpp"

#include <algorithm>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "flexspline/reports/diagnosis_view.hpp"

namespace flexspline::reports {
namespace {

std::string text_of(const Section& section) {
  std::string text;
  for (const Block& block : section.blocks) {
    if (const auto* said = std::get_if<Verdict>(&block.content)) text += said->text + "\n";
    if (const auto* said = std::get_if<Paragraph>(&block.content)) text += said->text + "\n";
  }
  return text;
}

TEST(Findings, SayThatNothingLooksMistaken) {
  EXPECT_EQ(text_of(findings_section({{"a", {}}})),
            "Nothing in the recordings looks mistaken: units, signs, the gear ratio, every channel "
            "and the time were looked at.\n");
}

TEST(Findings, AreCountedAndSaidWithTheirDataSet) {
  const LookedAt bench{"bench", {{"error", "check_sign: the loop runs backwards"}}};
  const LookedAt other{"other", {{"warning", "a"}, {"warning", "b"}}};
  EXPECT_EQ(text_of(findings_section({bench, other})),
            "The recordings look mistaken: 1 error and 2 warnings.\n"
            "bench: error: check_sign: the loop runs backwards\n"
            "other: warning: a\nother: warning: b\n");
}

TEST(Findings, ComeFirstOnThePageOfADiagnosis) {
  const auto rows = diagnosis_sections();
  const auto first = std::ranges::min_element(rows, {}, &DiagnosisSectionRow::order);
  DiagnosisView view;
  view.findings = {{"warning", "check_channel: late"}};
  const auto section = first->draw(view);
  ASSERT_TRUE(section);
  EXPECT_EQ(text_of(*section),
            "The recordings look mistaken: 1 warning.\nwarning: check_channel: late\n");
}

}  // namespace
}  // namespace flexspline::reports
