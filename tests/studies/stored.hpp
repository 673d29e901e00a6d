#pragma once

#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "flexspline/core/case_store.hpp"
#include "flexspline/data/artefact.hpp"

namespace flexspline::studies {

/// A case of a study's folder as it is kept; empty after a failure of the test.
inline StoredCase stored_case(const std::filesystem::path& folder, const std::string& key) {
  const auto store = CaseStore::open(folder);
  EXPECT_TRUE(store) << (store ? "" : store.error().message());
  if (!store) return {};
  const auto one = store->read(key);
  EXPECT_TRUE(one) << (one ? "" : one.error().message());
  return one ? *one : StoredCase{};
}

/// Its artefact, with a checksum that holds.
inline nlohmann::ordered_json stored_artefact(const std::filesystem::path& folder,
                                              const std::string& key) {
  const auto read =
      data::parse_artefact(stored_case(folder, key).artefact, key, "flexspline-case/1");
  EXPECT_TRUE(read) << (read ? "" : read.error().message());
  return read ? *read : nlohmann::ordered_json{};
}

/// Puts other content in the place of a case, with a checksum that holds.
inline void replace_case(const std::filesystem::path& folder, const std::string& key,
                         const nlohmann::ordered_json& artefact) {
  StoredCase one = stored_case(folder, key);
  one.artefact = data::sealed(artefact);
  auto journal = JournalWriter::open(folder / "journals");
  ASSERT_TRUE(journal) << journal.error().message();
  ASSERT_TRUE(append_case(*journal, one));
}

/// Takes a case out of the journals.
inline void remove_case(const std::filesystem::path& folder, const std::string& key) {
  ASSERT_TRUE(JournalWriter::set_aside(folder / "journals",
                                       [&](JournalFields fields) { return fields[0] != key; }));
}

}  // namespace flexspline::studies
