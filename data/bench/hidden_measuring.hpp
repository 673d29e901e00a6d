#pragma once

#include "bench/hidden_run.hpp"

namespace flexspline::data {

/// Every signal behind the same first-order low pass, exact for signals that run straight within a
/// step; its time constant is so many sampling intervals. 0: as they are.
HiddenSignals filtered(HiddenSignals signals, double samples);

/// A recording with the rig's channels at its sample instants, as the signals are.
Recording ideal_recording(const HiddenBench& bench, const HiddenSession& session,
                          const HiddenSignals& signals);

/// The same with noise, quantisation and zero error. Nm: rms of the two torques' noise.
Recording noisy_recording(const HiddenBench& bench, Recording ideal, double torque_noise,
                          double motor_torque_noise);

}  // namespace flexspline::data
