import { between } from "./lot.mjs";

/**
 * What MuJoCo can express of the catalogue, one row an effect: on which rigs, in which coordinate
 * and equation, and from a share of peak torque what it adds. `peak` holds the largest torque,
 * motor torque, motor speed and angle of the drive without it. A row gives `parts` of the model, or
 * `torque`: Nm at the motor shaft from (motor angle, motor speed, transmitted torque, clock), or
 * `friction`: a factor of the joint's frictionloss from (transmitted torque, clock), set each step.
 */
const sign = (w, width) => w / Math.sqrt(w * w + width * width);

export const effects = {
  backlash: {
    rigs: ["free", "servo"],
    coordinate: "torsion",
    equation: "torsion",
    make: (size, { drive, peak }) => {
      const slope = drive.stiffness + 3 * drive.cubic * drive.torsion ** 2;
      const halfGap = (size * peak.torque) / slope;
      return { info: { half_gap_rad: halfGap }, parts: { halfGap } };
    },
  },
  viscoelastic_creep: {
    rigs: ["free"],
    coordinate: "lag",
    equation: "torsion",
    make: (size, { drive, peak, seed }) => {
      const stiffness = (size * peak.torque) / drive.torsion;
      const time = between(seed, "creep", 0.3, 1.2);
      return {
        info: { stiffness_Nm_rad: stiffness, time_s: time },
        parts: { branch: { stiffness, damping: stiffness * time } },
      };
    },
  },
  gravity_load: {
    rigs: ["free"],
    coordinate: "load_angle",
    equation: "load",
    make: (size, { peak }) => {
      const moment = (size * peak.torque) / Math.sin(Math.min(peak.angle, 1.5));
      return { info: { mass_moment_Nm: moment }, parts: { eccentricity: moment / 9.81 } };
    },
  },
  motor_torque_offset: {
    rigs: ["free", "servo"],
    coordinate: "constant",
    equation: "motor",
    make: (size, { peak }) => {
      const offset = size * peak.motorTorque;
      return { info: { offset_Nm: offset }, torque: () => -offset };
    },
  },
  direction_asymmetry: {
    rigs: ["free", "servo"],
    coordinate: "velocity",
    equation: "motor",
    make: (size, { peak }) => {
      const excess = size * peak.motorTorque;
      const width = 0.03 * peak.motorSpeed;
      return {
        info: { forward_excess_Nm: excess },
        torque: (angle, w) => -0.5 * excess * sign(w, width) * (1 + sign(w, width)),
      };
    },
  },
  stribeck_friction: {
    rigs: ["free", "servo"],
    coordinate: "velocity",
    equation: "motor",
    make: (size, { peak, seed }) => {
      const excess = size * peak.motorTorque;
      const speed = between(seed, "stribeck", 0.1, 0.25) * peak.motorSpeed;
      return {
        info: { static_excess_Nm: excess, stribeck_speed_rad_s: speed },
        torque: (angle, w) => -excess * sign(w, 0.1 * speed) * Math.exp(-((w / speed) ** 2)),
      };
    },
  },
  motor_torque_ripple: {
    rigs: ["free", "servo"],
    coordinate: "motor_angle",
    equation: "motor",
    make: (size, { peak, seed }) => {
      const cogging = size * peak.motorTorque;
      const phase = between(seed, "ripple", 0, 6.2);
      return {
        info: { cogging_Nm: cogging },
        torque: (angle) => -cogging * Math.sin(4 * angle + phase),
      };
    },
  },
  thermal_friction_drift: {
    rigs: ["free", "servo"],
    coordinate: "time",
    equation: "motor",
    make: (size, { drive, peak, seed }) => {
      const cold = size * peak.motorTorque;
      const time = between(seed, "warm-up", 0.25, 0.5) * peak.clock;
      return {
        info: { cold_friction_Nm: cold, time_constant_s: time },
        friction: (torque, clock) => 1 + (cold / drive.motorFriction) * Math.exp(-clock / time),
      };
    },
  },
  load_dependent_friction: {
    rigs: ["free", "servo"],
    coordinate: "load",
    equation: "motor",
    make: (size, { drive, peak }) => {
      const share = (size * peak.motorTorque) / peak.torque;
      return {
        info: { coefficient: share * drive.ratio },
        friction: (torque) => 1 + (share * Math.abs(torque)) / drive.motorFriction,
      };
    },
  },
};
