#include "flexspline/data/sanity_codes.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "flexspline/core/nearest_name.hpp"
#include "sanity/check.hpp"

namespace flexspline::data {
namespace {

std::vector<std::string_view> known_codes() {
  std::vector<std::string_view> known = {"check_units", "check_sign", "check_ratio",
                                         "check_channel"};
  for (const SanityRow& row : sanity_checks()) known.push_back(row.id);
  return known;
}

std::string note_of(std::string_view code) {
  return fmt::format("accepted: what {} finds is no mistake here", code);
}

}  // namespace

bool is_sanity_code(std::string_view code) {
  const auto known = known_codes();
  return std::ranges::find(known, code) != known.end();
}

std::string sanity_code_suggestion(std::string_view code) {
  return suggestion(code, known_codes());
}

void accept_finding(RecordingSet& set, std::string_view code) {
  set.notes.push_back(note_of(code));
}

std::vector<std::string_view> accepted_findings(const RecordingSet& set) {
  std::vector<std::string_view> accepted = known_codes();
  std::erase_if(accepted, [&](std::string_view code) {
    return std::ranges::find(set.notes, note_of(code)) == set.notes.end();
  });
  return accepted;
}

}  // namespace flexspline::data
