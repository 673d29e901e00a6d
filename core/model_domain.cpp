#include "flexspline/core/model_domain.hpp"

#include <cmath>

namespace flexspline {

Result<ModelDomain> ModelDomain::of(const ModelSpec& model) {
  Result<std::unique_ptr<Law>> h = make_law(model.h);
  if (!h) return tl::unexpected(h.error());
  ModelDomain domain;
  domain.f_to_ = model.f.valid_to;
  domain.g_to_ = model.g_inverse.valid_to;
  domain.h_ = std::move(*h);
  return domain;
}

double ModelDomain::share_of_f(double phi) const {
  return f_to_ > 0.0 ? std::abs(phi) / f_to_ : 0.0;
}

double ModelDomain::share_of_g_inverse(double phi, double rate) const {
  return g_to_ > 0.0 ? std::abs(rate / h_->value(phi)) / g_to_ : 0.0;
}

bool ModelDomain::holds_at(double phi, double rate) const {
  constexpr double kSlack = 1.02;
  return share_of_f(phi) <= kSlack && share_of_g_inverse(phi, rate) <= kSlack;
}

}  // namespace flexspline
