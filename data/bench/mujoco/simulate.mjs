import { modelOf } from "./drive.mjs";
import { motionOf } from "./motion.mjs";

const kPause = 5; // s between recordings

/** PD on the motor's angle with the drive's own rigid-body torque ahead of it. */
function servoLoop(drive) {
  const inertia = drive.motorInertia + drive.loadInertia / drive.ratio ** 2;
  const rate = 2 * Math.PI * 8;
  return { stiffness: inertia * rate ** 2, damping: 1.4 * inertia * rate };
}

/** One recording: the motor follows its reference in MuJoCo's default step, Euler's integrator. */
function run(mujoco, drive, excitation, act, startsAt) {
  const model = mujoco.MjModel.from_xml_string(modelOf(drive, act.parts));
  const data = new mujoco.MjData(model);
  const step = model.opt.timestep;
  const duration = excitation.cycles / excitation.frequency;
  const every = Math.max(1, Math.round(duration / excitation.samples / step));
  const motion = motionOf(excitation);
  const loop = servoLoop(drive);
  const rows = { t: [], motor: [], load: [], torque: [], motorTorque: [] };
  const { qpos, qvel, ctrl, qfrc_applied: applied } = data;
  const friction = model.dof_frictionloss;
  const peak = { torque: 0, motorTorque: 0, motorSpeed: 0, angle: 0 };
  const dof = { motor: 0, load: 1 };
  // At rest an arm off the vertical hangs where it weighs nothing on the gear.
  const rest = -drive.offVertical;
  qpos[dof.load] = rest;
  qpos[dof.motor] = drive.ratio * rest;
  let torque = 0;
  for (let k = 0; k * step < duration; ++k) {
    const t = k * step;
    const [angle, speed] = motion(t);
    const here = { motor: qpos[dof.motor], load: qpos[dof.load], speed: qvel[dof.motor] };
    ctrl[0] = loop.stiffness * (drive.ratio * (angle + rest) - here.motor) +
      loop.damping * (drive.ratio * speed - here.speed);
    applied[dof.motor] = act.torque?.(here.motor, here.speed, torque, startsAt + t) ?? 0;
    if (act.friction) friction[dof.motor] = drive.motorFriction * act.friction(torque, startsAt + t);
    const loadSpeed = qvel[dof.load];
    mujoco.mj_step(model, data);
    torque = data.qfrc_passive[dof.load] + drive.loadDrag * loadSpeed;
    peak.torque = Math.max(peak.torque, Math.abs(torque));
    peak.motorTorque = Math.max(peak.motorTorque, Math.abs(ctrl[0]));
    peak.motorSpeed = Math.max(peak.motorSpeed, Math.abs(here.speed));
    peak.angle = Math.max(peak.angle, Math.abs(here.load));
    if (k % every !== 0) continue;
    rows.t.push(t);
    rows.motor.push(here.motor - drive.ratio * rest);
    rows.load.push(here.load - rest);
    rows.torque.push(torque);
    rows.motorTorque.push(ctrl[0]);
  }
  data.delete();
  model.delete();
  return { rows, peak };
}

/** Every recording of a design; `act` is what an effect adds. */
export function simulate(mujoco, drive, design, act) {
  const peak = { torque: 0, motorTorque: 0, motorSpeed: 0, angle: 0, clock: 0 };
  const recordings = [];
  for (const excitation of design) {
    const startsAt = peak.clock;
    const { rows, peak: own } = run(mujoco, drive, excitation, act, startsAt);
    for (const key of Object.keys(own)) peak[key] = Math.max(peak[key], own[key]);
    peak.clock += excitation.cycles / excitation.frequency + kPause;
    recordings.push({ excitation, startsAt, rows });
  }
  return { recordings, peak };
}
