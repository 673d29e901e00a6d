#pragma once

#include "bench/hidden_run.hpp"

namespace flexspline::data {

/// A recording with the rig's channels at its sample instants, as the signals are.
Recording ideal_recording(const HiddenBench& bench, const HiddenSession& session,
                          const HiddenSignals& signals);

/// The same with noise, quantisation and zero error. Nm: rms of the two torques' noise.
Recording noisy_recording(const HiddenBench& bench, Recording ideal, double torque_noise,
                          double motor_torque_noise);

}  // namespace flexspline::data
