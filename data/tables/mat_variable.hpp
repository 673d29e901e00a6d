#pragma once

#include <string>
#include <vector>

#include <matio.h>

namespace flexspline::data {

/// A variable of MATLAB or an element of one, as matio holds it. Views: they live as long as it.
class MatVariable {
 public:
  explicit MatVariable(matvar_t* variable) : variable_(variable) {}
  explicit operator bool() const { return variable_ != nullptr; }

  std::string name() const;
  bool is_numeric() const;
  bool is_struct() const;
  bool is_complex() const { return variable_->isComplex != 0; }
  std::size_t rows() const;
  std::size_t columns() const;  ///< of all further dimensions together
  /// Longer than one, in one dimension alone.
  bool is_vector() const;

  std::vector<double> column(std::size_t index) const;  ///< of a matrix
  std::vector<double> values() const;                   ///< all of them
  /// Characters; empty where it is no text.
  std::string text() const;

  std::size_t elements() const;  ///< of a struct array
  std::vector<std::string> fields() const;
  MatVariable field(const std::string& name, std::size_t element = 0) const;
  /// By its name in any letters: Time, time.
  MatVariable any_field(std::initializer_list<std::string_view> names,
                        std::size_t element = 0) const;

 private:
  matvar_t* variable_;
};

}  // namespace flexspline::data
