#pragma once

#include <span>
#include <string>
#include <vector>

#include "flexspline/reports/artefacts.hpp"
#include "flexspline/reports/section.hpp"

namespace flexspline::reports {

struct ShownCircumstance {
  std::string kind, name, before, after;
};

struct ShownTolerance {
  std::string quantity, says;
  double relative = kAbsent;
  double of_std = kAbsent;
  double statistical = kAbsent;
};

struct ShownDifference {
  std::string where, quantity, before, after, level;
  double over_tolerance = kAbsent;
};

struct ShownCheck {
  std::string artefact, level, reason;
  double numbers = 0.0;
  double unequal = 0.0;
  double over_tolerance = kAbsent;
  std::vector<ShownDifference> worst;
};

/// flexspline-verification/1.
struct VerificationView {
  std::string folder, level, says;
  bool holds = false;
  std::vector<ShownCircumstance> changed;
  std::vector<ShownTolerance> tolerances;
  std::vector<ShownCheck> artefacts;
};

/// Reads DIR/verification.json. Errors: input_missing; bad_data, naming the file, when it is not a
/// verification or its checksum does not hold.
Result<VerificationView> read_verification(const std::filesystem::path& folder);

using VerificationSectionRow = SectionOf<VerificationView>;

/// Every section of a verification, one file each in reports/verification.
std::span<const VerificationSectionRow> verification_sections();

}  // namespace flexspline::reports
