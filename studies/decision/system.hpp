#pragma once

#include "decision/discrepancy.hpp"
#include "decision/drive.hpp"
#include "decision/noise_model.hpp"

namespace flexspline::studies::decision {

/// One equation of a set of recordings, with the noise that whitens it.
struct EquationRows {
  Equation equation = Equation::torsion;
  Rows rows;
  NoiseModel noise;
  Discrepancy discrepancy;  ///< all rows of the frame
  Eigen::MatrixXd white;    ///< its columns, whitened
  Eigen::MatrixXd inner;    ///< white' white
  double unit = 1.0;        ///< a hundredth of the largest torque
  double memory = 1.0;      ///< rows beyond which correlation is no noise's: a quarter of a cycle
};

/// What the decision is made from.
struct Bench {
  const Frame* frame = nullptr;
  Eigen::ArrayXd usable;  ///< of the frame, less what is masked
  std::vector<EquationRows> equations;
  unsigned threads = 1;

  double contrasts() const;
};

/// The equations of a frame with white noise about running parabolas.
Bench bench_of(const Frame& frame, unsigned threads);

/// Takes a noise model, and whitens the discrepancy's columns with it.
void set_noise(EquationRows& one, NoiseModel noise);

/// Leaves rows out that are not usable any more; the noise is white again.
void mask(Bench& bench, Eigen::Index first, Eigen::Index count);

/// One equation about a state: whitened rows, the baseline's columns as an orthonormal basis.
struct EquationSystem {
  Eigen::MatrixXd q;  ///< rows x baseline's columns
  Eigen::MatrixXd r;  ///< triangular, of the scaled columns
  Eigen::VectorXd scale;
  Eigen::MatrixXd z, w;    ///< whitened: components, columns of causes
  Eigen::MatrixXd qz, qw;  ///< q'z, q'w
  Eigen::VectorXd y, qy;   ///< what the baseline as it stands leaves
  Eigen::MatrixXd raw_z;   ///< not whitened, rows that count: nuisance columns alone
};

/// All equations about a state: the baseline and its tangents projected out.
struct System {
  Frame seen;
  Reference known;
  std::vector<EquationSystem> equations;
  std::vector<Gram> grams;
  std::vector<std::vector<Component>> components;
  FixedEffects columns;             ///< of the state's causes
  std::vector<Eigen::Index> first;  ///< column at which each cause's begin
  std::vector<Eigen::Index> count;
};
System system_at(const Bench& bench, const DriveState& state);

/// Columns of a cause over the rows that count, not whitened: its own, or the change of the
/// residual by its shapes. one: by equation of the bench.
using ByEquation = std::vector<Eigen::MatrixXd>;
ByEquation columns_of(const Bench& bench, const System& system, const DriveState& state,
                      const Taken& cause);

/// What the residual of a state becomes less by, with a cause's shapes in place of the state's own
/// (or none, where it has none): one column.
ByEquation change_by(const Bench& bench, const DriveState& state, const Taken& cause);

/// Inner products of more columns of causes, for append().
Gram with_columns(const Bench& bench, const System& system, std::size_t equation,
                  const Eigen::MatrixXd& columns);

/// Whether it is searched by steps from its start, rather than on a grid.
inline bool steps(const CauseForm& form) {
  return form.transform != nullptr && form.start != nullptr;
}

}  // namespace flexspline::studies::decision
