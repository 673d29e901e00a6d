#pragma once

#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "flexspline/data/checksum.hpp"
#include "program.hpp"
#include "source_dir.hpp"

namespace flexspline::studies {

inline const std::string kSmallStudy = kHead +
                                       "[bench]\nangle_noise = { value = 0.1, unit = \"%\" }\n"
                                       "torque_noise_white = { value = 0.1, unit = \"%\" }\n"
                                       "cycles = 3\nsamples_per_cycle = 200\n" +
                                       kGrid + kInput + kEstimator;

/// A bench that hides an offset of the torque sensor.
inline const std::string kSmallBench =
    "schema = \"flexspline-bench/1\"\nrig = \"locked\"\nseed = 11\n"
    "effects = [{ id = \"torque_sensor_offset\", size_fraction = 0.08 }]\n"
    "[[excitation]]\nmotion = \"sine\"\namplitude = { value = 0.2, unit = \"deg\" }\n"
    "frequency = { value = 0.05, unit = \"Hz\" }\nsamples = 200\n"
    "[[excitation]]\nmotion = \"sine\"\namplitude = { value = 0.1, unit = \"deg\" }\n"
    "frequency = { value = 0.05, unit = \"Hz\" }\nsamples = 200\n";

/// SHA-256 of every file under a folder, by path.
inline std::map<std::string, std::string> hashes(const std::filesystem::path& folder) {
  std::map<std::string, std::string> sums;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file())
      sums[entry.path().string()] = data::sha256_hex(read_text(entry.path()));
  }
  return sums;
}

/// The program with a folder of small inputs.
class Program : public testing::Test {
 protected:
  void SetUp() override {
    if (!exists(program_path())) GTEST_SKIP() << program_path() << " is not built";
    folder_.write("study.toml", kSmallStudy);
    folder_.write("bench.toml", kSmallBench);
    folder_.write("model.toml", read_text(std::string(FLEXSPLINE_SOURCE_DIR) +
                                          "/tests/studies/cubic_model.toml"));
  }

  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  /// A data set of one sine of the cubic model.
  Ended simulate(const std::string& to, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {
        "simulate", path("model.toml"), "--excitation", "sine",  "--amplitude",
        "0.2deg",   "--frequency",      "0.005Hz",      "--out", path(to)};
    words.insert(words.end(), more.begin(), more.end());
    return run_program(words);
  }

  ScratchFolder folder_;
};

}  // namespace flexspline::studies
