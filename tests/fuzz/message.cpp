#include "fuzzed_file.hpp"
#include "tables/table_message.hpp"

// What a reader in a process of its own may say, if it is not itself any more.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace flexspline::data;
  const std::string_view text(reinterpret_cast<const char*>(bytes), size);
  if (const auto head = table_head(text, {})) {
    if (!table_head(bytes_of(*head), {})) std::abort();
  }
  MessageReader from(text);
  while (from.reals()) continue;
  return 0;
}
