#include <chrono>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "command_line.hpp"
#include "source_dir.hpp"

namespace flexspline::studies {
namespace {

class ImportTranscript : public CommandLine {};

/// From the logger's file to the diagnosis' page, by the commands of docs/import.md.
TEST_F(ImportTranscript, LeadsToTheDiagnosisInFiveMinutes) {
  const auto begun = std::chrono::steady_clock::now();
  const std::string file =
      std::string(FLEXSPLINE_SOURCE_DIR) + "/docs/examples/bench-file/messung_03.csv";
  const Finished imported =
      call("import " + file + " --out " + path("my-gear") + " --ratio 50 --split 5 --yes");
  ASSERT_EQ(imported.code, 0) << imported.output;
  const Finished diagnosed = call("diagnose " + path("my-gear") + " --out " + path("my-diagnosis"));
  ASSERT_EQ(diagnosed.code, 0) << diagnosed.output;
  EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::minutes(5));
  EXPECT_TRUE(exists(folder_.path() / "my-diagnosis/index.html"));
  const auto verdict = nlohmann::json::parse(read_text(path("my-diagnosis/diagnosis.json")));
  // The same gear as docs/examples/locked-gear, but for its motor torque.
  EXPECT_NE(verdict.at("verdict"), "undecided") << diagnosed.output;
}

}  // namespace
}  // namespace flexspline::studies
