#include "fuzzed_file.hpp"
#include "tables/cdr_message.hpp"

// A definition, and behind a byte of zero a message that is to follow it.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace flexspline::data;
  const std::string_view text(reinterpret_cast<const char*>(bytes), size);
  const auto end = std::min(text.find('\0'), text.size());
  const auto definition = parse_ros_definition("a/msg/A", text.substr(0, end));
  if (!definition) return 0;
  const CdrReader reader(*definition, 64);
  const std::string_view message = text.substr(std::min(end + 1, text.size()));
  const auto leaves = reader.leaves(message);
  CdrValues values;
  const bool fits = reader.values(message, values);
  if (leaves.has_value() != fits) std::abort();
  if (fits && values.numbers.size() != leaves->size()) std::abort();
  return 0;
}
