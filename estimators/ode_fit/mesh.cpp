#include "ode_fit/mesh.hpp"

#include <algorithm>
#include <cmath>

namespace flexspline::estimators {
namespace {

using Nodes = std::array<double, 1 + kStages>;  // 0 and the stages

Nodes all_nodes() {
  const double root = std::sqrt(6.0);
  return {0.0, (4.0 - root) / 10.0, (4.0 + root) / 10.0, 1.0};
}

// Derivative at node a of the Lagrange polynomial that is 1 at node b.
double lagrange_slope(const Nodes& x, std::size_t a, std::size_t b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (k == b) continue;
    double product = 1.0 / (x[b] - x[k]);
    for (std::size_t j = 0; j < x.size(); ++j) {
      if (j != b && j != k) product *= (x[a] - x[j]) / (x[b] - x[j]);
    }
    sum += product;
  }
  return sum;
}

Radau make_radau() {
  const Nodes x = all_nodes();
  Radau r{{x[1], x[2], x[3]}, {}, {}};
  for (std::size_t j = 0; j < kStages; ++j) {
    r.of_start[j] = lagrange_slope(x, j + 1, 0);
    for (std::size_t k = 0; k < kStages; ++k) {
      r.derivative[j][k] = lagrange_slope(x, j + 1, k + 1);
    }
  }
  return r;
}

}  // namespace

const Radau& radau() {
  static const Radau made = make_radau();
  return made;
}

std::array<double, 1 + kStages> interpolation(double s) {
  const Nodes x = all_nodes();
  std::array<double, 1 + kStages> weight{};
  for (std::size_t b = 0; b < x.size(); ++b) {
    weight[b] = 1.0;
    for (std::size_t j = 0; j < x.size(); ++j) {
      if (j != b) weight[b] *= (s - x[j]) / (x[b] - x[j]);
    }
  }
  return weight;
}

Mesh first_mesh(const LaidOutExperiment& experiment) {
  Mesh mesh{{experiment.start_time()}, {}};
  for (const double t : experiment.source.times) {
    if (t > mesh.ends.back()) mesh.ends.push_back(t);
    mesh.at_measure.push_back(mesh.ends.size() - 1);
  }
  return mesh;
}

Mesh divided(const Mesh& mesh, std::span<const std::size_t> parts) {
  Mesh fine{{mesh.ends.front()}, {}};
  std::vector<std::size_t> moved = {0};
  for (std::size_t e = 0; e < mesh.elements(); ++e) {
    for (std::size_t k = 1; k < parts[e]; ++k) {
      fine.ends.push_back(mesh.ends[e] +
                          mesh.width(e) * static_cast<double>(k) / static_cast<double>(parts[e]));
    }
    fine.ends.push_back(mesh.ends[e + 1]);
    moved.push_back(fine.ends.size() - 1);
  }
  for (const std::size_t end : mesh.at_measure) fine.at_measure.push_back(moved[end]);
  return fine;
}

NodeStates transferred(const NodeStates& from, const Mesh& coarse, const Mesh& fine) {
  NodeStates to{from.states, from.start, {}};
  std::size_t parent = 0;
  for (std::size_t e = 0; e < fine.elements(); ++e) {
    while (fine.ends[e] >= coarse.ends[parent + 1]) ++parent;
    for (std::size_t s = 0; s < kStages; ++s) {
      const auto weight =
          interpolation((fine.time(e, s) - coarse.ends[parent]) / coarse.width(parent));
      for (std::size_t i = 0; i < from.states; ++i) {
        double value = weight[0] * from.start_of(parent)[i];
        for (std::size_t k = 0; k < kStages; ++k) {
          value += weight[k + 1] * from.at(parent, k)[i];
        }
        to.stage.push_back(value);
      }
    }
  }
  return to;
}

}  // namespace flexspline::estimators
