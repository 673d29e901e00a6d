#include <nlohmann/json.hpp>

#include "fuzzed_file.hpp"
#include "lock_file.hpp"
#include "parse_artefacts.hpp"
#include "read_checked.hpp"

// What pages are drawn from: the lock of a study and every kind of artefact, of any JSON. The first
// byte says which.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace flexspline::reports;
  if (size == 0) return 0;
  const std::string text(reinterpret_cast<const char*>(bytes) + 1, size - 1);
  (void)check_text(text, "flexspline-input/1");
  if (bytes[0] % 8 == 7) {
    (void)parse_lock(text);
    return 0;
  }
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (json.is_discarded()) return 0;
  try {
    switch (bytes[0] % 8) {
      case 0:
        return (void)parse_input(json), 0;
      case 1:
        return (void)parse_case(json), 0;
      case 2:
        return (void)parse_paper(json), 0;
      case 3:
        return (void)parse_kind(json), 0;
      case 4:
        return (void)parse_diagnosis(json), 0;
      case 5:
        return (void)parse_trial(json), 0;
      default:
        return (void)parse_verification(json), 0;
    }
  } catch (const nlohmann::json::exception&) {
    return 0;  // as its readers take it
  }
}
