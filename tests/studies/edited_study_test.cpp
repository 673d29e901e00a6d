// A folder belongs to the study that was computed in it, and says what an edited one states
// otherwise.
#include <functional>

#include "config/differing_keys.hpp"
#include "flexspline/core/case_store.hpp"
#include "program_fixture.hpp"

namespace flexspline::studies {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(DifferingKeys, NameEachKeyWithBothValues) {
  EXPECT_THAT(differing_keys("seed = 7\na.b = [1, 2]\n", "seed = 8\na.b = [1, 3]\n"),
              ElementsAre("a.b is [1, 2] there and [1, 3] here", "seed is 7 there and 8 here"));
  EXPECT_THAT(
      differing_keys("a = 1\nb = 'x'\n", "a = 1\nc = true\n"),
      ElementsAre("b is 'x' there and not stated here", "c is true here and not stated there"));
}

TEST(DifferingKeys, AreNotOfCommentsOrderAndLayout) {
  EXPECT_THAT(
      differing_keys("a = 1\nb = { c = 2, d = 3 }\n", "# said\nb.d = 3\nb.c = 2\na  =  1 # one\n"),
      IsEmpty());
}

TEST(DifferingKeys, TellTablesOfAListByTheirIdsElseByTheirNumbers) {
  EXPECT_THAT(differing_keys("[[e]]\nid = 'p'\nm = 1\n[[e]]\nid = 'q'\nm = 2\n",
                             "[[e]]\nid = 'q'\nm = 3\n[[e]]\nid = 'p'\nm = 1\n"),
              ElementsAre("e[q].m is 2 there and 3 here"));
  EXPECT_THAT(differing_keys("[[s]]\nv = 1\n[[s]]\nv = 2\n", "[[s]]\nv = 1\n[[s]]\nv = 4\n"),
              ElementsAre("s[2].v is 2 there and 4 here"));
}

TEST(DifferingKeys, ShowALongValueWhereItDiffers) {
  std::string numbers;
  for (int i = 100; i < 200; ++i) numbers += std::to_string(i) + ", ";
  const auto told = differing_keys("v = [" + numbers + "7]", "v = [" + numbers + "8]");
  ASSERT_EQ(told.size(), 1U);
  EXPECT_THAT(told[0], HasSubstr("199, 7] there"));
  EXPECT_THAT(told[0], HasSubstr("199, 8] here"));
  EXPECT_LT(told[0].size(), 100U);
}

TEST(DifferingKeys, OfWhatIsNoTomlAreNotNamed) {
  EXPECT_EQ(differing_keys("a = ", "a = 1").size(), 1U);
  EXPECT_THAT(differing_keys("a = ", "a = "), IsEmpty());
}

/// An edit of a study file, and what is said of it.
struct Edit {
  std::string what;
  std::string from;
  std::string to;
  std::string said;
  std::string key;
};

class EditedStudy : public Program, public testing::WithParamInterface<Edit> {
 protected:
  void SetUp() override {
    Program::SetUp();
    if (IsSkipped()) return;
    folder_.write("study.toml", kSmallStudy +
                                    "[[sweep]]\nkey = \"bench.angle_noise\"\n"
                                    "values = [0.1, 0.2]\nunit = \"%\"\n");
  }
  Ended run(const std::vector<std::string>& more = {},
            const std::string& study = "study.toml") const {
    std::vector<std::string> words = {"run", path(study), "--out", path("out"), "--json"};
    words.insert(words.end(), more.begin(), more.end());
    return run_program(words);
  }
  void edit(const std::string& from, const std::string& to) const {
    std::string text = read_text(path("study.toml"));
    const auto at = text.find(from);
    ASSERT_NE(at, text.npos) << from;
    folder_.write("study.toml", text.replace(at, from.size(), to));
  }
  /// Every case that the journals hold, those set aside among them, by what it depends on.
  std::set<std::string> kept() const {
    std::set<std::string> all;
    for (const auto& entry : fs::directory_iterator(path("out/journals"))) {
      if (!entry.is_regular_file()) continue;
      const auto scan = scan_journal(entry.path(), [&](JournalFields fields, RecordPlace) {
        all.insert(std::string(fields[1]));
      });
      EXPECT_TRUE(scan) << entry.path();
    }
    return all;
  }
};

// Another file is another study, whatever it is called; a file that is edited where it lies goes
// on.
TEST_P(EditedStudy, IsToldApartByItsKeysAndLosesNothing) {
  ASSERT_EQ(run().code, 0);
  const auto before = hashes(path("out"));
  const auto cases = kept();
  ASSERT_EQ(cases.size(), 2U);
  ASSERT_NO_FATAL_FAILURE(edit(GetParam().from, GetParam().to));
  folder_.write("edited.toml", read_text(path("study.toml")));
  for (const std::vector<std::string>& more :
       std::vector<std::vector<std::string>>{{}, {"--gather"}, {"--shard", "1/2"}}) {
    const Ended refused = run(more, "edited.toml");
    EXPECT_EQ(refused.code, 73) << refused.said;
    EXPECT_THAT(refused.said, HasSubstr(GetParam().said));
    EXPECT_TRUE(hashes(path("out")) == before) << "nothing is written";
  }
  const bool renamed = GetParam().what == "Name";
  const Ended on = run(renamed ? std::vector<std::string>{"--force"} : std::vector<std::string>{});
  EXPECT_EQ(on.code, 0) << on.said;
  EXPECT_THAT(on.said, HasSubstr(GetParam().key));
  EXPECT_TRUE(std::ranges::includes(kept(), cases)) << "earlier cases are set aside, not lost";
  EXPECT_THAT(run().result, HasSubstr("\"computed\": 0"));
}

INSTANTIATE_TEST_SUITE_P(
    OfEveryKind, EditedStudy,
    testing::Values(
        Edit{"Seed", "name = \"small\"\n", "name = \"small\"\nseed = 21\n",
             "seed is 21 here and not stated there", "seed is"},
        Edit{"BaseKey", "samples_per_cycle = 200", "samples_per_cycle = 220",
             "bench.samples_per_cycle is 200 there and 220 here", "bench.samples_per_cycle is"},
        Edit{"SweptValue", "values = [0.1, 0.2]", "values = [0.1, 0.3]",
             "sweep[1].values is [0.1, 0.2] there and [0.1, 0.3] here", "sweep[1].values is"},
        Edit{"SweptKey", "key = \"bench.angle_noise\"", "key = \"bench.torque_noise_white\"",
             "there and 'bench.torque_noise_white' here", "sweep[1].key is"},
        Edit{"Loop", "values = [0.005]", "values = [0.006]",
             "grid[point].frequency.values is [0.005] there and [0.006] here",
             "frequency.values is"},
        Edit{"Name", "name = \"small\"", "name = \"other\"",
             "holds what run wrote of 'small', not run of 'other': name is 'small' there",
             "name is"}),
    [](const auto& tested) { return tested.param.what; });

using StudyOfTheSameWords = EditedStudy;

TEST_F(StudyOfTheSameWords, GoesOn) {
  ASSERT_EQ(run().code, 0);
  edit("name = \"small\"", "# what it is for\nname   = \"small\"");
  const Ended again = run();
  EXPECT_EQ(again.code, 0) << again.said;
  EXPECT_THAT(again.result, HasSubstr("\"reused\": 2"));
}

// What the words of a study lead to may change: those cases are computed again, and it is said.
TEST_F(StudyOfTheSameWords, OverOtherDataIsComputedAgainAndLosesNothing) {
  fs::copy(std::string(FLEXSPLINE_SOURCE_DIR) + "/docs/examples/locked-gear", path("gear"));
  folder_.write("study.toml", kHead +
                                  "[[input]]\nid = \"gear\"\ndataset = \"gear\"\n"
                                  "[[estimator]]\nid = \"paper\"\n"
                                  "method = \"midpoint_polynomial\"\ntrain = \"one\"\n");
  ASSERT_EQ(run().code, 0);
  const auto cases = kept();
  std::string table = read_text(path("gear/sine-a0.2-f0.05.csv"));
  const auto digit = table.find_last_of("0123456789");
  table[digit] = table[digit] == '5' ? '6' : '5';
  folder_.write("gear/sine-a0.2-f0.05.csv", table);
  const Ended again = run();
  EXPECT_EQ(again.code, 0) << again.said;
  EXPECT_THAT(again.said, HasSubstr("gear: its data set has changed"));
  EXPECT_THAT(again.result, HasSubstr("\"computed\": 1"));
  const auto after = kept();
  EXPECT_TRUE(std::ranges::includes(after, cases));
  EXPECT_EQ(after.size(), 2U);
  EXPECT_THAT(run().said, testing::Not(HasSubstr("has changed")));
}

}  // namespace
}  // namespace flexspline::studies
