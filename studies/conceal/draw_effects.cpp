#include "conceal/draw_effects.hpp"

#include <algorithm>

#include "conceal/lot.hpp"

namespace flexspline::studies {
namespace {

struct KindShare {
  ConcealKind kind;
  double ConcealDraw::*share;
};

constexpr KindShare kKinds[] = {{ConcealKind::none, &ConcealDraw::none},
                                {ConcealKind::one, &ConcealDraw::one},
                                {ConcealKind::two, &ConcealDraw::two},
                                {ConcealKind::unknown, &ConcealDraw::unknown},
                                {ConcealKind::contained, &ConcealDraw::contained},
                                {ConcealKind::variant, &ConcealDraw::variant},
                                {ConcealKind::incident, &ConcealDraw::incident}};

const std::string& pick(const std::vector<std::string>& ids, std::uint64_t seed,
                        std::string_view what) {
  expects(!ids.empty(), "there is an effect to draw");
  return ids[static_cast<std::size_t>(lot(seed, what, 0) * static_cast<double>(ids.size()))];
}

}  // namespace

double whole(const ConcealDraw& draw) {
  double sum = 0.0;
  for (const KindShare& one : kKinds) sum += draw.*one.share;
  return sum;
}

ConcealKind kind_at(const ConcealDraw& draw, double u) {
  double left = u * whole(draw);
  ConcealKind last = ConcealKind::none;
  for (const KindShare& one : kKinds) {
    if (draw.*one.share <= 0.0) continue;
    if ((left -= draw.*one.share) < 0.0) return one.kind;
    last = one.kind;
  }
  return last;
}

std::vector<std::string> ids_of(ConcealKind kind, data::BenchKind rig) {
  if (kind == ConcealKind::contained) return contained_on(rig);
  if (kind == ConcealKind::variant) return concealable(rig, data::HiddenClass::variant);
  if (kind == ConcealKind::incident) return concealable(rig, data::HiddenClass::incident);
  return concealable(rig, data::HiddenClass::unknown);
}

std::vector<std::string> drawable(std::vector<std::string> ids, const ConcealDraw& draw,
                                  data::BenchKind rig) {
  const std::vector<std::string> contained = contained_on(rig);
  std::erase_if(ids, [&](const std::string& id) {
    if (draw.effects.empty()) return std::ranges::find(contained, id) != contained.end();
    return std::ranges::find(draw.effects, id) == draw.effects.end();
  });
  return ids;
}

std::vector<std::string> drawable(const ConcealDraw& draw, data::BenchKind rig) {
  return drawable(concealable(rig, data::HiddenClass::named), draw, rig);
}

std::vector<std::string> partners(const std::vector<std::string>& ids, std::string_view first,
                                  data::BenchKind rig) {
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

std::vector<std::string> draw_disturbances(const ConcealDraw& draw, data::BenchKind rig,
                                           std::uint64_t seed) {
  if (lot(seed, "disturbed", 0) >= draw.disturbed) return {};
  const std::vector<std::string> ids = disturbances_on(rig);
  return {pick(ids, seed, "disturbance")};
}

std::vector<data::HiddenEffect> draw_effects(const ConcealDraw& draw, data::BenchKind rig,
                                             std::uint64_t seed) {
  const ConcealKind kind = kind_at(draw, lot(seed, "kind", 0));
  if (kind == ConcealKind::none) return {};
  const bool catalogued = kind == ConcealKind::one || kind == ConcealKind::two;
  const auto ids = catalogued ? drawable(draw, rig) : ids_of(kind, rig);
  if (ids.empty()) return {};
  const std::string& first = pick(ids, seed, "first");
  std::vector<data::HiddenEffect> effects = {{first, draw_size(draw, seed, 0)}};
  if (kind == ConcealKind::two) {
    effects.push_back({pick(partners(ids, first, rig), seed, "second"), draw_size(draw, seed, 1)});
  }
  return effects;
}

}  // namespace flexspline::studies
