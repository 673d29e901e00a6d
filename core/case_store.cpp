#include "flexspline/core/case_store.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <numeric>
#include <system_error>
#include <tuple>

#include <fmt/format.h>

#include "flexspline/core/write_file.hpp"

namespace flexspline {
namespace {

namespace fs = std::filesystem;

enum Field : std::size_t { kKey, kDependsOn, kFailure, kSeconds, kRow, kArtefact, kFields };

double number_of(std::string_view text) {
  double value = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

std::uint64_t hex_of(std::string_view digits) {
  std::uint64_t value = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
  return value;
}

bool is_case(JournalFields fields) {
  return fields.size() == kFields && fields[kDependsOn].size() >= 32;
}

/// Text of a failure as a field: on one line.
std::string on_one_line(std::string text) {
  std::ranges::replace_if(
      text, [](unsigned char letter) { return letter < 0x20; }, ' ');
  return text;
}

}  // namespace

CaseStore::Digest CaseStore::digest_of(std::string_view depends_on) {
  if (depends_on.size() < 32) return {std::hash<std::string_view>()(depends_on), 0};
  return {hex_of(depends_on.substr(0, 16)), hex_of(depends_on.substr(16, 16))};
}

Result<void> CaseStore::add_journal(const fs::path& file,
                                    const std::function<void(const CaseHead&)>& visit) {
  std::size_t strange = 0;
  const auto number = static_cast<std::uint32_t>(files_.size());
  const auto scan = scan_journal(file, [&](JournalFields fields, RecordPlace place) {
    if (!is_case(fields)) {
      ++strange;
      return;
    }
    cases_.push_back({digest_of(fields[kDependsOn]), std::string(fields[kKey]), number,
                      !fields[kFailure].empty(), place});
    if (visit) {
      visit({fields[kKey], fields[kDependsOn], fields[kFailure], number_of(fields[kSeconds])});
    }
  });
  if (!scan) return tl::unexpected(scan.error());
  files_.push_back(file);
  if (const std::size_t lost = strange + scan->damaged.size(); lost > 0) {
    damaged_.push_back(fmt::format("journals/{}: {} damaged record{}", file.filename().string(),
                                   lost, lost == 1 ? "" : "s"));
  }
  return {};
}

void CaseStore::add_file(const fs::path& file) {
  std::string key = file.stem().string();
  const Digest digest{std::hash<std::string>()(key), 1};
  cases_.push_back({digest, std::move(key), static_cast<std::uint32_t>(files_.size()), false, {}});
  files_.push_back(file);
}

/// Records of one file lie in the order of their writing.
void CaseStore::sort() {
  std::ranges::stable_sort(cases_, {}, &Entry::digest);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < cases_.size(); ++i) {
    if (kept > 0 && cases_[kept - 1].digest == cases_[i].digest) --kept;
    if (kept != i) cases_[kept] = std::move(cases_[i]);
    ++kept;
  }
  cases_.resize(kept);
  by_key_.resize(kept);
  std::iota(by_key_.begin(), by_key_.end(), 0U);
  const auto rank = [&](std::uint32_t i) {
    const Entry& one = cases_[i];
    return std::tuple(std::string_view(one.key), one.file, one.place.offset);
  };
  std::ranges::sort(by_key_, std::ranges::greater{}, rank);
  const auto older = std::ranges::unique(
      by_key_, {}, [&](std::uint32_t i) -> const std::string& { return cases_[i].key; });
  by_key_.erase(older.begin(), older.end());
  std::ranges::reverse(by_key_);
}

std::size_t CaseStore::failed() const {
  return static_cast<std::size_t>(std::ranges::count(cases_, true, &Entry::failed));
}

Result<CaseStore> CaseStore::open(const fs::path& folder,
                                  const std::function<void(const CaseHead&)>& visit) {
  CaseStore store;
  store.folder_ = folder;
  for (const fs::path& file : journals_in(folder / "journals")) {
    if (const auto added = store.add_journal(file, visit); !added) {
      return tl::unexpected(added.error());
    }
  }
  if (store.files_.empty()) {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder / "cases", ignored)) {
      if (entry.path().extension() == ".json") store.add_file(entry.path());
    }
  }
  store.sort();
  return store;
}

const CaseStore::Entry* CaseStore::find(const Digest& digest) const {
  const auto found = std::ranges::lower_bound(cases_, digest, {}, &Entry::digest);
  return found == cases_.end() || found->digest != digest ? nullptr : &*found;
}

Result<StoredCase> CaseStore::read(const Digest& digest) const {
  const Entry* entry = find(digest);
  if (entry == nullptr) return failure(ErrorCode::input_missing, "the case is not there");
  return read(*entry);
}

Result<StoredCase> CaseStore::read(std::string_view key) const {
  const auto of = [&](std::uint32_t i) -> std::string_view { return cases_[i].key; };
  const auto found = std::ranges::lower_bound(by_key_, key, {}, of);
  if (found != by_key_.end() && of(*found) == key) return read(cases_[*found]);
  return failure(ErrorCode::input_missing,
                 fmt::format("{} holds no case '{}'", folder_.string(), key));
}

Result<StoredCase> CaseStore::read(const Entry& entry) const {
  const fs::path& file = files_[entry.file];
  if (entry.place.size == 0) {
    auto text = read_file(file);
    if (!text) return tl::unexpected(text.error());
    while (text->ends_with('\n')) text->pop_back();
    return StoredCase{file.stem().string(), {}, {}, 0.0, {}, std::move(*text)};
  }
  const auto record = read_record(file, entry.place);
  if (!record) return tl::unexpected(record.error());
  const auto fields = fields_of(*record);
  if (!is_case(fields)) return failure(ErrorCode::bad_data, file.string() + ": no case");
  const auto text = [&](Field field) { return std::string(fields[field]); };
  return StoredCase{text(kKey), text(kDependsOn), text(kFailure), number_of(fields[kSeconds]),
                    text(kRow), text(kArtefact)};
}

std::vector<std::string> CaseStore::keys(std::size_t most) const {
  std::vector<std::string> names;
  for (const std::uint32_t i : by_key_) {
    if (names.size() == most) break;
    names.push_back(cases_[i].key);
  }
  return names;
}

Result<void> append_case(JournalWriter& journal, const StoredCase& one) {
  const std::string failure = on_one_line(one.failure);
  const std::string seconds = fmt::format("{:.6g}", one.seconds);
  const std::array<std::string_view, kFields> fields = {one.key, one.depends_on, failure,
                                                        seconds, one.row,        one.artefact};
  return journal.append(fields);
}

}  // namespace flexspline
