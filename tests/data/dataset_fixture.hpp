#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "flexspline/core/write_file.hpp"

namespace flexspline::data {

/// A folder of its own for each test, gone afterwards.
class InFolder : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string("flexspline-") + test->test_suite_name() + "-" + test->name();
    for (char& letter : name) letter = letter == '/' ? '-' : letter;
    folder_ = std::filesystem::temp_directory_path() / name;
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void put(const std::string& name, const std::string& content) const {
    ASSERT_TRUE(write_file(folder_ / name, content).has_value());
  }

  std::filesystem::path folder_;
};

/// The text with one piece replaced; the piece has to be there.
inline std::string with(std::string text, const std::string& piece, const std::string& instead) {
  const auto at = text.find(piece);
  EXPECT_NE(at, std::string::npos) << piece;
  return at == std::string::npos ? text : text.replace(at, piece.size(), instead);
}

/// A sound description of one recording, a.csv, on the locked rig.
inline const std::string kDescription = R"(schema = "flexspline-dataset/1"
name = "bench"
rig = "locked"
license = "CC0-1.0"

[constants]
gear_ratio = 50

[channels]
t = { quantity = "time", unit = "s" }
theta = { quantity = "motor_angle", unit = "deg" }
tau = { quantity = "transmitted_torque", unit = "Nm" }

[[recording]]
id = "a"
file = "a.csv"
excitation = "sine"
amplitude_deg = 0.2
frequency_hz = 0.5
)";

/// Its table: 16 rows "0.5i,2i,-i"; row i on line i + 2.
inline std::string sound_table(char separator = ',', const std::string& end = "\n") {
  std::string text = std::string("t") + separator + "theta" + separator + "tau" + end;
  for (int i = 0; i < 16; ++i) {
    text += std::to_string(i / 2) + (i % 2 == 0 ? ".0" : ".5") + separator + std::to_string(2 * i) +
            separator + std::to_string(-i) + end;
  }
  return text;
}

}  // namespace flexspline::data
