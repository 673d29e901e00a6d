#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "diagnosis/search/explanation.hpp"
#include "diagnosis/words/spelled.hpp"

namespace flexspline::studies {
namespace {

constexpr std::size_t kMostMismatches = 6;

Mismatch at_worst(const Frame& frame, const Findings& findings, Equation equation) {
  const WorstWindow w = worst_window(frame, findings, equation);
  return {.recording = frame.segments[w.segment].id,
          .from_s = w.from_s,
          .to_s = w.to_s,
          .coordinate = {},
          .equation = std::string(name_of(equation)),
          .says = {}};
}

bool listed(const std::vector<Mismatch>& list, std::string_view coordinate) {
  return std::ranges::any_of(list, [&](const Mismatch& m) { return m.coordinate == coordinate; });
}

// What a cause too small for a name takes away, where it is largest: the baseline's residual has
// it no more.
Mismatch mismatch_of(const Frame& frame, const Selection& s, const Accepted& small) {
  const auto at = static_cast<std::size_t>(&small - s.immaterial.data());
  const Equation equation = first_equation(frame, *small.trial.cause.form);
  Findings without = s.baseline;
  if (auto fit = reduced(frame, s.baseline, at, kRefreshSteps)) without.fit = std::move(*fit);
  Mismatch m = at_worst(frame, without, equation);
  m.coordinate = small.trial.cause.row->coordinate;
  m.share_of_excess = std::clamp(small.trial.removed, 0.0, 1.0);
  m.says = fmt::format("the {} equation misses {:.2g} % of torque, organised by {}",
                       name_of(equation), 100.0 * small.trial.size, m.coordinate);
  return m;
}

// What a cause of the model takes away, named or not; its message still lacks the cause.
Mismatch explained(const Frame& frame, const Selection& s, const Accepted& a) {
  const Equation equation = first_equation(frame, *a.trial.cause.form);
  Mismatch m = at_worst(frame, s.baseline, equation);
  m.coordinate = a.trial.cause.row->coordinate;
  m.share_of_excess = std::clamp(a.trial.removed, 0.0, 1.0);
  m.says = fmt::format("the {} equation misses ", name_of(equation));
  return m;
}

// What a form without a name was found to be: nothing else tells it. In words, where a motion may
// be an angle or a length, what is measured in neither.
std::string with_its_shapes(const Frame& frame, const ActiveCause& cause) {
  std::vector<std::string> said;
  const auto shapes = cause.form->shapes ? cause.form->shapes(frame) : std::vector<Shape>{};
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const auto& [name, unit] = std::pair(shapes[i].name, shapes[i].unit);
    if (unit.find("rad") != std::string_view::npos) continue;
    said.push_back(fmt::format("{} {:.3g}{}{}", name, cause.shape[i], unit == "1" ? "" : " ",
                               unit == "1" ? "" : unit));
  }
  if (said.empty()) return std::string(cause.row->outside);
  return fmt::format("{} ({})", cause.row->outside, fmt::join(said, ", "));
}

Mismatch incident_in(const Frame& frame, const Incident& one) {
  const Segment& s = frame.segments[one.segment];
  return {.recording = s.id,
          .from_s = frame.time[one.first],
          .to_s = frame.time[one.first + one.count - 1],
          .coordinate = "window",
          .equation = std::string(name_of(one.equation)),
          .says = fmt::format("{} alone has something in the {} equation from {:.4g} to {:.4g} s "
                              "(rms {:.2g} % of torque): left out, look at the recording",
                              s.id, name_of(one.equation), frame.time[one.first],
                              frame.time[one.first + one.count - 1], 100.0 * one.size)};
}

}  // namespace

std::vector<Mismatch> spelled_mismatch(const Frame& frame, const Selection& s, const Limits& limits,
                                       const std::optional<Resonance>& resonance) {
  std::vector<Mismatch> list;
  for (const Incident& one : frame.incidents) list.push_back(incident_in(frame, one));
  for (const Accepted& a : s.accepted) {
    if (listed(list, a.trial.cause.row->coordinate)) continue;
    list.push_back(explained(frame, s, a));
    list.back().says += fmt::format("{}: {}", a.trial.cause.row->id, a.trial.cause.form->equation);
  }
  const DriveModel& model = s.final.fit.model;
  for (std::size_t i = 0; i < s.unnamed.size(); ++i) {
    const Accepted& a = s.unnamed[i];
    if (listed(list, a.trial.cause.row->coordinate)) continue;
    list.push_back(explained(frame, s, a));
    const CauseRow& row = *a.trial.cause.row;
    list.back().says +=
        !row.in_catalogue()
            ? fmt::format(
                  "what is outside the catalogue: {}",
                  with_its_shapes(frame, model.causes[model.causes.size() - s.unnamed.size() + i]))
        : a.material ? fmt::format("what has the form of {}, a name of probability {:.2g}", row.id,
                                   a.probability)
                     : fmt::format("what has the form of {}, too small to be named", row.id);
  }
  if (resonance) {
    list.push_back(at_worst(frame, s.final, resonance->equation));
    list.back().coordinate = "lag";
    list.back().says = in_words(*resonance);
  }
  if (const Accepted* small = left_unnamed(s, limits)) {
    list.push_back(mismatch_of(frame, s, *small));
  }
  for (const CoordinateScore& score : s.accepted.empty() ? s.after : s.before) {
    // Where something is left, the strongest coordinate is told even if it orders little of it.
    const bool told = score.statistic >= limits.gain || (list.empty() && s.remainder);
    if (list.size() >= kMostMismatches || !told) break;
    if (listed(list, score.coordinate)) continue;
    Mismatch m = at_worst(frame, s.baseline, score.equation);
    m.coordinate = score.coordinate;
    m.share_of_excess = score.share;
    m.says = score.says;
    list.push_back(std::move(m));
  }
  return list;
}

}  // namespace flexspline::studies
