#pragma once

#include <array>

#include "ode_fit/layout.hpp"

namespace flexspline::estimators {

inline constexpr std::size_t kStages = 3;

/// Radau IIA with three stages: order 5, stiffly accurate, the last stage is the element's end.
struct Radau {
  std::array<double, kStages> node;                               ///< in (0, 1]
  std::array<std::array<double, kStages>, kStages> derivative{};  ///< of the stages, at the nodes
  std::array<double, kStages> of_start{};                         ///< of the start, at the nodes
};
const Radau& radau();

/// Polynomial through an element's start and stages, at s in [0, 1]: weights of start and stages.
std::array<double, 1 + kStages> interpolation(double s);

/// Elements of one experiment; measurements lie on their ends.
struct Mesh {
  std::vector<double> ends;             ///< of elements, from the start time on: one more of these
  std::vector<std::size_t> at_measure;  ///< index in ends of each measurement

  std::size_t elements() const { return ends.size() - 1; }
  double width(std::size_t element) const { return ends[element + 1] - ends[element]; }
  double time(std::size_t element, std::size_t stage) const {
    return ends[element] + radau().node[stage] * width(element);
  }
};

/// One element from measurement to measurement.
Mesh first_mesh(const LaidOutExperiment& experiment);
/// Each element cut into so many parts.
Mesh divided(const Mesh& mesh, std::span<const std::size_t> parts);

/// States of an experiment as a function of element and stage: start (of element 0) and stages.
struct NodeStates {
  std::size_t states = 0;
  std::vector<double> start{};  ///< of the experiment
  std::vector<double> stage{};  ///< [element][stage][state]

  std::span<const double> at(std::size_t element, std::size_t s) const {
    return std::span(stage).subspan((element * kStages + s) * states, states);
  }
  std::span<const double> start_of(std::size_t element) const {
    return element == 0 ? std::span(start) : at(element - 1, kStages - 1);
  }
};

/// The same polynomials, read at the nodes of a divided mesh.
NodeStates transferred(const NodeStates& from, const Mesh& coarse, const Mesh& fine);

}  // namespace flexspline::estimators
