#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "flexspline/studies/conceal.hpp"

namespace flexspline::studies {

enum class ConcealKind { none, one, two, unknown, contained, variant, incident };

/// The kind at a share u in [0, 1) of the probabilities' sum.
ConcealKind kind_at(const ConcealDraw& draw, double u);

/// The sum of the probabilities.
double whole(const ConcealDraw& draw);

/// What one is drawn from where not one or two catalogued effects are hidden.
std::vector<std::string> ids_of(ConcealKind kind, data::BenchKind rig);

/// What is left of ids to draw one or two from: those that the draw lists, or else those that the
/// rig's baseline does not contain.
std::vector<std::string> drawable(std::vector<std::string> ids, const ConcealDraw& draw,
                                  data::BenchKind rig);

/// What one or two may be drawn from on a rig of the bench: catalogued, and not contained in the
/// baseline unless the draw lists it.
std::vector<std::string> drawable(const ConcealDraw& draw, data::BenchKind rig);

/// Those that can stand beside the first of a pair: neither itself nor a structural twin.
std::vector<std::string> partners(const std::vector<std::string>& ids, std::string_view first,
                                  data::BenchKind rig);

/// A size, uniform in the range.
double draw_size(const ConcealDraw& draw, std::uint64_t seed, std::uint64_t index);

/// What one bench is disturbed by: one, or nothing.
std::vector<std::string> draw_disturbances(const ConcealDraw& draw, data::BenchKind rig,
                                           std::uint64_t seed);

/// What one bench hides.
std::vector<data::HiddenEffect> draw_effects(const ConcealDraw& draw, data::BenchKind rig,
                                             std::uint64_t seed);

}  // namespace flexspline::studies
