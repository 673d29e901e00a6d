#include <sys/stat.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "flexspline/core/write_file.hpp"

namespace flexspline {
namespace {

namespace fs = std::filesystem;

class WriteFile : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() / (std::string("flexspline-write-") + test->name());
    fs::remove_all(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::ptrdiff_t files() const {
    return std::distance(fs::directory_iterator(folder_), fs::directory_iterator());
  }

  fs::path folder_;
};

TEST_F(WriteFile, ReadsBackAndLeavesNothingElse) {
  const std::string content("line\n\0end", 9);
  ASSERT_TRUE(write_file(folder_ / "a" / "b.txt", "old").has_value());
  ASSERT_TRUE(write_file(folder_ / "a" / "b.txt", content).has_value());
  EXPECT_EQ(read_file(folder_ / "a" / "b.txt").value(), content);
  folder_ /= "a";
  EXPECT_EQ(files(), 1);
  folder_ = folder_.parent_path();
}

TEST_F(WriteFile, FailsBelowAFileAndLeavesNothing) {
  ASSERT_TRUE(write_file(folder_ / "file", "").has_value());
  const auto below = write_file(folder_ / "file" / "x.txt", "content");
  ASSERT_FALSE(below.has_value());
  EXPECT_EQ(below.error().code, ErrorCode::cannot_write);
  EXPECT_THAT(below.error().problem, testing::HasSubstr((folder_ / "file" / "x.txt").string()));
  EXPECT_EQ(files(), 1);
}

TEST_F(WriteFile, FailsOverAFolderAndLeavesNothing) {
  fs::create_directories(folder_ / "taken" / "inner");
  const auto over = write_file(folder_ / "taken", "content");
  ASSERT_FALSE(over.has_value());
  EXPECT_EQ(over.error().code, ErrorCode::cannot_write);
  EXPECT_EQ(files(), 1);
}

TEST_F(WriteFile, AnUnfinishedFileIsRemovedByWhoeverEnds) {
  fs::create_directories(folder_);
  {
    UnfinishedFile file(folder_ / "a");
    std::ofstream(file.path()) << "half";
    EXPECT_EQ(files(), 1);
    remove_unfinished_files();
    EXPECT_EQ(files(), 0);
    std::ofstream(file.path()) << "half";
  }
  EXPECT_EQ(files(), 0);
  UnfinishedFile file(folder_ / "a");
  std::ofstream(file.path()) << "whole";
  EXPECT_FALSE(file.finish());
  remove_unfinished_files();
  EXPECT_EQ(read_file(folder_ / "a").value(), "whole");
}

TEST_F(WriteFile, FindsNothingWhereItCannotLook) {
  fs::create_directories(folder_);
  EXPECT_TRUE(file_exists(folder_));
  EXPECT_FALSE(file_exists(folder_ / "absent"));
  EXPECT_FALSE(file_exists(folder_ / std::string(5000, 'x')));
}

TEST_F(WriteFile, ReadingSaysWhichFileAndWhy) {
  const auto absent = read_file(folder_ / "absent.csv");
  ASSERT_FALSE(absent.has_value());
  EXPECT_EQ(absent.error().code, ErrorCode::input_missing);
  EXPECT_THAT(absent.error().problem, testing::HasSubstr("absent.csv: No such file"));
  fs::create_directories(folder_);
  EXPECT_THAT(read_file(folder_).error().problem, testing::HasSubstr("it is a folder"));
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_THAT(read_file(folder_ / "pipe").error().problem,
              testing::HasSubstr("it is no regular file"))
      << "it would wait for somebody to write";
}

}  // namespace
}  // namespace flexspline
