#include "torsion/layout.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace flexspline::estimators {

TorsionLayout::TorsionLayout(LawSpec f, std::size_t f_size, LawSpec g_inverse, std::size_t g_size,
                             double h_scale, std::vector<std::string> records, FreeTerms free)
    : f_(std::move(f)),
      g_inverse_(std::move(g_inverse)),
      h_{.law = "bounded_modulation", .scale = h_scale, .knots = {}, .coefficients = {}},
      records_(std::move(records)),
      free_(free) {
  auto place = [this](Group& group, std::size_t count) {
    group = {.first = size_, .count = count};
    size_ += count;
  };
  place(f_group, f_size);
  place(g_group, g_size);
  place(h_group, free.h);
  place(inertia_group, free.inertia ? 1 : 0);
  place(delay_group, free.delay ? 1 : 0);
  place(offset_group, free.offset ? 1 : 0);
  place(zero_group, free.zeros ? records_.size() : 0);
  place(initial_group, free.initial ? records_.size() : 0);
}

namespace {

LawSpec with(LawSpec spec, std::span<const double> coefficients) {
  spec.coefficients.assign(coefficients.begin(), coefficients.end());
  return spec;
}

}  // namespace

LawSpec TorsionLayout::f(std::span<const double> p) const { return with(f_, f_group.of(p)); }

LawSpec TorsionLayout::g_inverse(std::span<const double> p) const {
  return with(g_inverse_, g_group.of(p));
}

LawSpec TorsionLayout::h(std::span<const double> p) const { return with(h_, h_group.of(p)); }

ModelSpec TorsionLayout::model(std::span<const double> p) const {
  ModelSpec model{.f = f(p), .g_inverse = g_inverse(p), .h = h(p), .effects = {}};
  if (free_.inertia) {
    model.effects.push_back({"inertia_torque", {{"inertia", inertia(p)}}});
  }
  if (free_.delay) model.effects.push_back({"sensor_delay", {{"delay", delay(p)}}});
  if (free_.offset) model.effects.push_back({"torque_sensor_offset", {{"offset", offset(p)}}});
  return model;
}

std::vector<double> TorsionLayout::carry_over(const TorsionLayout& from,
                                              std::span<const double> p) const {
  std::vector<double> result(size_, 0.0);
  using Member = Group TorsionLayout::*;
  for (Member member :
       {&TorsionLayout::f_group, &TorsionLayout::g_group, &TorsionLayout::h_group,
        &TorsionLayout::inertia_group, &TorsionLayout::delay_group, &TorsionLayout::offset_group,
        &TorsionLayout::zero_group, &TorsionLayout::initial_group}) {
    const auto source = (from.*member).of(p);
    const auto target = (this->*member).of(std::span<double>(result));
    std::ranges::copy(source.first(std::min(source.size(), target.size())), target.begin());
  }
  return result;
}

std::string TorsionLayout::coefficient_name(std::string_view law, const LawSpec& spec,
                                            std::size_t k, std::size_t size) const {
  const bool two_sided = spec.law == "monotone_spline" && size == 2 * (spec.knots.size() + 3);
  if (!two_sided) return fmt::format("{}[{}]", law, k + 1);
  const std::size_t half = size / 2;
  return fmt::format("{}{}[{}]", law, k < half ? "+" : "-", k % half + 1);
}

std::string TorsionLayout::name(std::size_t k) const {
  auto within = [k](const Group& group) {
    return group.present() && k >= group.first && k < group.first + group.count;
  };
  if (within(f_group)) return coefficient_name("f", f_, k, f_group.count);
  if (within(g_group)) {
    return coefficient_name("g_inverse", g_inverse_, k - g_group.first, g_group.count);
  }
  if (within(h_group)) return fmt::format("ln_h[{}]", k - h_group.first + 1);
  if (within(inertia_group)) return "inertia";
  if (within(delay_group)) return "delay";
  if (within(offset_group)) return "offset";
  if (within(zero_group)) return fmt::format("zero[{}]", records_[k - zero_group.first]);
  return fmt::format("initial[{}]", records_[k - initial_group.first]);
}

std::string TorsionLayout::unit(std::size_t k, bool angular) const {
  const std::string_view effort = angular ? "Nm" : "N";
  const std::string_view motion = angular ? "rad" : "m";
  const std::string name_of = name(k);
  if (name_of.starts_with("ln_h")) return "1";
  if (name_of == "inertia") return angular ? "kg m2" : "kg";
  if (name_of == "delay") return "s";
  if (name_of.starts_with("zero") || name_of.starts_with("initial")) return std::string(motion);
  return std::string(effort);
}

}  // namespace flexspline::estimators
