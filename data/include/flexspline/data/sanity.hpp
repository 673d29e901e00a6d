#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "flexspline/core/recording.hpp"

namespace flexspline::data {

/// An error stops science: no physics is read out of such recordings. A warning becomes a note.
enum class Severity { warning, error };

std::string_view name_of(Severity severity);

/// Something in recordings that looks like a mistake of the bench or of the file, not like physics.
struct SanityFinding {
  std::string code;   ///< check_units, check_sign, check_ratio or check_channel
  std::string check;  ///< id of the check that found it
  Severity severity = Severity::warning;
  std::string recording;  ///< its id; empty: all of them
  std::string what;       ///< with the number that shows it
  std::string remedy;

  /// "check_units: recording 'a': what; remedy".
  std::string message() const;
};

/// What looks mistaken in a set: units, signs, ratio, channels, time; errors first. It uses the
/// samples, the constants and what the set states of its excitations, and no names. Sound sets
/// have none: a few in a thousand have a warning (docs/diagnosis.md).
/// What cannot be told is not said: a torque in a wrong unit on a rig that records no other torque,
/// knows no inertia and states no amplitude looks like another gear.
std::vector<SanityFinding> sanity_of(const RecordingSet& set);

/// True where one of them is an error.
bool stops_science(const std::vector<SanityFinding>& findings);

}  // namespace flexspline::data
