// Every effect that a diagnosis seeks by its own law is found where it was concealed.
#include <gtest/gtest.h>

#include "diagnosis/model/cause.hpp"
#include "diagnosis_checks.hpp"
#include "flexspline/core/effect.hpp"

namespace flexspline::studies {
namespace {

std::vector<Bench> benches() {
  std::vector<Bench> list;
  for (const CauseRow& row : causes()) {
    if (std::ranges::find(written_causes(), row.id, &CauseRow::id) != written_causes().end())
      continue;
    for (const data::HiddenRow& hidden : data::hidden_effects()) {
      if (hidden.id != row.id) continue;
      for (const Rig rig : hidden.rigs) list.push_back({rig, 21, std::string(row.id)});
    }
  }
  return list;
}

class SoughtByLaw : public testing::TestWithParam<Bench> {};

TEST_P(SoughtByLaw, IsNamedAloneAndProvedOnRecordingsHeldOut) {
  const Diagnosis d = diagnosed(GetParam().make().recordings);
  ASSERT_EQ(d.causes.size(), 1U);
  const Cause& cause = d.causes.front();
  EXPECT_TRUE(cause.effect == GetParam().effect ||
              std::ranges::count(cause.alternatives, GetParam().effect) > 0)
      << cause.effect;
  EXPECT_EQ(d.verdict, Verdict::explained);
  EXPECT_LT(d.holdout.ci95_upper, 1.0);
}

INSTANTIATE_TEST_SUITE_P(Catalogue, SoughtByLaw, testing::ValuesIn(benches()), [](const auto& one) {
  return one.param.effect + "_" + std::string(name_of(one.param.rig));
});

}  // namespace
}  // namespace flexspline::studies
