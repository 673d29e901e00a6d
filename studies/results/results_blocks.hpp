#pragma once

#include <string>
#include <vector>

#include "results/netcdf_file.hpp"

namespace flexspline::studies {

/// A variable of numbers over the variants and some dimensions more, of which as many variants are
/// held in memory as fit into a block.
class BlockVariable {
 public:
  BlockVariable(NetcdfFile& file, int id, std::vector<std::size_t> extent, bool swept)
      : file_(&file), id_(id), extent_(std::move(extent)), swept_(swept), size_(1) {
    for (const std::size_t one : extent_) size_ *= one;
  }

  /// The place of one variant's numbers; variants come in ascending order.
  double* at(std::size_t variant);
  void flush();
  const std::vector<std::size_t>& extent() const { return extent_; }

 private:
  NetcdfFile* file_;
  int id_;
  std::vector<std::size_t> extent_;  ///< but for the variants
  bool swept_;
  std::size_t size_;
  std::size_t first_ = 0;
  std::vector<double> held_;
};

/// A variable over the rows, written a few thousand at a time.
class RowVariable {
 public:
  RowVariable(NetcdfFile& file, int id) : file_(&file), id_(id) {}
  void add(double value);
  void add(std::string word);
  void flush();

 private:
  NetcdfFile* file_;
  int id_;
  std::size_t written_ = 0;
  std::vector<double> values_;
  std::vector<std::string> words_;
};

}  // namespace flexspline::studies
