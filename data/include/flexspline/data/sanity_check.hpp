#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "flexspline/data/sanity.hpp"

namespace flexspline::data {

struct ObservedSet;  // what the checks look at, of the layer's own

/// What a check may answer: under which code, whether it stops science, and what to do about it.
struct SanityVerdict {
  std::string_view code;  ///< check_units, check_sign, check_ratio or check_channel
  Severity severity = Severity::warning;
  std::string_view remedy;

  /// The finding, of one recording or, where its id is empty, of all of them.
  SanityFinding on(std::string recording, std::string what) const;
};

/// A row of the catalogue of checks, one file each in data/sanity/checks.
struct SanityRow {
  std::string_view id;
  std::string_view says;                ///< what it looks for
  std::vector<SanityVerdict> verdicts;  ///< all that it may answer
  std::vector<SanityFinding> (*find)(const ObservedSet&) = nullptr;
};

std::span<const SanityRow> sanity_checks();

}  // namespace flexspline::data
