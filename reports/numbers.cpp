#include "numbers.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <limits>

#include <fmt/format.h>

namespace flexspline::reports {

double rounded(double value, int count) {
  if (!std::isfinite(value)) return value;
  return std::strtod(fmt::format("{:.{}e}", value, count - 1).c_str(), nullptr);
}

std::vector<double> rounded(std::vector<double> values, int count) {
  for (double& value : values) value = rounded(value, count);
  return values;
}

std::string digits(double value, int count) {
  if (!std::isfinite(value)) return "–";
  if (value == 0.0) return "0";
  const double size = std::abs(rounded(value, count));
  if (size < 1e-3 || size >= 1e6) return fmt::format("{:.{}e}", value, count - 1);
  const int magnitude = static_cast<int>(std::floor(std::log10(size)));
  const int kept = magnitude < count ? count : std::max(count, 3);
  return fmt::format("{:.{}f}", rounded(value, kept), std::max(0, count - 1 - magnitude));
}

std::string compact(double value, int count) {
  std::string text = digits(value, count);
  if (text.find('.') == std::string::npos || text.find('e') != std::string::npos) return text;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

std::string of_peak(double percent) {
  return percent > 100.0 ? "diverged" : digits(percent, 2) + " % of peak";
}

std::pair<double, double> widened(double lower, double upper, double share) {
  const double margin = share * (upper - lower);
  if (!(margin > 0.0)) return {lower, upper};
  const double step = std::pow(10.0, std::floor(std::log10(margin)));
  return {rounded(std::floor((lower - margin) / step) * step, 6),
          rounded(std::ceil((upper + margin) / step) * step, 6)};
}

std::vector<double> thinned(const std::vector<double>& values, std::size_t most) {
  if (values.size() <= most || most < 2) return values;
  const std::size_t step = (values.size() + most - 2) / (most - 1);
  std::vector<double> kept;
  for (std::size_t i = 0; i < values.size(); i += step) kept.push_back(values[i]);
  if ((values.size() - 1) % step != 0) kept.push_back(values.back());
  return kept;
}

double median(std::vector<double> values) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

std::string words(std::string id) {
  std::replace(id.begin(), id.end(), '_', ' ');
  return id;
}

std::string sentence(std::string remark) {
  if (remark.empty()) return remark;
  remark.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(remark.front())));
  return remark.find_last_of(".!?") == remark.size() - 1 ? remark : remark + ".";
}

std::string slug(const std::string& name) {
  std::string slug;
  for (const unsigned char letter : name) {
    const bool plain = std::isalnum(letter) != 0 && letter < 128;
    if (plain) {
      slug += static_cast<char>(std::tolower(letter));
    } else if (!slug.empty() && slug.back() != '-') {
      slug += '-';
    }
  }
  while (!slug.empty() && slug.back() == '-') slug.pop_back();
  return slug.empty() ? "unnamed" : slug.substr(0, 60);
}

}  // namespace flexspline::reports
