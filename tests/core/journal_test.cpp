#include "flexspline/core/journal.hpp"

#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>
#include <unistd.h>

#include "flexspline/core/case_store.hpp"

namespace flexspline {
namespace {

namespace fs = std::filesystem;

class Journals : public testing::Test {
 protected:
  Journals() {
    std::string name = (fs::temp_directory_path() / "flexspline-XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~Journals() override { fs::remove_all(folder_); }

  void append(const std::string& a, const std::string& b) const {
    auto writer = JournalWriter::open(folder_);
    ASSERT_TRUE(writer) << writer.error().message();
    const std::array<std::string_view, 2> fields = {a, b};
    ASSERT_TRUE(writer->append(fields));
  }
  fs::path only() const {
    const auto files = journals_in(folder_);
    EXPECT_EQ(files.size(), 1U);
    return files.front();
  }
  static std::string text_of(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  }
  static std::vector<std::string> firsts(const fs::path& file) {
    std::vector<std::string> found;
    EXPECT_TRUE(scan_journal(
        file, [&](JournalFields fields, RecordPlace) { found.emplace_back(fields[0]); }));
    return found;
  }

  fs::path folder_;
};

TEST_F(Journals, GivesBackWhatWasAppended) {
  append("one", "{\"a\":1}");
  append("two", std::string(3'000'000, 'x'));  // longer than what is read at once
  append("three", "");
  std::vector<std::vector<std::string>> found;
  std::vector<RecordPlace> places;
  const auto scan = scan_journal(only(), [&](JournalFields fields, RecordPlace place) {
    found.emplace_back(fields.begin(), fields.end());
    places.push_back(place);
  });
  ASSERT_TRUE(scan) << scan.error().message();
  ASSERT_EQ(scan->records, 3U);
  EXPECT_FALSE(scan->torn);
  EXPECT_EQ(found[0], (std::vector<std::string>{"one", "{\"a\":1}"}));
  EXPECT_EQ(found[1][1].size(), 3'000'000U);
  EXPECT_EQ(found[2], (std::vector<std::string>{"three", ""}));
  const auto record = read_record(only(), places[1]);
  ASSERT_TRUE(record) << record.error().message();
  EXPECT_EQ(fields_of(*record)[0], "two");
}

// Whatever byte of a file is another, no record is another: it is as it was, or it is damaged.
TEST_F(Journals, NoFlippedByteGivesAnotherRecord) {
  append("one", "1.0");
  append("two", "2.0");
  const std::string whole = text_of(only());
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (const char mask : {'\x01', '\x10', '\x02'}) {
      std::string text = whole;
      text[at] = static_cast<char>(text[at] ^ mask);
      std::ofstream(only()) << text;
      std::size_t good = 0;
      const auto scan = scan_journal(only(), [&](JournalFields fields, RecordPlace) {
        ++good;
        const bool first = fields[0] == "one" && fields[1] == "1.0";
        const bool second = fields[0] == "two" && fields[1] == "2.0";
        EXPECT_TRUE(first || second) << fields[0];
      });
      if (!scan) continue;  // the schema is another
      EXPECT_TRUE(good < 2 || scan->damaged.size() == 1) << "byte " << at;
      EXPECT_TRUE(good == 2 || scan->torn || !scan->damaged.empty()) << "byte " << at;
    }
  }
}

// Cut anywhere, as by a killed writer, every record before the cut is there; the next one is
// appended as if nothing had been.
TEST_F(Journals, ATornTailIsCutWhereverItTears) {
  append("one", "1.0");
  append("two", "2.0");
  const std::string whole = text_of(only());
  for (std::size_t length = 0; length <= whole.size(); ++length) {
    std::ofstream(only(), std::ios::trunc) << whole.substr(0, length);
    const auto before = length == 0 ? std::vector<std::string>{} : firsts(only());
    append("three", "3.0");
    auto expected = before;
    expected.emplace_back("three");
    EXPECT_EQ(firsts(only()), expected) << length;
  }
}

TEST_F(Journals, TwoWritersHaveAFileEach) {
  auto first = JournalWriter::open(folder_);
  auto second = JournalWriter::open(folder_);
  ASSERT_TRUE(first && second);
  EXPECT_NE(first->path(), second->path());
  const fs::path freed = first->path();
  { const JournalWriter gone = std::move(*first); }
  const auto third = JournalWriter::open(folder_);
  ASSERT_TRUE(third);
  EXPECT_EQ(third->path(), freed) << "files are used again";
}

TEST_F(Journals, SetAsideKeepsWhatGoesBesideWhatStays) {
  append("keep", "1");
  append("go", "2");
  const auto keep = [](JournalFields fields) { return fields[0] == "keep"; };
  {
    const auto busy = JournalWriter::open(folder_);
    EXPECT_FALSE(*JournalWriter::set_aside(folder_, keep)) << "somebody writes there";
  }
  ASSERT_TRUE(*JournalWriter::set_aside(folder_, keep));
  EXPECT_EQ(firsts(only()), std::vector<std::string>{"keep"});
  EXPECT_EQ(firsts(only().string() + ".stale"), std::vector<std::string>{"go"});
}

TEST_F(Journals, OtherVersionsAreRefused) {
  auto writer = JournalWriter::open(folder_);
  ASSERT_TRUE(writer);
  // The checksum of this line was computed by zlib's crc32.
  std::ofstream(writer->path(), std::ios::trunc) << "2d7fa235\tflexspline-journal/2\n";
  const auto scan = scan_journal(writer->path(), [](JournalFields, RecordPlace) {});
  ASSERT_FALSE(scan);
  EXPECT_NE(scan.error().problem.find("flexspline-journal/2"), std::string::npos);
}

TEST_F(Journals, AStoreReadsByKeyAndByDigestTheLastOfEach) {
  const std::string digest(64, 'a');
  {
    auto writer = JournalWriter::open(folder_ / "journals");
    ASSERT_TRUE(writer);
    ASSERT_TRUE(
        append_case(*writer, {"a--b--r0", digest, "first\nfailure", 1.5, "{}", "{\"x\":1}"}));
    ASSERT_TRUE(append_case(*writer, {"a--b--r0", digest, "", 2.5, "{}", "{\"x\":2}"}));
    ASSERT_TRUE(append_case(*writer, {"a--c--r0", std::string(64, 'b'), "why not", 0, "{}", "{}"}));
  }
  const auto store = CaseStore::open(folder_);
  ASSERT_TRUE(store) << store.error().message();
  EXPECT_EQ(store->size(), 2U);
  EXPECT_EQ(store->failed(), 1U);
  EXPECT_EQ(store->keys(), (std::vector<std::string>{"a--b--r0", "a--c--r0"}));
  const auto one = store->read("a--b--r0");
  ASSERT_TRUE(one) << one.error().message();
  EXPECT_EQ(one->artefact, "{\"x\":2}");
  EXPECT_EQ(one->seconds, 2.5);
  EXPECT_TRUE(store->contains(CaseStore::digest_of(digest)));
  EXPECT_FALSE(store->read("a--d--r0"));
}

}  // namespace
}  // namespace flexspline
