#pragma once

#include <string>
#include <vector>

#include "flexspline/data/import.hpp"
#include "import/survey.hpp"

namespace flexspline::data {

/// A column that becomes a channel.
struct FoundChannel {
  Quantity quantity = Quantity::time;
  std::size_t column = 0;  ///< of the table
  Unit unit{};             ///< of its numbers
  double counts_per_rev = 0.0;
  double sign = 1.0;
};

/// A table that becomes one recording, or several where it is cut.
struct FoundTable {
  TableSurvey survey;
  std::string id;
  std::vector<FoundChannel> channels;  ///< in the order of those of the set
};

struct ImportParts {
  std::vector<FoundTable> tables;
  std::vector<FoundChannel> channels;  ///< of the set, with the first table's units; time first
  bool marks_absent = false;           ///< some cell is absent: a channel valid is written
};

/// What is found in a table, on the way to its channels.
struct TableFinding {
  std::vector<FoundChannel> channels;  ///< time first
  std::vector<Inference> inferred;
  std::vector<OpenQuestion> open;
  std::vector<std::string> notes;
};

}  // namespace flexspline::data
