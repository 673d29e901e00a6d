#pragma once

#include <compare>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "flexspline/core/journal.hpp"

namespace flexspline {

/// A case as a study's folder keeps it: the fields of a journal's record, in this order.
struct StoredCase {
  std::string key;
  std::string depends_on;  ///< SHA-256 over everything that its result depends on, hex
  std::string failure;     ///< why it failed, on one line; empty: it did not
  double seconds = 0.0;    ///< wall time of its computation; no part of the artefact
  std::string row;         ///< JSON of what tables ask of it
  std::string artefact;    ///< JSON as in cases/<key>.json, without the line end

  bool failed() const { return !failure.empty(); }
};

/// The same without its texts.
struct CaseHead {
  std::string_view key, depends_on, failure;
  double seconds = 0.0;
};

/// Where results of cases lie in a study's folder: journals/*.journal, or in folders of version 1
/// cases/*.json. It only reads. A case that is there more than once counts once, as it was written
/// last in the alphabetical order of the journals.
class CaseStore {
 public:
  /// First half of depends_on: names what a result belongs to.
  struct Digest {
    std::uint64_t high = 0, low = 0;
    auto operator<=>(const Digest&) const = default;
  };
  static Digest digest_of(std::string_view depends_on);

  /// Looks through the folder; visit gets every record. A folder without cases is an empty store.
  /// Errors: bad_data for journals of another version.
  static Result<CaseStore> open(const std::filesystem::path& folder,
                                const std::function<void(const CaseHead&)>& visit = {});

  std::size_t size() const { return cases_.size(); }
  std::size_t failed() const;
  bool contains(const Digest& digest) const { return find(digest) != nullptr; }

  /// By what it depends on. Errors: input_missing; bad_data where it was damaged since.
  Result<StoredCase> read(const Digest& digest) const;
  /// By its key. Errors: as above.
  Result<StoredCase> read(std::string_view key) const;
  /// Every key, in alphabetical order; at most so many.
  std::vector<std::string> keys(std::size_t most = static_cast<std::size_t>(-1)) const;

  /// "journals/a.journal: 2 damaged records": what is lost and computed again.
  const std::vector<std::string>& damaged() const { return damaged_; }

 private:
  struct Entry {
    Digest digest;
    std::string key;
    std::uint32_t file = 0;
    bool failed = false;
    RecordPlace place;  ///< of size 0: a whole file
  };

  Result<void> add_journal(const std::filesystem::path& file,
                           const std::function<void(const CaseHead&)>& visit);
  void add_file(const std::filesystem::path& file);
  void sort();
  const Entry* find(const Digest& digest) const;
  Result<StoredCase> read(const Entry& entry) const;

  std::filesystem::path folder_;
  std::vector<std::filesystem::path> files_;
  std::vector<Entry> cases_;           ///< by digest
  std::vector<std::uint32_t> by_key_;  ///< indices, one a key
  std::vector<std::string> damaged_;
};

/// Appends a case to a journal. Errors: cannot_write.
Result<void> append_case(JournalWriter& journal, const StoredCase& one);

}  // namespace flexspline
