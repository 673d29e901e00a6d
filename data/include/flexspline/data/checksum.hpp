#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "flexspline/core/error.hpp"

namespace flexspline::data {

/// SHA-256 of content that comes in pieces.
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  Sha256(Sha256&&) noexcept;
  Sha256& operator=(Sha256&&) noexcept;

  void add(std::string_view bytes);
  /// The content of a regular file of any size, a mebibyte at a time. Error: input_missing where it
  /// cannot be read.
  Result<void> add_file(const std::filesystem::path& file);
  /// 64 lower-case hexadecimal digits. Ends the computation: nothing may be added afterwards.
  std::string hex();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// SHA-256 of the bytes, as 64 lower-case hexadecimal digits.
std::string sha256_hex(std::string_view bytes);

}  // namespace flexspline::data
