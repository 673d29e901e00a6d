#include "bench/hidden_incident.hpp"

#include <algorithm>

namespace flexspline::data {

HiddenLaw incident_law(const HiddenScale& scale, std::string_view id, double earliest,
                       double latest, double length, const Incident& shape) {
  const auto count = scale.recordings.size();
  const double lot = scale.draw(id, 100, 0.0, static_cast<double>(count));
  const auto& target = scale.recordings[std::min(count - 1, static_cast<std::size_t>(lot))];
  const double from = scale.draw(id, 101, earliest, latest) * target.duration;
  const double to = std::min(from + length * target.duration, target.duration);
  HiddenLaw law;
  law.place = HiddenPlace{target.id, from, to, target.duration};
  law.parameters = {{"from", from, "s"}, {"to", to, "s"}};
  const auto effort = scale.effort();
  law.sensing = [=, start = target.start_s](HiddenSignals& s) {
    if (s.start_s != start) return;
    for (std::size_t k = 0; k < s.size(); ++k) {
      const double time = s.step * static_cast<double>(k);
      if (time >= from && time <= to) (s.*effort)[k] += shape((time - from) / (to - from));
    }
  };
  return law;
}

}  // namespace flexspline::data
