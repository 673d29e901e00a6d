#include "spoilt_inputs.hpp"

namespace flexspline::studies {
namespace {

/// A slice of spoilt_inputs_slow.cpp: every so many of the same tries.
TEST(SpoiltInputs, ASliceOfAllTriesKeepsThePromises) {
  if (!exists(program_path())) GTEST_SKIP() << program_path() << " is not built";
  constexpr std::uint64_t kSeed = 20031;
  SpoiltInputs inputs;
  if (testing::Test::HasFatalFailure()) return;
  const auto crossed = inputs.crossed();
  for (std::size_t i = 7; i < crossed.size(); i += crossed.size() / 6) inputs.attempt(crossed[i]);
  const auto options = inputs.with_options();
  for (std::size_t i = 3; i < options.size(); i += options.size() / 6) inputs.attempt(options[i]);
  for (std::uint64_t i = 0; i < 6; ++i) inputs.attempt(inputs.spoilt_call(kSeed + i));
  inputs.print_counts();
}

}  // namespace
}  // namespace flexspline::studies
