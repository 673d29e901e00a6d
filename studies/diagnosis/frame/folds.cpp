#include "diagnosis/frame/folds.hpp"

#include <algorithm>

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr std::size_t kMostOuterFolds = 3;
constexpr double kReach = 1.05;  // of what was fitted: beyond it a smooth law is extrapolated

bool marked(const Frame& frame) {
  return std::ranges::any_of(frame.segments,
                             [](const Segment& s) { return s.split == Split::holdout; });
}

/// How far rows reach in what a law depends on, and how much further than what it was fitted to it
/// may be judged.
struct Reach {
  ArrayXd of_rows;
  double most;
};

// Laws are odd and smooth, but for f of an angle that travels: it is known on neither side by the
// other, and nowhere beyond.
std::vector<Reach> reaches(const Frame& f) {
  const bool periodic = f.periodic_rate.size() > 0;
  const ArrayXd rate = periodic ? ArrayXd(f.torsion_rate - f.periodic_rate) : f.torsion_rate;
  std::vector<Reach> list = {
      {rate.abs(), kReach}, {f.motor_speed.abs(), kReach}, {f.torque.abs(), kReach}};
  if (f.travels) {
    const ArrayXd beyond_middle = f.torsion - 0.5 * (f.lowest + f.highest);
    list.push_back({beyond_middle.max(0.0), 1.0});
    list.push_back({(-beyond_middle).max(0.0), 1.0});
  } else {
    list.push_back({f.torsion.abs(), kReach});
  }
  for (Reach& reach : list) reach.of_rows *= f.usable;
  return list;
}

// What a law is fitted to has to reach as far as what it is judged on.
bool reaches_furthest(const Frame& frame, const Segment& s) {
  if (s.first == 0) return true;
  ArrayXd others = ArrayXd::Ones(frame.rows());
  others.segment(s.first, s.count).setZero();
  return std::ranges::any_of(reaches(frame), [&](const Reach& reach) {
    return reach.of_rows.segment(s.first, s.count).maxCoeff() >
           reach.most * (reach.of_rows * others).maxCoeff();
  });
}

// Segments that reach nowhere furthest, dealt out in the order of their fastest motion.
std::vector<std::vector<std::size_t>> dealt_out(const Frame& frame) {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < frame.segments.size(); ++i) {
    const Segment& s = frame.segments[i];
    if (s.split == Split::holdout || reaches_furthest(frame, s)) continue;
    const ArrayXd& speed = frame.rig == Rig::free ? frame.load_speed : frame.torsion_rate;
    order.emplace_back(speed.segment(s.first, s.count).abs().maxCoeff(), i);
  }
  std::ranges::sort(order);
  const std::size_t most = std::max<std::size_t>(1, frame.segments.size() / 3);
  std::vector<std::vector<std::size_t>> hands((order.size() + most - 1) / most);
  for (std::size_t k = 0; k < order.size(); ++k) hands[k % hands.size()].push_back(order[k].second);
  return hands;
}

// Where every recording reaches further than the others in something: the last third of each, but
// for what reaches further than the rest of the recordings.
ArrayXd ends(const Frame& frame) {
  ArrayXd rows = ArrayXd::Zero(frame.rows());
  for (const Segment& s : frame.segments) {
    const Index count = s.count / 3;
    rows.segment(s.first + s.count - count, count).setOnes();
  }
  const ArrayXd last = rows;
  for (const auto& [of_rows, most] : reaches(frame)) {
    rows *= (of_rows <= most * (of_rows * (1.0 - last)).maxCoeff()).cast<double>();
  }
  return rows;
}

std::vector<ArrayXd> masks(const Frame& frame, const std::vector<std::vector<std::size_t>>& hands) {
  std::vector<ArrayXd> list;
  for (const auto& hand : hands) {
    ArrayXd rows = ArrayXd::Zero(frame.rows());
    for (std::size_t i : hand)
      rows.segment(frame.segments[i].first, frame.segments[i].count).setOnes();
    list.push_back(std::move(rows));
  }
  return list;
}

// The smallest together, until they are as few.
std::vector<ArrayXd> at_most(std::size_t most, std::vector<ArrayXd> folds) {
  while (folds.size() > most) {
    const ArrayXd last = folds.back();
    folds.pop_back();
    const auto least =
        std::ranges::min_element(folds, {}, [](const ArrayXd& f) { return f.sum(); });
    *least = least->max(last);
  }
  return folds;
}

}  // namespace

std::vector<ArrayXd> folds_of(const Frame& frame) {
  if (marked(frame)) {
    std::vector<std::size_t> held;
    for (std::size_t i = 0; i < frame.segments.size(); ++i) {
      if (frame.segments[i].split == Split::holdout) held.push_back(i);
    }
    return masks(frame, {held});
  }
  auto folds = masks(frame, dealt_out(frame));
  if (folds.empty()) folds.push_back(ends(frame));
  return folds;
}

ArrayXd held_out(const Frame& frame) {
  ArrayXd rows = ArrayXd::Zero(frame.rows());
  for (const ArrayXd& fold : folds_of(frame)) rows = rows.max(fold);
  return rows;
}

std::vector<OuterFold> outer_folds(const Frame& frame) {
  std::vector<OuterFold> folds;
  const auto add = [&](std::vector<ArrayXd> more, bool proves) {
    for (ArrayXd& rows : at_most(kMostOuterFolds - folds.size(), std::move(more)))
      folds.push_back({std::move(rows), proves});
  };
  add(folds_of(frame), true);
  if (marked(frame)) add(masks(frame, dealt_out(frame)), false);
  return folds;
}

RecordingSet without_rows(const RecordingSet& set, const Frame& frame, const ArrayXd& fold) {
  RecordingSet rest = set;
  rest.recordings.clear();
  for (const Recording& recording : set.recordings) {
    const auto s = std::ranges::find(frame.segments, recording.id, &Segment::id);
    const ArrayXd held = fold.segment(s->first, s->count);
    Index first = 0;
    while (first < s->count && held[first] == 0.0) ++first;
    if (first == 0) continue;
    Recording kept = recording;
    if (first < s->count) {
      const double until = frame.time[s->first + first];
      const auto rows = std::ranges::lower_bound(kept.time, until) - kept.time.begin();
      kept.time.resize(static_cast<std::size_t>(rows));
      for (auto& [quantity, values] : kept.channels) values.resize(static_cast<std::size_t>(rows));
    }
    rest.recordings.push_back(std::move(kept));
  }
  return rest;
}

}  // namespace flexspline::studies
