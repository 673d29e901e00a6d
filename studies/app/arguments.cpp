#include <charconv>

#include <fmt/format.h>

#include "command.hpp"

namespace flexspline::app {

void Arguments::set(const std::string& name, std::vector<std::string> values) {
  values_[name] = std::move(values);
}

std::string Arguments::text(const std::string& name, const std::string& fallback) const {
  const auto found = values_.find(name);
  return found == values_.end() || found->second.empty() ? fallback : found->second.back();
}

std::vector<std::string> Arguments::texts(const std::string& name) const {
  const auto found = values_.find(name);
  return found == values_.end() ? std::vector<std::string>{} : found->second;
}

Result<long> Arguments::integer(const std::string& name, long fallback, long low, long high) const {
  if (!has(name)) return fallback;
  const std::string given = text(name);
  long value = 0;
  const auto [end, error] = std::from_chars(given.data(), given.data() + given.size(), value);
  if (error != std::errc{} || end != given.data() + given.size() || value < low || value > high) {
    return failure(ErrorCode::usage,
                   fmt::format("--{} = '{}' is not a whole number in range", name, given),
                   fmt::format("give one between {} and {}", low, high));
  }
  return value;
}

}  // namespace flexspline::app
