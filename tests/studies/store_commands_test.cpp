#include <nlohmann/json.hpp>

#include "program_fixture.hpp"
#include "stored.hpp"

namespace flexspline::studies {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const std::string kKey = "unity--paper--r0";

class StoreCommands : public Program {
 protected:
  Ended run(const std::vector<std::string>& more = {},
            const std::string& study = "study.toml") const {
    std::vector<std::string> words = {"run", path(study), "--out", path("out"), "--jobs", "2"};
    words.insert(words.end(), more.begin(), more.end());
    return run_program(words);
  }
  json status() const {
    const Ended ended = run_program({"status", path("out"), "--json"});
    EXPECT_EQ(ended.code, 0) << ended.said;
    return json::parse(ended.result);
  }
  void repeat(int replicates) const {
    std::string study = kSmallStudy;
    study.insert(study.find("[bench]"), "replicates = " + std::to_string(replicates) + "\n");
    folder_.write("study.toml", study);
  }
};

TEST_F(StoreCommands, ShardsStatusAndGather) {
  repeat(40);
  ASSERT_EQ(run({"--shard", "1/2"}).code, 0);
  const json half = status();
  EXPECT_EQ(half["cases"], 40);
  EXPECT_EQ(half["done"], 20);
  EXPECT_FALSE(half["complete"]);
  EXPECT_TRUE(half["left_seconds"].is_null()) << "nobody works on it";
  EXPECT_FALSE(exists(folder_.path() / "out" / "report"));
  const Ended gathered = run({"--gather"});
  EXPECT_EQ(gathered.code, 1) << gathered.said;
  EXPECT_THAT(gathered.said, HasSubstr("20 cases are not there"));
  EXPECT_TRUE(exists(folder_.path() / "out" / "report" / "index.html")) << "of what is there";
  ASSERT_EQ(run({"--shard", "2/2"}).code, 0);
  EXPECT_EQ(run({"--gather"}).code, 0);
  EXPECT_TRUE(status()["complete"]);
}

TEST_F(StoreCommands, StatusNamesALockThatIsDamaged) {
  std::filesystem::create_directory(folder_.path() / "damaged");
  for (const char* lock : {"", "study = 3\n", "count = \"many\"\n[study]\nname = \"x\"\n"}) {
    folder_.write("damaged/study.lock.toml", lock);
    const Ended ended = run_program({"status", path("damaged")});
    EXPECT_EQ(ended.code, 65) << ended.said;
    EXPECT_THAT(ended.said, HasSubstr("study.lock.toml")) << lock;
  }
}

TEST_F(StoreCommands, ShardsAndLimitsThatCannotBeAreRefused) {
  for (const char* shard : {"0/2", "3/2", "2", "1/0", "a/b", "1/2x", "-1/2"}) {
    const Ended ended = run({std::string("--shard=") + shard});
    EXPECT_EQ(ended.code, 2) << shard;
    EXPECT_THAT(ended.said, HasSubstr("no part of a whole")) << shard;
  }
  EXPECT_EQ(run({"--case-seconds", "0"}).code, 2);
  EXPECT_EQ(run({"--engine", "slrum"}).code, 2);
}

TEST_F(StoreCommands, ManyCasesNeedAYes) {
  std::string study = kSmallStudy;
  study.insert(
      study.find("[bench]"),
      "replicates = 10000\n[[sweep]]\nkey = \"bench.cycles\"\nlinspace = { from = 3, to = 22, "
      "count = 20 }\n");
  folder_.write("study.toml", study);
  const Ended ended = run();
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.said, HasSubstr("--yes-many"));
  EXPECT_FALSE(exists(folder_.path() / "out"));
  const Ended planned = run_program({"plan", path("study.toml"), "--json"});
  ASSERT_EQ(planned.code, 0) << planned.said;
  const json plan = json::parse(planned.result);
  EXPECT_EQ(plan["count"], 200'000);
  EXPECT_EQ(plan["unique_fits"], 200'000);
  EXPECT_FALSE(plan.contains("cases"));
  EXPECT_GT(plan["estimated_seconds_one_worker"].get<double>(), 1.0);
  EXPECT_GT(plan["estimated_bytes"].get<double>(), 2e8);
  EXPECT_LT(planned.seconds, 5.0);
}

TEST_F(StoreCommands, ExportCaseGivesTheArtefactAsAFile) {
  ASSERT_EQ(run().code, 0);
  const Ended shown = run_program({"export-case", path("out"), kKey});
  ASSERT_EQ(shown.code, 0) << shown.said;
  EXPECT_EQ(shown.result, stored_case(path("out"), kKey).artefact + "\n");
  ASSERT_EQ(run_program({"export-case", path("out"), "--out", path("cases")}).code, 0);
  EXPECT_TRUE(
      data::read_artefact(folder_.path() / "cases" / (kKey + ".json"), "flexspline-case/1"));
  EXPECT_EQ(run_program({"export-case", path("out"), "--out", path("cases")}).code, 73);
  const Ended unknown = run_program({"export-case", path("out"), "unity--papr--r0"});
  EXPECT_EQ(unknown.code, 66);
  EXPECT_THAT(unknown.said, HasSubstr(kKey));
}

// A folder as earlier versions wrote it: a file a case.
TEST_F(StoreCommands, FoldersOfVersionOneAreReportedAndSetAside) {
  ASSERT_EQ(run().code, 0);
  ASSERT_EQ(run_program({"export-case", path("out"), "--out", path("out/cases")}).code, 0);
  std::filesystem::remove_all(folder_.path() / "out" / "journals");
  EXPECT_EQ(run_program({"report", path("out")}).code, 0);
  EXPECT_EQ(status()["done"], 1);
  const Ended again = run({"-v"});
  EXPECT_EQ(again.code, 0) << again.said;
  EXPECT_THAT(again.said, HasSubstr("set aside as cases.stale"));
  EXPECT_EQ(stored_artefact(path("out"), kKey)["status"], "done");
}

TEST_F(StoreCommands, OtherVersionsAreRefusedWithAClearWord) {
  ASSERT_EQ(run().code, 0);
  const auto file = journals_in(folder_.path() / "out" / "journals").front();
  std::ofstream(file, std::ios::trunc) << "2d7fa235\tflexspline-journal/2\n";
  const Ended ended = run();
  EXPECT_EQ(ended.code, 65) << ended.said;
  EXPECT_THAT(ended.said, HasSubstr("flexspline-journal/2"));
}

TEST_F(StoreCommands, VerifyFindsAFlippedByte) {
  ASSERT_EQ(run().code, 0);
  EXPECT_EQ(run_program({"verify", path("out"), "--jobs", "1"}).code, 0);
  const auto file = journals_in(folder_.path() / "out" / "journals").front();
  std::string text = read_text(file);
  text[text.size() / 2] = static_cast<char>(text[text.size() / 2] ^ 1);
  std::ofstream(file, std::ios::trunc) << text;
  EXPECT_EQ(run_program({"verify", path("out")}).code, 1);
  EXPECT_EQ(run_program({"report", path("out")}).code, 1) << "says what it is without";
}

}  // namespace
}  // namespace flexspline::studies
