#pragma once

#include <array>
#include <cmath>
#include <utility>

#include "flexspline/core/scalar.hpp"
#include "solvers/least_squares.hpp"

namespace flexspline::estimators::certified {

/// The residuals of a model as one block. Model: kParameters, size(), and
/// template <class S> S residual(std::size_t i, const std::array<S, kParameters>& b) const.
template <class Model>
class ModelResiduals final : public LeastSquaresProblem {
 public:
  explicit ModelResiduals(Model model) : model_(std::move(model)) {}

  std::size_t blocks() const override { return 1; }
  std::size_t residuals(std::size_t) const override { return model_.size(); }

  Result<void> evaluate(std::size_t, std::span<const double> p, std::span<double> residual,
                        std::span<double> jacobian) const override {
    constexpr std::size_t kCount = Model::kParameters;
    std::array<Dual, kCount> b;
    for (std::size_t k = 0; k < kCount; ++k) {
      b[k] = Dual(p[k], static_cast<int>(kCount), static_cast<int>(k));
    }
    for (std::size_t i = 0; i < residual.size(); ++i) {
      const Dual r = model_.residual(i, b);
      residual[i] = r.value();
      bool finite = std::isfinite(r.value());
      for (std::size_t k = 0; k < kCount && !jacobian.empty(); ++k) {
        jacobian[i * kCount + k] = r.slope(static_cast<int>(k));
        finite = finite && std::isfinite(r.slope(static_cast<int>(k)));
      }
      if (!finite) return tl::unexpected(not_a_number(p));
    }
    return {};
  }

 private:
  Model model_;
};

}  // namespace flexspline::estimators::certified
