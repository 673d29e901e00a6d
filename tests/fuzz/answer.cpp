#include <nlohmann/json.hpp>

#include "flexspline/studies/conceal.hpp"
#include "fuzzed_file.hpp"
#include "results/row_json.hpp"

// JSON that a folder or a program of others hands back: a case's row, and a bench's answer.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace flexspline::studies;
  const std::string text(reinterpret_cast<const char*>(bytes), size);
  (void)row_from_json(text);
  (void)answer_from_json(nlohmann::ordered_json::parse(text, nullptr, false));
  return 0;
}
