#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "flexspline/core/recording.hpp"

namespace flexspline::studies {

using Draw = std::mt19937_64;

inline double drawn_between(Draw& draw, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(draw);
}

inline Recording& drawn_recording(RecordingSet& set, Draw& draw) {
  return set
      .recordings[std::uniform_int_distribution<std::size_t>(0, set.recordings.size() - 1)(draw)];
}

/// A mistake of a bench or a file that recordings can show.
struct Damage {
  std::string name;
  std::vector<Rig> rigs;  ///< on which it can be told at all
  void (*apply)(RecordingSet&, Draw&);
};

inline void scale(RecordingSet& set, std::initializer_list<Quantity> quantities, double factor) {
  for (Recording& recording : set.recordings) {
    for (const Quantity quantity : quantities) {
      const auto found = recording.channels.find(quantity);
      if (found == recording.channels.end()) continue;
      for (double& value : found->second) value *= factor;
    }
  }
}

inline void scale_time(RecordingSet& set, double factor) {
  for (Recording& recording : set.recordings) {
    for (double& t : recording.time) t *= factor;
  }
}

inline void swap_channels(RecordingSet& set, Quantity a, Quantity b) {
  for (Recording& recording : set.recordings) {
    std::swap(recording.channels.at(a), recording.channels.at(b));
  }
}

inline Quantity effort_of(const RecordingSet& set) {
  return set.rig == Rig::servo ? Quantity::motor_torque : Quantity::transmitted_torque;
}

inline Quantity motion_of(const RecordingSet& set) {
  if (set.rig == Rig::specimen) return Quantity::torsion;
  return set.rig == Rig::servo ? Quantity::load_angle : Quantity::motor_angle;
}

/// A stretch of an effort, an eighth to a third of the recording, at one value.
inline void hold(RecordingSet& set, Draw& draw, Quantity quantity, bool at_zero) {
  Recording& recording = drawn_recording(set, draw);
  auto& values = recording.channels.at(quantity);
  const auto size = static_cast<double>(values.size());
  const auto first = static_cast<std::size_t>(size * drawn_between(draw, 0.1, 0.6));
  const auto count = static_cast<std::size_t>(size * drawn_between(draw, 0.125, 0.33));
  std::fill_n(values.begin() + static_cast<std::ptrdiff_t>(first), count,
              at_zero ? 0.0 : values[first]);
}

inline double value_at(const std::vector<double>& time, const std::vector<double>& values,
                       double instant) {
  const auto next = std::ranges::upper_bound(time, instant);
  if (next == time.begin()) return values.front();
  if (next == time.end()) return values.back();
  const auto k = static_cast<std::size_t>(next - time.begin());
  const double share = (instant - time[k - 1]) / (time[k] - time[k - 1]);
  return values[k - 1] + share * (values[k] - values[k - 1]);
}

/// The rate of the fastest sine of a set, rad/s.
inline double fastest_sine(const RecordingSet& set) {
  double most = 0.0;
  for (const Recording& recording : set.recordings) {
    if (recording.excitation == "sine") most = std::max(most, *recording.frequency_hz);
  }
  return 2.0 * std::numbers::pi * most;
}

/// The effort as a sensor gives it that is delayed.
inline void delay_effort(RecordingSet& set, double by) {
  for (Recording& r : set.recordings) {
    auto& values = r.channels.at(effort_of(set));
    const std::vector<double> before = values;
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = value_at(r.time, before, r.time[i] - by);
    }
  }
}

/// The effort behind a low pass of first order.
inline void filter_effort(RecordingSet& set, double time_constant) {
  for (Recording& r : set.recordings) {
    auto& values = r.channels.at(effort_of(set));
    for (std::size_t i = 1; i < values.size(); ++i) {
      const double share = 1.0 - std::exp((r.time[i - 1] - r.time[i]) / time_constant);
      values[i] = values[i - 1] + share * (values[i] - values[i - 1]);
    }
  }
}

/// The effort by a clock that is faster by a share; the recording ends where it does.
inline void let_effort_drift(RecordingSet& set, double share) {
  for (Recording& r : set.recordings) {
    auto& values = r.channels.at(effort_of(set));
    const std::vector<double> before = values;
    const double start = r.time.front();
    const auto instant = [&](std::size_t i) { return start + (1.0 + share) * (r.time[i] - start); };
    std::size_t kept = 0;
    while (kept < values.size() && instant(kept) <= r.time.back()) ++kept;
    for (std::size_t i = 0; i < kept; ++i) values[i] = value_at(r.time, before, instant(i));
    r.time.resize(kept);
    for (auto& [quantity, list] : r.channels) list.resize(kept);
  }
}

inline const std::vector<Damage>& damages() {
  using enum Quantity;
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  static const std::vector<Rig> any = {Rig::locked, Rig::free, Rig::specimen, Rig::servo};
  static const std::vector<Rig> sensed = {Rig::locked, Rig::free, Rig::specimen};
  static const std::vector<Rig> drives = {Rig::locked, Rig::free};
  static const std::vector<Damage> list = {
      {"ms taken for s", any, [](RecordingSet& s, Draw&) { scale_time(s, 1e3); }},
      {"s taken for ms", any, [](RecordingSet& s, Draw&) { scale_time(s, 1e-3); }},
      {"degrees taken for radians", any,
       [](RecordingSet& s, Draw&) {
         scale(s, {motor_angle, load_angle, torsion}, kDegrees);
       }},
      {"radians taken for degrees", any,
       [](RecordingSet& s, Draw&) {
         scale(s, {motor_angle, load_angle, torsion}, 1 / kDegrees);
       }},
      {"the output's angle taken for the motor's", drives,
       [](RecordingSet& s, Draw&) { scale(s, {motor_angle}, 1 / s.constants.at("gear_ratio")); }},
      {"a torque of the motor's side taken for the output's", drives,
       [](RecordingSet& s, Draw&) {
         scale(s, {transmitted_torque}, 1 / s.constants.at("gear_ratio"));
       }},
      {"mNm taken for Nm", drives,
       [](RecordingSet& s, Draw&) { scale(s, {transmitted_torque}, 1e3); }},
      {"motor torque in mNm", drives,
       [](RecordingSet& s, Draw&) { scale(s, {motor_torque}, 1e3); }},
      {"ratio halved", drives, [](RecordingSet& s, Draw&) { s.constants["gear_ratio"] /= 2; }},
      {"ratio doubled", drives, [](RecordingSet& s, Draw&) { s.constants["gear_ratio"] *= 2; }},
      {"ratio inverted", drives,
       [](RecordingSet& s, Draw&) { s.constants["gear_ratio"] = 1 / s.constants["gear_ratio"]; }},
      {"sign of the torque", sensed,
       [](RecordingSet& s, Draw&) { scale(s, {transmitted_torque}, -1); }},
      {"sign of the drive",
       {Rig::locked, Rig::free, Rig::servo},
       [](RecordingSet& s, Draw&) { scale(s, {motor_torque}, -1); }},
      {"sign of the motor's angle", drives,
       [](RecordingSet& s, Draw&) { scale(s, {motor_angle}, -1); }},
      {"torque and motion exchanged", any,
       [](RecordingSet& s, Draw&) { swap_channels(s, motion_of(s), effort_of(s)); }},
      {"both angles exchanged",
       {Rig::free},
       [](RecordingSet& s, Draw&) { swap_channels(s, motor_angle, load_angle); }},
      {"both torques exchanged", drives,
       [](RecordingSet& s, Draw&) { swap_channels(s, motor_torque, transmitted_torque); }},
      {"a dead torque", any,
       [](RecordingSet& s, Draw& draw) {
         auto& values = drawn_recording(s, draw).channels.at(effort_of(s));
         std::ranges::fill(values, drawn_between(draw, 0.0, 1.0) < 0.5 ? 0.0 : values.front());
       }},
      {"a frozen torque", any,
       [](RecordingSet& s, Draw& draw) { hold(s, draw, effort_of(s), false); }},
      {"a torque of zero for a while", any,
       [](RecordingSet& s, Draw& draw) { hold(s, draw, effort_of(s), true); }},
      {"a frozen angle", any,
       [](RecordingSet& s, Draw& draw) { hold(s, draw, motion_of(s), false); }},
      {"a torque cut off", any,
       [](RecordingSet& s, Draw& draw) {
         const double share = drawn_between(draw, 0.5, 0.9);
         for (Recording& recording : s.recordings) {
           auto& values = recording.channels.at(effort_of(s));
           const auto [low, high] = std::ranges::minmax(values);
           for (double& value : values) value = std::clamp(value, share * low, share * high);
         }
       }},
      {"a torque of few steps", any,
       [](RecordingSet& s, Draw& draw) {
         for (Recording& recording : s.recordings) {
           auto& values = recording.channels.at(effort_of(s));
           const auto [low, high] = std::ranges::minmax(values);
           const double step = (high - low) / drawn_between(draw, 6.0, 18.0);
           for (double& value : values) value = step * std::round(value / step);
         }
       }},
      {"a late torque", any,
       [](RecordingSet& s, Draw& draw) {
         delay_effort(s, drawn_between(draw, 0.3, 1.0) / fastest_sine(s));
       }},
      {"a filtered torque", any,
       [](RecordingSet& s, Draw& draw) {
         filter_effort(s, drawn_between(draw, 0.3, 1.0) / fastest_sine(s));
       }},
      {"a torque by a clock that drifts", any,
       [](RecordingSet& s, Draw& draw) {
         const double side = drawn_between(draw, 0.0, 1.0) < 0.5 ? -1.0 : 1.0;
         let_effort_drift(s, side * drawn_between(draw, 0.015, 0.06));
       }},
      {"a recording by a clock that is behind", any,
       [](RecordingSet& s, Draw& draw) {
         Recording& late = drawn_recording(s, draw);
         Recording& other = s.recordings[&late == &s.recordings[0] ? 1 : 0];
         late.start_s = other.start_s + drawn_between(draw, 0.1, 0.8) * other.time.back();
       }},
      {"a sine that is none", any,
       [](RecordingSet& s, Draw&) {
         for (Recording& recording : s.recordings) recording.excitation = "sine";
       }},
      {"one recording twice", any,
       [](RecordingSet& s, Draw& draw) {
         Recording& copy = drawn_recording(s, draw);
         Recording& from = s.recordings[&copy == &s.recordings[0] ? 1 : 0];
         copy.time = from.time, copy.channels = from.channels;
       }},
      {"another spring",
       {Rig::locked, Rig::specimen},
       [](RecordingSet& s, Draw& draw) {
         const double factor = drawn_between(draw, 2.0, 4.0);
         const double which = drawn_between(draw, 0.0, 1.0) < 0.5 ? factor : 1.0 / factor;
         for (double& value : drawn_recording(s, draw).channels.at(transmitted_torque)) {
           value *= which;
         }
       }},
      {"a gap in time", any,
       [](RecordingSet& s, Draw& draw) {
         auto& time = drawn_recording(s, draw).time;
         const double hole = drawn_between(draw, 0.1, 0.5) * (time.back() - time.front());
         for (std::size_t i = time.size() / 2; i < time.size(); ++i) time[i] += hole;
       }},
      {"rows logged twice", any,
       [](RecordingSet& s, Draw&) {
         for (Recording& recording : s.recordings) {
           for (auto& [quantity, values] : recording.channels) {
             for (std::size_t i = 1; i < values.size(); i += 2) values[i] = values[i - 1];
           }
         }
       }},
      {"too few samples", any,
       [](RecordingSet& s, Draw&) {
         for (Recording& r : s.recordings) {
           if (r.excitation != "sine") continue;
           const double span = r.time.back() - r.time.front();
           const auto keep = static_cast<std::size_t>(
               std::max(1.0, static_cast<double>(r.time.size()) / (span * *r.frequency_hz) / 12));
           const auto thin = [keep](std::vector<double>& values) {
             std::size_t n = 0;
             for (std::size_t i = 0; i < values.size(); i += keep) values[n++] = values[i];
             values.resize(n);
           };
           thin(r.time);
           for (auto& [quantity, values] : r.channels) thin(values);
         }
       }},
      {"amplitudes of another bench", any,
       [](RecordingSet& s, Draw& draw) {
         const double factor = drawn_between(draw, 1.7, 5.0);
         for (Recording& recording : s.recordings)
           recording.amplitude = *recording.amplitude / factor;
       }},
  };
  return list;
}

}  // namespace flexspline::studies
