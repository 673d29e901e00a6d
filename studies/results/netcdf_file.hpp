#pragma once

#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace flexspline::studies {

inline constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

enum class Stored { number, integer, text };

/// A netCDF-4 file that is being written. Remembers the first failure and does nothing after it.
class NetcdfFile {
 public:
  explicit NetcdfFile(const std::filesystem::path& path);
  ~NetcdfFile() { close(); }
  NetcdfFile(const NetcdfFile&) = delete;
  NetcdfFile& operator=(const NetcdfFile&) = delete;

  void text(const std::string& key, const std::string& value);
  int dimension(const std::string& name, std::size_t size);
  /// By CF a coordinate, the variable that its dimension is called after, has no missing values.
  int variable(const std::string& name, const std::string& says, const std::string& unit,
               const std::vector<int>& dimensions, Stored stored = Stored::number,
               bool coordinate = false);
  void put(int variable, std::span<const double> values);
  void put(int variable, std::span<const std::string> words);
  /// A block, its first index and its extent in each dimension.
  void put(int variable, std::span<const double> values, const std::vector<std::size_t>& first,
           const std::vector<std::size_t>& extent);
  void put(int variable, std::span<const std::string> words, const std::vector<std::size_t>& first,
           const std::vector<std::size_t>& extent);
  /// Empty where all went well.
  std::string close();

 private:
  bool ok() const { return status_ == 0; }
  void check(int status) {
    if (ok()) status_ = status;
  }
  void attribute(int variable, const std::string& key, const std::string& value);

  int file_ = 0;
  int status_ = 0;
  bool open_ = false;
};

}  // namespace flexspline::studies
