#pragma once

#include <span>

namespace flexspline {

/// The level of an encoder's counts, in the unit of the samples: the greatest of which every
/// distance of two that follow each other is a whole number, by Euclid's algorithm; of samples that
/// last for two or more, if these have sixteen values, as what lies between may be interpolated;
/// else of all. 0 where that is less than 1e-6 of their range, as of samples that are no counts, or
/// all distances are alike.
double level_of_counts(std::span<const double> samples);

/// What counting leaves of a motion at least, a standard deviation: level sqrt(passing/(12 n)),
/// passing the samples of n whose level the motion passes through, on from the one before it to the
/// one after it, neither of which lasts less than half as long. Of a motion that rests or turns
/// counts tell nothing.
double deviation_of_counts(std::span<const double> samples);

}  // namespace flexspline
