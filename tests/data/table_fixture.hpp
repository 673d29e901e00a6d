#pragma once

#include <string>
#include <vector>

#include "flexspline/data/table_reader.hpp"

namespace flexspline::data {

/// A table as a reader told it.
struct ToldTable {
  TableHead head;
  std::vector<std::vector<double>> columns;
};

/// Keeps all that is told.
class KeepingSink : public TableSink {
 public:
  std::vector<std::size_t> begin(const TableHead& head) override {
    tables.push_back({head, std::vector<std::vector<double>>(head.columns.size())});
    for (const std::string& one : head.notes) notes += one + "\n";
    std::vector<std::size_t> all(head.columns.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    return all;
  }
  void rows(std::span<const std::vector<double>> columns) override {
    for (std::size_t c = 0; c < columns.size(); ++c) {
      auto& to = tables.back().columns[c];
      to.insert(to.end(), columns[c].begin(), columns[c].end());
    }
  }
  void note(const std::string& text) override { notes += text + "\n"; }

  std::vector<ToldTable> tables;
  std::string notes;
};

}  // namespace flexspline::data
