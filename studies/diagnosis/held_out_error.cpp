#include "diagnosis/held_out_error.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr int kResamples = 400;
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

void resample(const Blocks& blocks, HoldoutProof& proof) {
  if (blocks.before.empty()) return;
  std::mt19937_64 engine(2003);
  std::uniform_int_distribution<std::size_t> pick(0, blocks.before.size() - 1);
  std::vector<double> ratios;
  for (int r = 0; r < kResamples; ++r) {
    double before = 0.0;
    double after = 0.0;
    for (std::size_t k = 0; k < blocks.before.size(); ++k) {
      const std::size_t i = pick(engine);
      before += blocks.before[i];
      after += blocks.after[i];
    }
    ratios.push_back(std::sqrt(after / before));
  }
  std::ranges::sort(ratios);
  proof.ci95_lower = ratios[kResamples / 40];
  proof.ci95_upper = ratios[kResamples - 1 - kResamples / 40];
}

}  // namespace

double rms_on(const ArrayXd& residual, const ArrayXd& rows) {
  const double count = rows.sum();
  return count > 0.0 ? std::sqrt((residual.square() * rows).sum() / count) : kNotComputed;
}

double noise_on(const Frame& frame, const std::vector<double>& level, const ArrayXd& rows) {
  double variance = 0.0;
  double total = 0.0;
  for (std::size_t i = 0; i < frame.segments.size(); ++i) {
    const double count = rows.segment(frame.segments[i].first, frame.segments[i].count).sum();
    variance += count * level[i] * level[i];
    total += count;
  }
  return total > 0.0 ? std::sqrt(variance / total) : kNotComputed;
}

void resample_ratio(const Frame& frame, const ArrayXd& rows, const ArrayXd& before,
                    const ArrayXd& after, HoldoutProof& proof) {
  resample(blocks_of(frame, rows, before, after), proof);
}

}  // namespace flexspline::studies
