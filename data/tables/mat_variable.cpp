#include "tables/mat_variable.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <limits>

#include "tables/text_encoding.hpp"

namespace flexspline::data {
namespace {

std::size_t count_of(const matvar_t& variable) {
  if (variable.dims == nullptr || variable.rank < 1) return 0;
  std::size_t count = 1;
  for (int d = 0; d < variable.rank; ++d) {
    const std::size_t size = variable.dims[d];
    if (size > 0 && count > std::numeric_limits<std::size_t>::max() / 64 / size) return 0;
    count *= size;
  }
  return count;
}

template <class T>
double at(const void* data, std::size_t i) {
  return static_cast<double>(static_cast<const T*>(data)[i]);
}

double value_at(const matvar_t& variable, std::size_t i) {
  switch (variable.data_type) {
    case MAT_T_DOUBLE:
      return at<double>(variable.data, i);
    case MAT_T_SINGLE:
      return at<float>(variable.data, i);
    case MAT_T_INT8:
      return at<std::int8_t>(variable.data, i);
    case MAT_T_UINT8:
      return at<std::uint8_t>(variable.data, i);
    case MAT_T_INT16:
      return at<std::int16_t>(variable.data, i);
    case MAT_T_UINT16:
      return at<std::uint16_t>(variable.data, i);
    case MAT_T_INT32:
      return at<std::int32_t>(variable.data, i);
    case MAT_T_UINT32:
      return at<std::uint32_t>(variable.data, i);
    case MAT_T_INT64:
      return at<std::int64_t>(variable.data, i);
    case MAT_T_UINT64:
      return at<std::uint64_t>(variable.data, i);
    default:
      return std::numeric_limits<double>::quiet_NaN();
  }
}

bool equal_letters(std::string_view a, std::string_view b) {
  return std::ranges::equal(
      a, b, [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

}  // namespace

std::string MatVariable::name() const { return variable_->name == nullptr ? "" : variable_->name; }

bool MatVariable::is_numeric() const {
  switch (variable_->class_type) {
    case MAT_C_DOUBLE:
    case MAT_C_SINGLE:
    case MAT_C_INT8:
    case MAT_C_UINT8:
    case MAT_C_INT16:
    case MAT_C_UINT16:
    case MAT_C_INT32:
    case MAT_C_UINT32:
    case MAT_C_INT64:
    case MAT_C_UINT64:
      break;
    default:
      return false;
  }
  // What is held must be as long as what is said of it.
  const std::size_t count = count_of(*variable_);
  return variable_->isComplex == 0 && variable_->data != nullptr && count > 0 &&
         variable_->data_size > 0 &&
         variable_->nbytes / static_cast<std::size_t>(variable_->data_size) >= count &&
         Mat_SizeOf(variable_->data_type) == static_cast<std::size_t>(variable_->data_size);
}

bool MatVariable::is_struct() const { return variable_->class_type == MAT_C_STRUCT; }

std::size_t MatVariable::rows() const { return variable_->rank > 0 ? variable_->dims[0] : 0; }

std::size_t MatVariable::columns() const { return rows() == 0 ? 0 : count_of(*variable_) / rows(); }

bool MatVariable::is_vector() const {
  return is_numeric() && std::max(rows(), columns()) > 1 && std::min(rows(), columns()) == 1;
}

std::vector<double> MatVariable::column(std::size_t index) const {
  std::vector<double> values(rows());
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = value_at(*variable_, index * rows() + i);
  return values;
}

std::vector<double> MatVariable::values() const {
  std::vector<double> all(count_of(*variable_));
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = value_at(*variable_, i);
  return all;
}

std::string MatVariable::text() const {
  if (variable_ == nullptr || variable_->class_type != MAT_C_CHAR || variable_->data == nullptr)
    return {};
  const std::size_t count = std::min<std::size_t>(count_of(*variable_), 1024);
  const auto* bytes = static_cast<const char*>(variable_->data);
  const bool wide = variable_->data_type == MAT_T_UINT16 || variable_->data_type == MAT_T_UTF16;
  const std::size_t size = std::min(variable_->nbytes, wide ? 2 * count : count);
  return decoded({bytes, size},
                 wide ? Encoding::utf16_little : sniff_encoding({bytes, size}).encoding);
}

std::size_t MatVariable::elements() const { return count_of(*variable_); }

std::vector<std::string> MatVariable::fields() const {
  std::vector<std::string> names;
  const unsigned count = Mat_VarGetNumberOfFields(variable_);
  char* const* given = Mat_VarGetStructFieldnames(variable_);
  for (unsigned f = 0; given != nullptr && f < count; ++f) {
    if (given[f] != nullptr) names.emplace_back(given[f]);
  }
  return names;
}

/// Of a damaged struct matio knows the size and the names, and has no elements.
MatVariable MatVariable::field(const std::string& name, std::size_t element) const {
  if (variable_->data == nullptr || element >= elements()) return MatVariable(nullptr);
  return MatVariable(Mat_VarGetStructFieldByName(variable_, name.c_str(), element));
}

MatVariable MatVariable::any_field(std::initializer_list<std::string_view> names,
                                   std::size_t element) const {
  if (variable_ == nullptr || !is_struct()) return MatVariable(nullptr);
  for (const std::string& one : fields()) {
    for (const std::string_view name : names) {
      if (equal_letters(one, name)) return field(one, element);
    }
  }
  return MatVariable(nullptr);
}

}  // namespace flexspline::data
