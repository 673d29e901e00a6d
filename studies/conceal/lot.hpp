#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace flexspline::studies {

/// A draw by counter: a pure function of (seed, what, index), so that neither order nor workers
/// matter. 53 bits of a SHA-256.
std::uint64_t lot_bits(std::uint64_t seed, std::string_view what, std::uint64_t index);

/// In [0, 1).
double lot(std::uint64_t seed, std::string_view what, std::uint64_t index);

/// The list in an order drawn from (seed, what).
template <class Item>
std::vector<Item> shuffled(std::vector<Item> items, std::uint64_t seed, std::string_view what) {
  for (std::size_t left = items.size(); left > 1; --left) {
    const auto pick = static_cast<std::size_t>(lot(seed, what, left) * static_cast<double>(left));
    std::swap(items[left - 1], items[pick]);
  }
  return items;
}

}  // namespace flexspline::studies
