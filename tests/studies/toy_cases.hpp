#pragma once

#include <atomic>
#include <chrono>
#include <thread>

#include <fmt/format.h>

#include "flexspline/data/checksum.hpp"
#include "flexspline/studies/engine.hpp"

namespace flexspline::studies {

/// A kind whose cases are known in closed form: case n holds n squared. Every 7th fails.
class ToyCases : public CaseSource {
 public:
  explicit ToyCases(std::size_t size, std::chrono::microseconds each = {}, bool fails = true)
      : size_(size), each_(each), fails_(fails) {}

  std::size_t size() const override { return size_; }
  CaseName name(std::size_t number) const override {
    return {fmt::format("toy--{:07}--r0", number), data::sha256_hex(fmt::format("toy {}", number))};
  }
  CaseResult compute(std::size_t number) override {
    if (each_.count() > 0) std::this_thread::sleep_for(each_);
    if (fails_ && number % 7 == 6) return give_up(number, {ErrorCode::numerics, "a 7th", {}, {}});
    return {{}, 0.0, "{}", artefact(number)};
  }
  CaseResult give_up(std::size_t number, const Error& why) override {
    return {why.problem, 0.0, "{}", fmt::format("{{\"failed\":{}}}", number)};
  }
  static std::string artefact(std::size_t number) {
    return fmt::format("{{\"number\":{},\"square\":{}}}", number, number * number);
  }

 private:
  std::size_t size_;
  std::chrono::microseconds each_;
  bool fails_;
};

}  // namespace flexspline::studies
