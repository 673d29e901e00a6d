#pragma once

#include <functional>
#include <string_view>

#include "bench/hidden_law.hpp"

namespace flexspline::data {

/// What happens to the effort within one recording: Nm at s since its start.
using Incident = std::function<double(double)>;

/// A law that adds an incident to one recording of the bench, drawn by (seed, id). The place is
/// where it begins, drawn between `earliest` and `latest` of the recording's time, and how long it
/// takes, both shares; what it adds is a function of the time since it began, over its length.
HiddenLaw incident_law(const HiddenScale& scale, std::string_view id, double earliest,
                       double latest, double length, const Incident& shape);

}  // namespace flexspline::data
