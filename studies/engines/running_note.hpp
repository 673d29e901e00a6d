#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "flexspline/core/passing_file.hpp"
#include "flexspline/studies/status.hpp"

namespace flexspline::studies {

/// journals/<who>.running: what a run that is under way says of itself, every few seconds. It goes
/// with the run; one that stopped telling was interrupted.
class RunningNote {
 public:
  RunningNote(const std::filesystem::path& folder, const Shard& shard);
  RunningNote(const RunningNote&) = delete;
  RunningNote& operator=(const RunningNote&) = delete;

  void write(const Progress& state) const;
  /// Host, process and when it began: nobody else is called so.
  const std::string& who() const { return who_; }

 private:
  std::string who_;
  PassingFile file_;
  Shard shard_;
  mutable double next_ = 0.0;
};

/// What a run says of itself now; empty where it is gone. Unlike its time of writing, the text
/// itself does not depend on anybody's clock: it changes as long as the run is alive.
std::string note_of(const std::filesystem::path& folder, const std::string& who);

/// Removes the notes of runs that were killed, by their age: for who is alone in the folder, as
/// clocks may jump. One that lives writes its note again.
void remove_old_notes(const std::filesystem::path& folder);

/// Every run that told of itself within the last minutes.
std::vector<RunningShard> running_in(const std::filesystem::path& folder);

}  // namespace flexspline::studies
