#include "flexspline/reports/table.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "numbers.hpp"

namespace flexspline::reports {
namespace {

Table example() {
  return {"example",
          "Errors of g⁻¹, 100 % & more",
          {{"input", "", 3}, {"error", "%", 2}},
          {{"a \"quoted\", name", 0.123456}, {"b|c_d", std::numeric_limits<double>::quiet_NaN()}}};
}

TEST(Table, CsvKeepsEveryDigitAndQuotesNames) {
  EXPECT_EQ(csv_of(example()), "input,error / %\n\"a \"\"quoted\"\", name\",0.123456\nb|c_d,\n");
}

TEST(TableText, KeepsFormulasOutOfSpreadsheets) {
  const Table table{"t", "", {{"a", "", 0}}, {{"=HYPERLINK(1)"}, {"@x"}, {"-2+3"}, {"-"}, {-2.0}}};
  EXPECT_EQ(csv_of(table), "a\n'=HYPERLINK(1)\n'@x\n'-2+3\n-\n-2\n");
}

TEST(Table, MarkdownHasARowOfUnitsAndEscapesBars) {
  EXPECT_EQ(markdown_of(example()),
            "| input | error |\n| --- | ---: |\n|  | % |\n| a \"quoted\", name | 0.12 |\n"
            "| b\\|c_d | – |\n\nErrors of g⁻¹, 100 % & more\n");
}

TEST(Table, LatexEscapesWhatItWouldTakeForCommands) {
  const std::string latex = latex_of(example());
  EXPECT_NE(latex.find("\\caption{Errors of g$^{-1}$, 100 \\% \\& more}"), std::string::npos);
  EXPECT_NE(latex.find("b|c\\_d & -- \\\\"), std::string::npos);
  EXPECT_NE(latex.find("\\begin{tabular}{lr}"), std::string::npos);
}

TEST(Table, LosesColumnsOfNumbersThatDoNotExist) {
  Table table = example();
  table.rows[0][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(csv_of(without_empty_columns(table)), "input\n\"a \"\"quoted\"\", name\"\nb|c_d\n");
  EXPECT_EQ(csv_of(without_empty_columns(example())), csv_of(example()));
}

TEST(Numbers, AreShownWithTheDigitsAskedForAndNeverAsZeroWhenAbsent) {
  EXPECT_EQ(digits(16.5412, 4), "16.54");
  EXPECT_EQ(digits(9.996, 3), "10.0");
  EXPECT_EQ(digits(-2970.4, 2), "-2970");
  EXPECT_EQ(digits(0.00012, 2), "1.2e-04");
  EXPECT_EQ(digits(0.0, 3), "0");
  EXPECT_EQ(digits(std::numeric_limits<double>::quiet_NaN(), 3), "–");
}

TEST(Numbers, AnErrorLargerThanItsSignalDiverged) {
  const Column errors = errors_of_signal("worst");
  EXPECT_EQ(shown(26100.0, errors), "diverged");
  EXPECT_EQ(shown(99.0, errors), "99");
  EXPECT_EQ(shown(std::nan(""), errors), shown(std::nan(""), {"worst", "%", 2}));
  const Table table{"t", "", {errors}, {{26100.0}}};
  EXPECT_EQ(csv_of(table), "worst / %\n26100\n") << "a file keeps the number";
}

TEST(Numbers, ThinningKeepsBothEnds) {
  std::vector<double> values;
  for (int i = 0; i < 100; ++i) values.push_back(i);
  for (const std::size_t most : {2u, 7u, 60u, 99u}) {
    const auto kept = thinned(values, most);
    EXPECT_LE(kept.size(), most + 1);
    EXPECT_EQ(kept.front(), 0.0);
    EXPECT_EQ(kept.back(), 99.0);
  }
}

TEST(Numbers, RangesOfAxesAreRoundAndHoldTheirData) {
  const auto [lower, upper] = widened(0.957, 1.003, 0.3);
  EXPECT_LE(lower, 0.957);
  EXPECT_GE(upper, 1.003);
  EXPECT_DOUBLE_EQ(lower, 0.94);
  EXPECT_DOUBLE_EQ(upper, 1.02);
}

TEST(Numbers, LabelsHaveNoZerosAtTheEnd) {
  EXPECT_EQ(compact(0.2, 4), "0.2");
  EXPECT_EQ(compact(200.0, 3), "200");
  EXPECT_EQ(compact(8.0, 6), "8");
}

TEST(Numbers, RemarksBecomeSentences) {
  EXPECT_EQ(sentence("it lags"), "It lags.");
  EXPECT_EQ(sentence("Already one."), "Already one.");
  EXPECT_EQ(sentence(""), "");
}

TEST(Numbers, SlugsAreFileNames) {
  EXPECT_EQ(slug("h even/../<b>"), "h-even-b");
  EXPECT_EQ(slug("<>"), "unnamed");
}

}  // namespace
}  // namespace flexspline::reports
