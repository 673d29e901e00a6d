#include <fmt/format.h>

#include <charconv>
#include <numbers>
#include <vector>

#include "flexspline/core/nearest_name.hpp"
#include "flexspline/data/import.hpp"
#include "import/short_names.hpp"
#include "tables/unit_words.hpp"

namespace flexspline::data {
namespace {

tl::unexpected<Error> refused(std::string_view text, const std::string& why,
                              const std::string& remedy) {
  return failure(ErrorCode::usage, fmt::format("--map {}: {}", text, why), remedy);
}

Result<Quantity> quantity_of(std::string_view text, std::string_view name) {
  if (const auto found = quantity_of_short_name(name)) return *found;
  if (const auto found = find_quantity(name)) return *found;
  std::vector<std::string_view> known = {"t", "theta_m", "theta_l", "tau", "tau_m"};
  for (const QuantityInfo& info : quantities()) known.push_back(info.name);
  return refused(text, fmt::format("there is no quantity '{}'", name), suggestion(name, known));
}

/// "Nm", "-deg", "counts/4096".
Result<void> take_unit(std::string_view text, std::string_view word, ColumnChoice& choice) {
  if (word.starts_with('-')) {
    choice.sign = -1.0;
    word.remove_prefix(1);
  }
  if (word.empty()) return {};
  if (word.starts_with("counts/")) {
    const std::string_view digits = word.substr(7);
    const auto [stop, code] =
        std::from_chars(digits.data(), digits.data() + digits.size(), choice.counts_per_rev);
    const bool read = code == std::errc{} && stop == digits.data() + digits.size();
    if (!read || !(choice.counts_per_rev >= 1.0 && choice.counts_per_rev <= 1e12)) {
      return refused(text, "the counts of a turn are no number of 1 to 1e12", "write counts/4096");
    }
    choice.unit =
        Unit{"counts", Dimension::angle, 2.0 * std::numbers::pi / choice.counts_per_rev, 0.0};
    return {};
  }
  choice.unit = unit_of_word(word);
  if (choice.unit && choice.unit->symbol != "counts") return {};
  return refused(text, fmt::format("unknown unit '{}'", word),
                 "docs/dataset.md lists the units; an encoder's is counts/4096");
}

}  // namespace

Result<ColumnChoice> parse_column_choice(std::string_view text) {
  const auto equals = text.find('=');
  if (equals == text.npos || equals + 1 == text.size()) {
    return refused(text, "it has no column", "write QUANTITY=COLUMN:UNIT, e.g. tau=col4:Nm");
  }
  ColumnChoice choice;
  const auto quantity = quantity_of(text, text.substr(0, equals));
  if (!quantity) return tl::unexpected(quantity.error());
  choice.quantity = *quantity;
  const std::string_view rest = text.substr(equals + 1);
  if (rest == "none") return choice;
  const auto colon = rest.rfind(':');
  choice.column = rest.substr(0, colon);
  if (colon == rest.npos) return choice;
  if (auto taken = take_unit(text, rest.substr(colon + 1), choice); !taken) {
    return tl::unexpected(taken.error());
  }
  return choice;
}

}  // namespace flexspline::data
