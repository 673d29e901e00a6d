#pragma once

#include <string>
#include <string_view>
#include <utility>

#include <nlohmann/json_fwd.hpp>

#include "flexspline/studies/diagnosis.hpp"

namespace flexspline::studies {

inline constexpr std::string_view kDiagnosisSchema = "flexspline-diagnosis/1";

/// A diagnosis as flexspline-diagnosis/1 (docs/artefacts.md): causes largest first, p-values no
/// smaller than 1e-12, notes with a code (check_units, check_sign, check_ratio, check_channel, or
/// remark). Keys that end in _nm are in Nm, on a
/// linear specimen in N, as `units.rmse` says; parameters have deg where the catalogue has rad;
/// series are in the data set's own units. What was not computed is null.
nlohmann::ordered_json to_json(const Diagnosis& diagnosis);

/// The factor from a unit in radians to the same unit in degrees, and its symbol: Nm/rad gives
/// pi/180 and Nm/deg. Units without radians are left as they are.
std::pair<double, std::string> in_degrees(const std::string& unit);

}  // namespace flexspline::studies
