#pragma once

#include <string>
#include <vector>

namespace flexspline::studies {

/// What two TOML texts state differently, key by key in the order of their names: "seed is 7 there
/// and 8 here". Entries of a list of tables are told apart by their id, or numbered from 1.
/// Comments, order and layout are no difference. Where one of them is no TOML: that both are not
/// the same.
std::vector<std::string> differing_keys(const std::string& there, const std::string& here);

}  // namespace flexspline::studies
