import { between, share } from "./lot.mjs";

const kGravity = 9.81;

/** A geared joint drawn from a seed, SI. Friction is soft in half of the drives: the engine's own. */
export function drawDrive(rig, seed) {
  const about = (what, nominal) => nominal * between(seed, what, 0.8, 1.2);
  const torque = between(seed, "torque", 25, 60);
  const torsion = between(seed, "torsion", 2.5e-3, 6e-3);
  const hardening = between(seed, "hardening", 0.1, 0.5);
  const drive = {
    rig,
    ratio: 50,
    torque,
    torsion,
    cubic: (hardening * torque) / torsion ** 3 / (1 + hardening),
    stiffness: torque / torsion / (1 + hardening),
    damping: about("damping", (0.004 * torque) / torsion / 10),
    motorInertia: about("J1", 7.26e-4),
    motorDrag: about("B1", 6e-4),
    motorFriction: about("Tc", 0.05),
    loadDrag: between(seed, "B2", 0.4, 1.2),
    softFriction: share(seed, "soft friction") < 0.5,
    offVertical: rig === "servo" ? between(seed, "off vertical", -0.1, 0.1) : 0,
  };
  if (rig === "servo") {
    drive.arm = between(seed, "arm", 0.25, 0.5);
    drive.mass = torque / (kGravity * drive.arm);
    drive.loadInertia = drive.mass * drive.arm ** 2;
  } else {
    drive.loadInertia = between(seed, "J2", 2.2, 3.6);
  }
  return drive;
}

/** Recordings that ask the drive for its torque. */
export function drawDesign(drive, seed) {
  const design = [];
  const add = (motion, amplitude, frequency, cycles) =>
    design.push({ motion, amplitude, frequency, cycles, samples: 900 });
  if (drive.rig === "servo") {
    const wide = between(seed, "amplitude", 1.1, 1.4);
    for (const part of [0.4, 1]) {
      for (const rate of [0.08, 0.3]) {
        add("sine", part * wide, rate * between(seed, "rate", 0.8, 1.2, design.length), 3);
      }
    }
    add("ramp", wide, 0.08, 2);
    add("staircase", wide, 0.03, 1);
    return design;
  }
  const wide = between(seed, "amplitude", 0.7, 1);
  const rateFor = (amplitude, part) =>
    Math.sqrt((part * drive.torque) / (drive.loadInertia * amplitude)) / (2 * Math.PI);
  for (const part of [0.03, 0.2, 0.5]) add("sine", wide, rateFor(wide, part), 2.5);
  for (const part of [0.3, 1]) add("sine", wide / 2, rateFor(wide / 2, part), 3);
  add("sine", wide / 4, rateFor(wide / 4, 0.8), 3);
  add("staircase", wide, 0.12 * rateFor(wide, 0.2), 1);
  return design;
}

/**
 * The drive in MJCF. The gear is a tendon of length th1/N - th2 with stiffness a + c x^2 and damping;
 * see MuJoCo's XML reference, tendon/fixed and joint/frictionloss. `parts` are what effects add.
 */
export function modelOf(drive, parts) {
  const friction = drive.softFriction
    ? ""
    : 'solreffriction="0.001 1" solimpfriction="0.995 0.995 0.001 0.5 2"';
  const servo = drive.rig === "servo";
  const angle = drive.offVertical;
  const round = drive.loadInertia - (parts.eccentricity ?? 0) ** 2; // about its own centre, 1 kg
  const weight = servo
    ? `<geom type="sphere" size="0.01" mass="${drive.mass}"
         pos="${-drive.arm * Math.sin(angle)} 0 ${-drive.arm * Math.cos(angle)}"/>`
    : `<inertial pos="0 0 ${-(parts.eccentricity ?? 0)}" mass="1"
         diaginertia="${round} ${round} ${round}"/>`;
  const gap = parts.halfGap ? `springlength="${-parts.halfGap} ${parts.halfGap}"` : "springlength=\"0\"";
  const branch = parts.branch
    ? `<body name="branch"><joint name="branch" axis="0 1 0" damping="${parts.branch.damping}"
         armature="1e-3"/><inertial pos="0 0 0" mass="1e-3" diaginertia="1e-6 1e-6 1e-6"/></body>`
    : "";
  const branchTendon = parts.branch
    ? `<fixed name="branch" springlength="0" stiffness="${parts.branch.stiffness}">
         <joint joint="motor" coef="${1 / drive.ratio}"/><joint joint="load" coef="-1"/>
         <joint joint="branch" coef="-1"/></fixed>`
    : "";
  return `<mujoco>
  <compiler angle="radian" autolimits="true"/>
  <option gravity="0 0 ${servo || parts.eccentricity ? -kGravity : 0}" integrator="Euler">
    <flag contact="disable"/>
  </option>
  <worldbody>
    <body name="motor"><joint name="motor" axis="0 1 0" armature="${drive.motorInertia}"
        damping="${drive.motorDrag}" frictionloss="${drive.motorFriction}" ${friction}/>
      <inertial pos="0 0 0" mass="1e-3" diaginertia="1e-9 1e-9 1e-9"/></body>
    <body name="load"><joint name="load" axis="0 1 0" damping="${drive.loadDrag}"/>${weight}</body>
    ${branch}
  </worldbody>
  <tendon>
    <fixed name="gear" ${gap} stiffness="${drive.stiffness} 0 ${drive.cubic}" damping="${drive.damping}">
      <joint joint="motor" coef="${1 / drive.ratio}"/><joint joint="load" coef="-1"/></fixed>
    ${branchTendon}
  </tendon>
  <actuator><motor name="motor" joint="motor"/></actuator>
</mujoco>`;
}
