#include "flexspline/data/model_toml.hpp"
#include "fuzzed_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(bytes), size);
  (void)flexspline::data::parse_model(text, "model.toml");
  return 0;
}
