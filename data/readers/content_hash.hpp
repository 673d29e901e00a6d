#pragma once

#include <string>

#include "flexspline/core/recording.hpp"

namespace flexspline::data {

/// SHA-256 of what the recordings say: rig, constants, and of every recording, by id, its split,
/// nominal excitation and samples in SI. Names of folders, files and columns, their order and
/// remarks do not count. Values are rounded to 30 binary digits (1e-9), so that the same data
/// written in another unit hash alike but for one rounding in four million values.
std::string content_hash(const RecordingSet& set);

}  // namespace flexspline::data
