// Reading a table of text: as import surveys it, and as every command reads a data set's.
#include <benchmark/benchmark.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include <unistd.h>

#include <fmt/format.h>

#include "flexspline/data/dataset.hpp"
#include "flexspline/data/table_reader.hpp"

namespace flexspline::bench {
namespace {

namespace fs = std::filesystem;

/// A data set of one recording of 400 000 rows and five columns, some 24 MB, as a bench writes it.
class BigSet {
 public:
  BigSet() : folder_(fs::temp_directory_path() / fmt::format("flexspline-bench-{}", ::getpid())) {
    fs::create_directories(folder_);
    std::ofstream(folder_ / "dataset.toml")
        << "schema = \"flexspline-dataset/1\"\nname = \"big\"\nrig = \"locked\"\n"
           "[constants]\ngear_ratio = 50\n[channels]\n"
           "t = { quantity = \"time\", unit = \"s\" }\n"
           "q = { quantity = \"motor_angle\", unit = \"deg\" }\n"
           "l = { quantity = \"load_angle\", unit = \"deg\" }\n"
           "tau = { quantity = \"transmitted_torque\", unit = \"Nm\" }\n"
           "u = { quantity = \"motor_torque\", unit = \"Nm\" }\n"
           "[[recording]]\nid = \"a\"\nfile = \"a.csv\"\n";
    std::ofstream table(table_path());
    table << "t,q,l,tau,u\n";
    for (int i = 0; i < 400'000; ++i) {
      const double t = 1e-3 * i;
      table << fmt::format("{:.3f},{:.8f},{:.8f},{:.6f},{:.6f}\n", t, 10.0 * std::sin(t),
                           0.001 * std::sin(3.7 * t), 20.0 * std::sin(t + 0.1),
                           0.4 * std::sin(t + 0.2));
    }
  }
  BigSet(const BigSet&) = delete;
  BigSet& operator=(const BigSet&) = delete;
  ~BigSet() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  const fs::path& folder() const { return folder_; }
  fs::path table_path() const { return folder_ / "a.csv"; }
  std::int64_t bytes() const { return static_cast<std::int64_t>(fs::file_size(table_path())); }

 private:
  fs::path folder_;
};

const BigSet& big() {
  static const BigSet set;
  return set;
}

class CountingSink : public data::TableSink {
 public:
  std::vector<std::size_t> begin(const data::TableHead& head) override {
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < head.columns.size(); ++i) all.push_back(i);
    return all;
  }
  void rows(std::span<const std::vector<double>> columns) override { rows_ += columns[0].size(); }
  void note(const std::string&) override {}
  std::size_t count() const { return rows_; }

 private:
  std::size_t rows_ = 0;
};

void text_table(benchmark::State& state) {
  const fs::path table = big().table_path();
  for (auto _ : state) {
    CountingSink sink;
    if (!data::read_tables(table, {}, sink)) state.SkipWithError("the table cannot be read");
    benchmark::DoNotOptimize(sink.count());
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations()) * big().bytes());
}
BENCHMARK(text_table)->UseRealTime()->Unit(benchmark::kMillisecond);

void data_set(benchmark::State& state) {
  for (auto _ : state) {
    const auto reading = data::read_dataset(big().folder());
    if (!reading.set) state.SkipWithError("the data set cannot be read");
    benchmark::DoNotOptimize(reading.set);
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations()) * big().bytes());
}
BENCHMARK(data_set)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace flexspline::bench
