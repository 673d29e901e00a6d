#include "diagnosis/model/torsion_sign.hpp"

#include <algorithm>

#include "diagnosis/frame/baseline.hpp"

namespace flexspline::studies {
namespace {

using Eigen::Index;

// Nm over each width, as fitted; empty before.
Eigen::VectorXd dry_friction(const DriveModel& model, Index widths) {
  const std::size_t e = index_of(Equation::torsion);
  if (model.own.size() <= e || model.own[e].size() == 0) return {};
  return model.own[e].segment(model.own[e].size() - widths - 1, widths);
}

}  // namespace

std::vector<SignPart> torsion_sign(const Frame& frame, const DriveModel& model) {
  if (!frame.travels) return {{1.0, std::max(frame.slow_rate, 1e-3 * frame.rate_range)}};
  const auto widths = dry_widths(frame.rate_range);
  const Eigen::VectorXd dry = dry_friction(model, static_cast<Index>(widths.size()));
  if (!(dry.sum() > 0.0)) return {{1.0, 0.01 * frame.rate_range}};
  std::vector<SignPart> parts;
  for (std::size_t k = 0; k < widths.size(); ++k) {
    const double share = dry[static_cast<Index>(k)] / dry.sum();
    if (share > 0.0) parts.push_back({share, widths[k]});
  }
  return parts;
}

}  // namespace flexspline::studies
