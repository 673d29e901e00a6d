#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <new>
#include <thread>

#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dataset_fixture.hpp"
#include "table_fixture.hpp"
#include "tables/contained.hpp"

namespace flexspline::data {
namespace {

using ::testing::HasSubstr;

Result<void> crash(const std::filesystem::path&, const TableRequest&, TableSink& sink) {
  sink.begin({"", {{"t", "s"}}, {}});
  std::raise(SIGSEGV);
  return {};
}

Result<void> hang(const std::filesystem::path&, const TableRequest&, TableSink&) {
  std::this_thread::sleep_for(std::chrono::hours(1));
  return {};
}

Result<void> hunger(const std::filesystem::path&, const TableRequest&, TableSink&) {
  throw std::bad_alloc();
}

Result<void> write_file_of_its_own(const std::filesystem::path& path, const TableRequest&,
                                   TableSink&) {
  std::signal(SIGXFSZ, SIG_IGN);
  std::ofstream(path.string() + ".stolen") << std::string(1000, 'x') << std::flush;
  return {};
}

Result<void> too_many_rows(const std::filesystem::path&, const TableRequest& request,
                           TableSink& sink) {
  sink.begin({"", {{"t", "s"}}, {}});
  const std::vector<std::vector<double>> block(1, std::vector<double>(request.limits.rows + 1));
  sink.rows(block);
  return {};
}

Result<void> unequal_columns(const std::filesystem::path&, const TableRequest&, TableSink& sink) {
  sink.begin({"", {{"t", "s"}, {"x", ""}}, {}});
  const std::vector<std::vector<double>> block = {{1.0, 2.0}, {1.0}};
  sink.rows(block);
  return {};
}

std::string said_of(Result<void> (*read)(const std::filesystem::path&, const TableRequest&,
                                         TableSink&)) {
  TableRequest request;
  request.limits.rows = 1000;
  request.limits.silence_s = 0.3;
  KeepingSink sink;
  const TableReaderRow row{.id = "broken", .says = "", .by_others = true, .read = read};
  const auto done = read_contained(row, "some.mat", request, sink);
  return done ? "" : done.error().message();
}

TEST(Contained, ACrashIsAnErrorOfTheFile) {
  EXPECT_THAT(said_of(crash), HasSubstr("some.mat: the reader 'broken' ended on it"));
  EXPECT_THAT(said_of(hang), HasSubstr("takes longer than 0.3 s"));
  EXPECT_THAT(said_of(hunger), HasSubstr("more memory than it may have"));
  EXPECT_THAT(said_of(too_many_rows), HasSubstr("said what it may not"));
  EXPECT_THAT(said_of(unequal_columns), HasSubstr("said what it may not"));
}

class ContainedFile : public InFolder {};

TEST_F(ContainedFile, WritesNothing) {
  KeepingSink sink;
  const TableReaderRow row{
      .id = "thief", .says = "", .by_others = true, .read = write_file_of_its_own};
  EXPECT_TRUE(read_contained(row, folder_ / "a.mat", {}, sink));
  std::error_code none;
  EXPECT_LE(std::filesystem::exists(folder_ / "a.mat.stolen")
                ? std::filesystem::file_size(folder_ / "a.mat.stolen", none)
                : 0U,
            0U);
}

/// A sink that changes the file while it is read.
class ChangingSink : public KeepingSink {
 public:
  explicit ChangingSink(std::filesystem::path path) : path_(std::move(path)) {}
  void rows(std::span<const std::vector<double>> columns) override {
    std::ofstream(path_, std::ios::app) << "1,2\n";
    KeepingSink::rows(columns);
  }

 private:
  std::filesystem::path path_;
};

TEST_F(ContainedFile, AFileThatChangesIsNoticed) {
  put("a.csv", "t,tau\n0,1\n1,2\n2,3\n3,4\n");
  ChangingSink sink(folder_ / "a.csv");
  const auto done = read_tables(folder_ / "a.csv", {}, sink);
  ASSERT_FALSE(done);
  EXPECT_THAT(done.error().message(), HasSubstr("changed while it was read"));
}

}  // namespace
}  // namespace flexspline::data
