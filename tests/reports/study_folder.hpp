#pragma once

#include <algorithm>
#include <filesystem>
#include <functional>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "checksum.hpp"
#include "flexspline/core/write_file.hpp"
#include "source_dir.hpp"

namespace flexspline::reports {

/// A copy of a fixture that a test may spoil, gone when the test is.
class StudyFolder {
 public:
  explicit StudyFolder(const std::string& fixture = "fixture") {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string(test->test_suite_name()) + "-" + test->name();
    std::replace(name.begin(), name.end(), '/', '-');
    path_ = std::filesystem::path(testing::TempDir()) / ("flexspline-report-" + name);
    std::filesystem::remove_all(path_);
    std::filesystem::copy(std::filesystem::path(FLEXSPLINE_SOURCE_DIR) / "tests/reports" / fixture,
                          path_, std::filesystem::copy_options::recursive);
  }
  StudyFolder(const StudyFolder&) = delete;
  StudyFolder& operator=(const StudyFolder&) = delete;
  ~StudyFolder() { std::filesystem::remove_all(path_); }

  const std::filesystem::path& path() const { return path_; }

  std::string text(const std::string& file) const {
    const auto text = read_file(path_ / file);
    EXPECT_TRUE(text.has_value()) << file;
    return text.value_or("");
  }

 private:
  std::filesystem::path path_;
};

/// Changes an artefact and seals it again.
inline void change(const StudyFolder& folder, const std::string& file,
                   const std::function<void(nlohmann::ordered_json&)>& edit) {
  auto artefact = nlohmann::ordered_json::parse(folder.text(file));
  artefact.erase("sha256");
  edit(artefact);
  artefact["sha256"] = sha256_of(artefact.dump());
  ASSERT_TRUE(write_file(folder.path() / file, artefact.dump()));
}

}  // namespace flexspline::reports
