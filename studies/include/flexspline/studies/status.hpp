#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "flexspline/core/error.hpp"
#include "flexspline/studies/engine.hpp"

namespace flexspline::studies {

/// What a run that is under way says of itself.
struct RunningShard {
  std::string who;  ///< host and process
  Shard shard;
  Progress state;
  double silent_for = 0.0;  ///< s since it was written
};

/// How far the study of a folder is, from what lies there alone.
struct StudyStatus {
  std::string name;
  std::size_t cases = 0;  ///< of the study
  std::size_t done = 0;   ///< failed ones too
  std::size_t failed = 0;
  double seconds = 0.0;               ///< of the cases that are done, one after the other
  std::vector<std::string> failures;  ///< "key: reason", the first of them
  std::vector<std::string> damaged;
  std::vector<RunningShard> running;
  double left_seconds = 0.0;  ///< at the rate of those that run; NaN where nobody does

  bool complete() const { return done >= cases; }
};

/// Errors: input_missing where the folder holds no study.
Result<StudyStatus> status_of(const std::filesystem::path& folder);

nlohmann::ordered_json to_json(const StudyStatus& status);

}  // namespace flexspline::studies
