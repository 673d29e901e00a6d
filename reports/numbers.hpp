#pragma once

#include <string>
#include <utility>
#include <vector>

namespace flexspline::reports {

/// A number to `count` significant digits, at least three where it is large, for a person: no
/// exponent between 1e-3 and 1e6; a dash where there is no number.
std::string digits(double value, int count);

/// The same without zeros at the end of a fraction, for labels: 0.2, not 0.200.
std::string compact(double value, int count);

/// An error in percent of its signal's peak, "2.1 % of peak"; "diverged" where it is larger than
/// the signal.
std::string of_peak(double percent);

/// The double nearest to the value written with `count` significant digits: short in JSON.
double rounded(double value, int count);
std::vector<double> rounded(std::vector<double> values, int count);

/// The range widened by `share` on both sides and rounded outward to what an axis can show.
std::pair<double, double> widened(double lower, double upper, double share);

/// Every n-th sample such that at most `most` are left, always with the last one.
std::vector<double> thinned(const std::vector<double>& values, std::size_t most);

/// Middle of the finite values; NaN where there are none.
double median(std::vector<double> values);

/// An id as words: stribeck_friction is "stribeck friction".
std::string words(std::string id);

/// A remark as a sentence: it begins with a capital letter and ends with a full stop.
std::string sentence(std::string remark);

/// Lower-case letters, digits and hyphens, for ids and file names.
std::string slug(const std::string& name);

}  // namespace flexspline::reports
