#pragma once

#include <string>
#include <vector>

#include "flexspline/data/table_reader.hpp"
#include "tables/mat_variable.hpp"

namespace flexspline::data {

/// A table whose columns lie in memory.
struct MatTable {
  TableHead head;
  std::vector<std::vector<double>> columns;
  std::size_t own = 0;  ///< columns that do not lie in structs inside it

  void add(TableColumn column, std::vector<double> values);
};

/// Finds tables in variables of MATLAB: vectors side by side; columns of matrices; structs, arrays
/// of them, and structs beside their time; Time and Data of a timeseries; X and Y of dSPACE; time
/// and signals of Simulink.
class MatTables {
 public:
  explicit MatTables(const TableLimits& limits) : limits_(limits) {}

  void take(const MatVariable& variable);
  /// Vectors at the top, by their length, and all else.
  std::vector<MatTable> tables() &&;
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  void take_struct(const MatVariable& from, std::size_t element, const std::string& path,
                   std::size_t depth);
  void take_fields(const MatVariable& from, std::size_t element, const std::string& path,
                   std::size_t depth);
  void take_matrix(const MatVariable& matrix, const std::string& path);
  bool take_series(const MatVariable& from, std::size_t element, const std::string& path);
  bool take_dspace(const MatVariable& from, std::size_t element, const std::string& path);
  bool take_simulink(const MatVariable& from, std::size_t element, const std::string& path);
  MatTable& table(const std::string& path, std::size_t rows);
  void join_into_owners();
  void note(std::string text);

  const TableLimits& limits_;
  std::vector<MatTable> tables_;
  std::vector<std::string> notes_;
};

}  // namespace flexspline::data
