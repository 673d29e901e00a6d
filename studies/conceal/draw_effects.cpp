#include "conceal/draw_effects.hpp"

#include <algorithm>

#include "conceal/lot.hpp"

namespace flexspline::studies {
namespace {

const std::string& pick(const std::vector<std::string>& ids, std::uint64_t seed,
                        std::string_view what) {
  expects(!ids.empty(), "there is an effect to draw");
  return ids[static_cast<std::size_t>(lot(seed, what, 0) * static_cast<double>(ids.size()))];
}

}  // namespace

ConcealKind kind_at(const ConcealDraw& draw, double u) {
  double left = u * (draw.none + draw.one + draw.two + draw.unknown + draw.contained);
  if ((left -= draw.none) < 0.0) return ConcealKind::none;
  if ((left -= draw.one) < 0.0) return ConcealKind::one;
  if ((left -= draw.two) < 0.0) return ConcealKind::two;
  if ((left -= draw.unknown) < 0.0) return ConcealKind::unknown;
  return draw.contained > 0.0 ? ConcealKind::contained : ConcealKind::none;
}

std::vector<std::string> drawable(const ConcealDraw& draw, Rig rig) {
  std::vector<std::string> ids = concealable(rig, true);
  const std::vector<std::string> contained = contained_on(rig);
  std::erase_if(ids, [&](const std::string& id) {
    if (draw.effects.empty()) return std::ranges::find(contained, id) != contained.end();
    return std::ranges::find(draw.effects, id) == draw.effects.end();
  });
  return ids;
}

std::vector<std::string> partners(const std::vector<std::string>& ids, std::string_view first,
                                  Rig rig) {
  const std::vector<std::string> twins = twins_of(first, rig);
  std::vector<std::string> others = ids;
  std::erase_if(others, [&](const std::string& id) {
    return id == first || std::ranges::find(twins, id) != twins.end();
  });
  return others;
}

double draw_size(const ConcealDraw& draw, std::uint64_t seed, std::uint64_t index) {
  return draw.smallest + (draw.largest - draw.smallest) * lot(seed, "size", index);
}

std::vector<data::HiddenEffect> draw_effects(const ConcealDraw& draw, Rig rig, std::uint64_t seed) {
  const ConcealKind kind = kind_at(draw, lot(seed, "kind", 0));
  if (kind == ConcealKind::none) return {};
  const auto ids = kind == ConcealKind::unknown     ? concealable(rig, false)
                   : kind == ConcealKind::contained ? contained_on(rig)
                                                    : drawable(draw, rig);
  const std::string& first = pick(ids, seed, "first");
  std::vector<data::HiddenEffect> effects = {{first, draw_size(draw, seed, 0)}};
  if (kind == ConcealKind::two) {
    effects.push_back({pick(partners(ids, first, rig), seed, "second"), draw_size(draw, seed, 1)});
  }
  return effects;
}

}  // namespace flexspline::studies
