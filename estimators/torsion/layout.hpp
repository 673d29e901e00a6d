#pragma once

#include <span>
#include <string>
#include <vector>

#include "flexspline/core/law.hpp"
#include "flexspline/core/model_spec.hpp"
#include "solvers/least_squares.hpp"

namespace flexspline::estimators {

/// A run of parameters that belong together.
struct Group {
  std::size_t first = 0;
  std::size_t count = 0;

  bool present() const { return count > 0; }
  std::span<double> of(std::span<double> all) const {
    return count > 0 ? all.subspan(first, count) : all.first(0);
  }
  std::span<const double> of(std::span<const double> all) const {
    return count > 0 ? all.subspan(first, count) : all.first(0);
  }
};

/// What is free in a fit of the torsion law, and where it stands in the parameter vector.
/// Coefficients of f and g^-1 in Nm (N), of ln h dimensionless, inertia in Nm s2/rad, delay in s,
/// offset in Nm, zeros and initial torsions in rad (m).
struct FreeTerms {
  std::size_t h = 0;  ///< degree of ln h; 0: h = 1
  bool inertia = false;
  bool delay = false;
  bool offset = false;
  bool zeros = false;
  bool initial = false;
};

class TorsionLayout {
 public:
  /// Laws with their knots and scales; coefficients are not read. f_size and g_size count both
  /// sides.
  TorsionLayout(LawSpec f, std::size_t f_size, LawSpec g_inverse, std::size_t g_size,
                double h_scale, std::vector<std::string> records, FreeTerms free);

  std::size_t size() const { return size_; }
  const FreeTerms& free_terms() const { return free_; }
  const std::vector<std::string>& records() const { return records_; }

  LawSpec f(std::span<const double> p) const;
  LawSpec g_inverse(std::span<const double> p) const;
  LawSpec h(std::span<const double> p) const;
  /// The laws with inertia, delay and offset as effects.
  ModelSpec model(std::span<const double> p) const;

  double inertia(std::span<const double> p) const { return first_of(inertia_group, p); }
  double delay(std::span<const double> p) const { return first_of(delay_group, p); }
  double offset(std::span<const double> p) const { return first_of(offset_group, p); }
  double zero(std::size_t record, std::span<const double> p) const {
    return zero_group.present() ? p[zero_group.first + record] : 0.0;
  }

  /// Values of another layout carried over group by group, as far as both reach; new ones are zero.
  std::vector<double> carry_over(const TorsionLayout& from, std::span<const double> p) const;

  std::string name(std::size_t k) const;
  std::string unit(std::size_t k, bool angular) const;

  Group f_group, g_group, h_group, inertia_group, delay_group, offset_group, zero_group,
      initial_group;

 private:
  static double first_of(const Group& group, std::span<const double> p) {
    return group.present() ? p[group.first] : 0.0;
  }
  std::string coefficient_name(std::string_view law, const LawSpec& spec, std::size_t k,
                               std::size_t size) const;

  LawSpec f_, g_inverse_, h_;
  std::vector<std::string> records_;
  FreeTerms free_;
  std::size_t size_ = 0;
};

}  // namespace flexspline::estimators
