#pragma once

#include <string>
#include <vector>

#include "bench/hidden_law.hpp"

namespace flexspline::data {

/// An effect at its amount.
struct HiddenAmount {
  const HiddenRow* row = nullptr;
  double amount = 0.0;
};

/// A recording's place in the set.
struct HiddenSession {
  std::string id;
  double start_s = 0.0;
  HiddenExcitation excitation;

  double duration() const { return excitation.cycles / excitation.frequency_hz; }
  double interval() const { return duration() / excitation.samples; }
};

/// Ids tell motion, amplitude and rate; the order in time is drawn.
std::vector<HiddenSession> plan_sessions(const HiddenBench& bench);

/// The bench's gear at the temperature of a recording.
HiddenGear gear_of(const HiddenBench& bench, const HiddenSession& session);

/// The ideal signals of a recording with the effects.
HiddenSignals run_session(const HiddenBench& bench, const HiddenSession& session,
                          const HiddenScale& scale, const std::vector<HiddenAmount>& effects);

std::vector<HiddenSignals> run_sessions(const HiddenBench& bench,
                                        const std::vector<HiddenSession>& sessions,
                                        const HiddenScale& scale,
                                        const std::vector<HiddenAmount>& effects);

inline constexpr int kStepsPerSample = 8;

}  // namespace flexspline::data
