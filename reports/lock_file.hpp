#pragma once

#include <string>
#include <vector>

namespace flexspline::reports {

/// What a report takes from study.lock.toml; empty where the lock does not say.
struct LockFile {
  std::string title;
  std::vector<std::string> inputs;      ///< ids in the study's order
  std::vector<std::string> estimators;  ///< ids in the study's order
  std::vector<std::string> cases;       ///< keys
};

/// A lock that cannot be read gives nothing; it is still shown as it stands.
LockFile parse_lock(const std::string& lock);

/// Place of an id in an order; behind the last where it is not in it.
std::size_t place_in(const std::vector<std::string>& order, const std::string& id);

}  // namespace flexspline::reports
