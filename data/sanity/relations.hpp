#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "sanity/observed.hpp"

namespace flexspline::data {

/// One recording's rows of a relation: response = sum of coefficient * column, by physics.
struct RelationRows {
  const Recording* recording = nullptr;
  Eigen::ArrayXd time;
  Eigen::ArrayXd usable;
  Eigen::ArrayXd response;
  std::vector<Eigen::ArrayXd> columns;
  double rate = 0.0;  ///< rms rate over rms motion, rad/s: how fast what moves is
};

/// What a rig's channels have to do with each other at one instant. The columns from passive on
/// take energy away: their coefficients are not negative.
struct Relation {
  std::string late;  ///< the channel that would be late
  std::string than;  ///< the one it is held against
  std::size_t passive = 0;
  bool early_too = false;  ///< physics cannot look like an early response either
  std::vector<RelationRows> rows;

  double fastest() const;  ///< largest rate of its recordings
};

/// locked, free, specimen: effort = spring(torsion) + dry friction of three widths + viscous drag.
/// free: effort, servo: drive = gravity + inertia + friction of the load. None where an angle
/// travels.
std::vector<Relation> relations_of(const ObservedSet& all);

/// Least squares of a relation with offsets of each recording's own.
struct RelationFit {
  double left = 0.0;   ///< sum of squares of what it does not explain
  double total = 0.0;  ///< sum of squares of the response about its means
};

/// columns: of each recording, as rows.columns has them.
RelationFit fit_relation(const Relation& relation,
                         const std::vector<std::vector<Eigen::ArrayXd>>& columns);

}  // namespace flexspline::data
