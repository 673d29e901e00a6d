#include "flexspline/data/dataset.hpp"
#include "fuzzed_file.hpp"

// dataset.toml, and the table beside it.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace flexspline;
  fuzz::write("dataset.toml", bytes, size);
  if (!std::filesystem::exists(fuzz::folder() / "a.csv")) {
    std::ofstream table(fuzz::folder() / "a.csv");
    table << "t,theta,tau\n";
    for (int i = 0; i < 20; ++i) table << i << ',' << i % 3 << ',' << i % 5 << '\n';
  }
  const data::DatasetReading reading = data::read_dataset(fuzz::folder());
  if (reading.set.has_value() != reading.errors.empty()) std::abort();
  return 0;
}
