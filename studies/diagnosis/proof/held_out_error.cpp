#include "diagnosis/proof/held_out_error.hpp"

#include <cmath>
#include <numeric>

#include <boost/math/distributions/students_t.hpp>

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr Index kBlocksOfRecording = 8;

/// Sums of squares of both models by block of the held-out recordings.
struct Blocks {
  std::vector<double> before;
  std::vector<double> after;
};

Blocks blocks_of(const Frame& frame, const ArrayXd& rows, const ArrayXd& before,
                 const ArrayXd& after) {
  Blocks blocks;
  for (const Segment& s : frame.segments) {
    const Index width = s.count / kBlocksOfRecording;
    for (Index b = 0; width > 0 && b < kBlocksOfRecording; ++b) {
      const auto part = Eigen::seqN(s.first + b * width, width);
      if (rows(part).sum() == 0.0) continue;
      blocks.before.push_back((before(part).square() * rows(part)).sum());
      blocks.after.push_back((after(part).square() * rows(part)).sum());
    }
  }
  return blocks;
}

double logarithm_of_ratio(double before, double after) { return 0.5 * std::log(after / before); }

// Of the logarithm, which no interval takes below 0.
void jackknife(const Blocks& blocks, HoldoutProof& proof) {
  const std::size_t count = blocks.before.size();
  if (count < 2) return;
  const double before = std::reduce(blocks.before.begin(), blocks.before.end());
  const double after = std::reduce(blocks.after.begin(), blocks.after.end());
  ArrayXd without(static_cast<Index>(count));
  for (std::size_t k = 0; k < count; ++k) {
    without[static_cast<Index>(k)] =
        logarithm_of_ratio(before - blocks.before[k], after - blocks.after[k]);
  }
  const double freedoms = static_cast<double>(count) - 1.0;
  const double deviation =
      std::sqrt(freedoms / (freedoms + 1.0) * (without - without.mean()).square().sum());
  const double half = boost::math::quantile(boost::math::students_t(freedoms), 0.975) * deviation;
  const double ratio = logarithm_of_ratio(before, after);
  proof.ci95_lower = std::exp(ratio - half);
  proof.ci95_upper = std::exp(ratio + half);
}

}  // namespace

double rms_on(const ArrayXd& residual, const ArrayXd& rows) {
  const double count = rows.sum();
  return count > 0.0 ? std::sqrt((residual.square() * rows).sum() / count) : kNotComputed;
}

double noise_of(const Frame& frame, const EquationNoise& noise, const ArrayXd& residual,
                const ArrayXd& rows) {
  const double level = rms_on(deviation_of(frame, {.level = noise.level}), rows);
  if (noise.of_motion.size() == 0) return level;
  return level * rms_on(residual, rows) / rms_on(as_noise_alone(frame, noise, residual), rows);
}

void take_interval(const Frame& frame, const ArrayXd& rows, const ArrayXd& before,
                   const ArrayXd& after, HoldoutProof& proof) {
  jackknife(blocks_of(frame, rows, before, after), proof);
}

}  // namespace flexspline::studies
