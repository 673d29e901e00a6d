#include "diagnosis/search/linearised.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace flexspline::studies {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using estimators::SeparableBlock;
using estimators::SeparableProblem;

VectorXd residual_at(const SeparableBlock& block, const VectorXd& b) {
  return estimators::residual_of(block, b(block.index));
}

/// Columns of one equation and the places of their parameters.
struct Wide {
  explicit Wide(const SeparableBlock& block)
      : columns(block.target.size(), static_cast<Index>(block.index.size())), index(block.index) {
    columns << block.shared->columns, block.columns;
  }

  void add(const VectorXd& column, Index at) {
    columns.conservativeResize(column.size(), columns.cols() + 1);
    columns.col(columns.cols() - 1) = column;
    index.push_back(at);
  }

  MatrixXd columns;
  std::vector<Index> index;
};

}  // namespace

Linearised::Linearised(const Frame& frame, const Findings& findings,
                       std::vector<Equation> equations)
    : frame_(frame), findings_(findings), equations_(std::move(equations)) {
  const DriveModel& fitted = findings.fit.model;
  ModelColumns columns(frame, findings.reference);
  const ModelProblem model(columns, frame, findings.fit_weight, equations_, fitted);
  take(model, model.coefficients_of(fitted));
  SeparableProblem alone;
  alone.lower = lower_;
  alone.assemble = [this](std::span<const double>) {
    std::vector<SeparableBlock> blocks;
    for (const Block& one : blocks_) {
      blocks.push_back({MatrixXd(one.residual.size(), 0), one.residual, one.index, one.columns});
    }
    return blocks;
  };
  chi_square_ = chi_square(estimators::solve_linear(alone, {}).residual);
}

void Linearised::take(const ModelProblem& model, const VectorXd& b) {
  estimators::SeparableFit fit;
  fit.q = estimators::starts_of(model.shapes());
  fit.b = b;
  std::vector<Wide> wide;
  for (const SeparableBlock& block : model.assemble(fit.q)) {
    const Equation equation = equations_[blocks_.size()];
    WeightedRows rows(findings_.fit_weight[index_of(equation)], prior_rows(frame_, equation));
    fit.residual.push_back(residual_at(block, b));
    blocks_.push_back({std::move(rows), nullptr, fit.residual.back(), {}});
    wide.emplace_back(block);
  }
  lower_.resize(b.size() + static_cast<Index>(fit.q.size()));
  lower_.head(b.size()) = model.lower() - b;
  for (std::size_t i = 0; i < fit.q.size(); ++i) {
    const Index at = b.size() + static_cast<Index>(i);
    lower_[at] = model.shapes()[i].lower - fit.q[i];
    const double step = estimators::difference_step(model.shapes()[i], fit.q[i]);
    if (step == 0.0) continue;
    const auto changes = model.changes(fit, i, step);
    for (std::size_t e = 0; e < changes.size(); ++e) {
      if (changes[e].squaredNorm() > 0.0) wide[e].add(changes[e] / -step, at);
    }
  }
  for (std::size_t e = 0; e < wide.size(); ++e) {
    blocks_[e].columns =
        std::make_shared<const estimators::SharedColumns>(std::move(wide[e].columns));
    blocks_[e].index = std::move(wide[e].index);
  }
}

double Linearised::chi_square(const std::vector<VectorXd>& residual) const {
  double sum = 0.0;
  for (std::size_t e = 0; e < equations_.size(); ++e) {
    sum += residual[e].squaredNorm() / findings_.noise[index_of(equations_[e])].colour;
  }
  return sum;
}

/// A cause behind the model: what it adds to every block.
class Linearised::Candidate {
 public:
  Candidate(const Linearised& base, const ActiveCause& cause)
      : base_(base),
        shapes_(shapes_of(cause, base.frame_)),
        start_(behind(base.findings_.fit.model, cause)),
        columns_(base.frame_, base.findings_.reference) {
    if (!transforms()) return;
    model_.emplace(columns_, base.frame_, base.findings_.fit_weight, base.equations_, start_);
    b_ = model_->coefficients_of(start_);
  }
  Candidate(const Candidate&) = delete;
  Candidate& operator=(const Candidate&) = delete;

  SeparableProblem problem() {
    SeparableProblem problem;
    const Index known = base_.lower_.size();
    problem.lower.resize(known + count_columns());
    problem.lower.head(known) = base_.lower_;
    problem.lower.tail(problem.lower.size() - known)
        .setConstant(cause().form->nonnegative ? 0.0 : -std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < shapes_.size(); ++i) {
      problem.shapes.push_back(bound_of(shapes_[i], cause().shape[i]));
    }
    problem.assemble = [this](std::span<const double> s) { return assemble(s); };
    return problem;
  }

  std::vector<double> shape_at(std::span<const double> s) const {
    std::vector<double> shape;
    for (std::size_t i = 0; i < s.size(); ++i) shape.push_back(outer(shapes_[i], s[i]));
    return shape;
  }

 private:
  // Of causes that only add to the prediction the others' columns are not needed.
  static DriveModel behind(DriveModel model, const ActiveCause& cause) {
    if (cause.form->transform == nullptr) {
      std::erase_if(model.causes,
                    [](const ActiveCause& c) { return c.form->transform == nullptr; });
    }
    model.causes.push_back(cause);
    return model;
  }

  const ActiveCause& cause() const { return start_.causes.back(); }
  bool transforms() const { return cause().form->transform != nullptr; }

  Index count_columns() {
    Index most = 0;
    for (Equation equation : base_.equations_) {
      most = std::max(most, std::ssize(*columns_.causes_at(start_, equation).back()));
    }
    return most;
  }

  // A change of the frame is in the residual at b0, what a cause adds in columns of its own.
  std::vector<SeparableBlock> assemble(std::span<const double> s) {
    DriveModel model = start_;
    model.causes.back().shape = shape_at(s);
    std::vector<SeparableBlock> blocks;
    for (std::size_t e = 0; e < base_.equations_.size(); ++e) {
      const Block& known = base_.blocks_[e];
      SeparableBlock block{{}, known.residual, known.index, known.columns};
      const auto added = columns_.causes_at(model, base_.equations_[e]).back();
      block.columns.resize(block.target.size(), std::ssize(*added));
      for (Index k = 0; k < block.columns.cols(); ++k) {
        block.columns.col(k) = known.rows.of((*added)[static_cast<std::size_t>(k)]);
        block.index.push_back(base_.lower_.size() + k);
      }
      blocks.push_back(std::move(block));
    }
    if (transforms()) take_residuals(s, blocks);
    return blocks;
  }

  void take_residuals(std::span<const double> s, std::vector<SeparableBlock>& blocks) const {
    auto q = estimators::starts_of(model_->shapes());
    std::ranges::copy(s, q.end() - std::ssize(s));
    const auto moved = model_->residuals(q, b_);
    for (std::size_t e = 0; e < blocks.size(); ++e) blocks[e].target = moved[e];
  }

  const Linearised& base_;
  const std::vector<Shape> shapes_;
  const DriveModel start_;
  ModelColumns columns_;
  std::optional<ModelProblem> model_;
  VectorXd b_;
};

Result<Linearised::Fit> Linearised::with(const ActiveCause& cause, int steps) const {
  Candidate candidate(*this, cause);
  const auto fit = estimators::fit_separable(candidate.problem(), steps);
  if (!fit) return tl::unexpected(fit.error());
  return Fit{candidate.shape_at(fit->q), chi_square_ - chi_square(fit->residual)};
}

}  // namespace flexspline::studies
