#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "flexspline/core/error.hpp"

namespace flexspline::studies {

/// Neighbouring cases that somebody took.
struct Pack {
  std::size_t number = 0;  ///< from 0; each begins where the one before ends
  std::size_t from = 0;    ///< first case
  std::size_t to = 0;      ///< one after the last
  int taken = 0;           ///< how many times it was taken before
  std::string who;
};

/// claims/<study>/<pack>.<taken>: which packs of a study's cases are taken, and by whom. Nobody
/// ever writes or removes another one's file; of several who make one at once a single one
/// succeeds.
class Claims {
 public:
  /// study names the plan: claims of another one do not count.
  Claims(const std::filesystem::path& folder, const std::string& study, std::string who,
         double lease_seconds);

  /// Every pack, as it was taken last.
  std::vector<Pack> packs() const;
  /// Takes a pack; false: somebody else was faster. Errors: cannot_write.
  Result<bool> take(const Pack& pack) const;

  const std::string& who() const { return who_; }
  /// Whether somebody still works: unknown until its note was seen to change, or had the time of a
  /// lease to do so, by this process's own steady clock.
  std::optional<bool> alive(const std::string& who);

 private:
  struct Seen {
    std::string note;
    std::chrono::steady_clock::time_point since;
    bool changed = false;
  };

  std::filesystem::path study_folder_;
  std::filesystem::path place_;
  std::string who_;
  double lease_;
  std::map<std::string, Seen> seen_;
};

}  // namespace flexspline::studies
