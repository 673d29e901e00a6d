#pragma once

#include <filesystem>
#include <string>

#include "flexspline/reports/diagnosis_view.hpp"

namespace flexspline::reports {

/// One printed page (A4) of a diagnosis for a test protocol: verdict, the largest causes with sizes
/// in the unit of the torque and in percent, held-out errors, three figures out of a folder of
/// static ones, what to record next, and where it comes from. Text alone where they are not drawn.
std::string summary_sheet(const DiagnosisView& view, const std::filesystem::path& figures);

}  // namespace flexspline::reports
