#pragma once

#include <memory>

#include "flexspline/core/error.hpp"
#include "flexspline/core/law.hpp"
#include "flexspline/core/model_spec.hpp"

namespace flexspline {

/// How far recordings support a model: |phi| up to f's valid_to, |phi' / h(phi)| up to that of
/// g^-1. A law that does not say so (valid_to 0) is taken at its word everywhere.
/// Not modelled: bounds of effects.
class ModelDomain {
 public:
  /// Errors: those of a law that cannot be made.
  static Result<ModelDomain> of(const ModelSpec& model);

  /// Whether both laws say how far they are supported.
  bool is_known() const { return f_to_ > 0.0 && g_to_ > 0.0; }

  /// Of the range of f, and of g^-1, that is used at phi in rad (m) and phi' in rad/s (m/s): at
  /// most 1 inside; 0 where the model does not say.
  double share_of_f(double phi) const;
  double share_of_g_inverse(double phi, double rate) const;

  /// Inside of both, but for 2 % that noise and smoothing may add.
  bool holds_at(double phi, double rate) const;

 private:
  double f_to_ = 0.0;
  double g_to_ = 0.0;
  std::shared_ptr<const Law> h_;
};

}  // namespace flexspline
