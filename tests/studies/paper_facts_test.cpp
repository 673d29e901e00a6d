#include <gtest/gtest.h>

#include "flexspline/studies/paper_facts.hpp"

namespace flexspline::studies {
namespace {

TEST(PaperFacts, AgreeWithWhatIsPublishedToEveryDigit) {
  const auto facts = paper_facts();
  EXPECT_GE(facts.size(), 30U);
  for (const PaperFact& fact : facts) {
    EXPECT_DOUBLE_EQ(std::stod(rounded(fact.value, fact.digits)), std::stod(fact.published))
        << fact.id << " = " << fact.value;
  }
}

TEST(PaperFacts, AreaByQuadratureIsTheClosedForm) {
  double quadrature = 0.0;
  double closed = 1.0;
  for (const PaperFact& fact : paper_facts()) {
    if (fact.id == "loop_area") quadrature = fact.value;
    if (fact.id == "loop_area_closed_form") closed = fact.value;
  }
  EXPECT_NEAR(quadrature / closed, 1.0, 1e-12);
}

TEST(Rounded, KeepsSignificantDigits) {
  EXPECT_EQ(rounded(16.5407, 4), "16.54");
  EXPECT_EQ(rounded(0.0430761, 3), "0.0431");
  EXPECT_EQ(rounded(11380.6, 5), "11381");
  EXPECT_EQ(rounded(-1540.39, 3), "-1540");
  EXPECT_EQ(rounded(9.996, 3), "10.0");
}

}  // namespace
}  // namespace flexspline::studies
