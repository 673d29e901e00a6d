#include "flexspline/core/nearest_name.hpp"

#include <algorithm>
#include <cctype>
#include <vector>

namespace flexspline {
namespace {

std::string lower(std::string_view text) {
  std::string result(text);
  std::ranges::transform(result, result.begin(), [](unsigned char letter) {
    return static_cast<char>(std::tolower(letter));
  });
  return result;
}

/// Optimal string alignment distance; three rows suffice as a swap looks two rows back.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

}  // namespace

std::optional<std::string_view> nearest_name(std::string_view given,
                                             std::span<const std::string_view> known) {
  std::optional<std::string_view> nearest;
  std::size_t best = std::min(given.size(), std::max<std::size_t>(1, given.size() / 3) + 1);
  for (const std::string_view name : known) {
    const std::size_t distance = edit_distance(lower(given), lower(name));
    if (distance >= best) continue;
    best = distance;
    nearest = name;
  }
  return nearest;
}

std::string suggestion(std::string_view given, std::span<const std::string_view> known) {
  if (const auto nearest = nearest_name(given, known)) {
    return "did you mean '" + std::string(*nearest) + "'?";
  }
  std::string names;
  for (const std::string_view name : known) {
    names += names.empty() ? "known: " : ", ";
    names += name;
  }
  return names;
}

}  // namespace flexspline
