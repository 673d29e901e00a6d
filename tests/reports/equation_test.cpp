#include "flexspline/reports/equation.hpp"

#include <regex>
#include <vector>

#include <gtest/gtest.h>

#include "flexspline/core/effect.hpp"

namespace flexspline::reports {
namespace {

TEST(Equation, SetsWhatTheNotationMeans) {
  EXPECT_EQ(tex_of("tau_f += mu |tau|/N tanh(w/we)"),
            "\\tau_{f} \\mathrel{\\text{+=}} \\mu \\frac{\\left|\\tau\\right|}{N} \\tanh "
            "\\left(\\frac{w}{w_{e}}\\right)");
  EXPECT_EQ(tex_of("z' = w - s0 |w| z/g"), "z' = w - s_{0} \\left|w\\right| \\frac{z}{g}");
  EXPECT_EQ(tex_of("phi_e = phi - b tau/sqrt(tau^2 + t^2)"),
            "\\phi_{e} = \\phi - b \\frac{\\tau}{\\sqrt{{\\tau}^{2} + {t}^{2}}}");
  EXPECT_EQ(tex_of("sum_i k_i s_i, s_i' = phi' unless |s_i| = r_i"),
            "\\sum_{i} k_{i} s_{i} ,\\;\\; s_{i}' = \\phi' \\text{ unless } \\left|s_{i}\\right| = "
            "r_{i}");
  EXPECT_EQ(tex_of("theta_l,measured = q round(theta_l/q)"),
            "\\theta_{l,\\mathrm{measured}} = q \\operatorname{round} "
            "\\left(\\frac{\\theta_{l}}{q}\\right)");
  EXPECT_EQ(tex_of("tau = g^-1(phi'/h(phi)) + f(phi)"),
            "\\tau = {g}^{- 1} \\left(\\frac{\\phi'}{h \\left(\\phi\\right)}\\right) + f "
            "\\left(\\phi\\right)");
}

/// Every element is closed in its order, and scripts have as many parts as they need.
void expect_well_formed(const std::string& ml) {
  static const std::regex tag(R"(<(/?)([a-z]+)[^>]*?(/?)>)");
  std::vector<std::pair<std::string, int>> open = {{"", 0}};
  for (std::sregex_iterator at(ml.begin(), ml.end(), tag), end; at != end; ++at) {
    const std::string name = (*at)[2];
    if ((*at)[1] == "/") {
      ASSERT_EQ(open.back().first, name) << ml;
      const int parts = open.back().second;
      if (name == "msub" || name == "msup" || name == "mfrac" || name == "munder") {
        EXPECT_EQ(parts, 2) << name << " in " << ml;
      }
      if (name == "msubsup") {
        EXPECT_EQ(parts, 3) << ml;
      }
      open.pop_back();
      continue;
    }
    ++open.back().second;
    if ((*at)[3] != "/") open.emplace_back(name, 0);
  }
  EXPECT_EQ(open.size(), 1u) << ml;
}

TEST(Equation, EveryEffectsIsWellFormed) {
  for (const EffectRow& row : effects()) {
    const std::string tex = tex_of(row.equation);
    EXPECT_EQ(std::ranges::count(tex, '{'), std::ranges::count(tex, '}')) << tex;
    EXPECT_EQ(tex.find("\\left|\\right|"), std::string::npos) << row.equation;
    expect_well_formed(mathml_of(row.equation));
  }
}

TEST(Equation, SurvivesWhatIsNone) {
  expect_well_formed(mathml_of(""));
  expect_well_formed(mathml_of(std::string(100000, '(')));
  expect_well_formed(mathml_of(std::string(100000, '|')));
  expect_well_formed(mathml_of("^/'_,|)( sum_ sqrt( a^ -/"));
  EXPECT_EQ(mathml_of("<img src=x>").find("<img"), std::string::npos);
  EXPECT_NE(mathml_of("a ≤ b").find("<mo>≤</mo>"), std::string::npos);
}

}  // namespace
}  // namespace flexspline::reports
