#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "flexspline/studies/status.hpp"

namespace flexspline::studies {

/// journals/<host>-<process>.running: what a run that is under way says of itself, every few
/// seconds. It goes with the run; one that stopped telling was interrupted.
class RunningNote {
 public:
  RunningNote(const std::filesystem::path& folder, const Shard& shard);
  ~RunningNote();
  RunningNote(const RunningNote&) = delete;
  RunningNote& operator=(const RunningNote&) = delete;

  void write(const Progress& state) const;

 private:
  std::filesystem::path file_;
  Shard shard_;
  mutable double next_ = 0.0;
};

/// Every run that told of itself within the last minutes.
std::vector<RunningShard> running_in(const std::filesystem::path& folder);

}  // namespace flexspline::studies
