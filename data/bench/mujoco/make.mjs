// A geared joint in the MuJoCo engine, with or without an effect, as a data set and its answer:
//   node make.mjs '{"rig":"free","seed":1,"effects":[{"id":"backlash","size_fraction":0.05}]}' DIR
// writes DIR/dataset and DIR/answer.json (docs/trials.md). `node make.mjs --effects RIG` lists what
// a rig can show, one id a line.
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";

import { drawDesign, drawDrive } from "./drive.mjs";
import { effects } from "./effects.mjs";
import { between, normals } from "./lot.mjs";
import { simulate } from "./simulate.mjs";

const kTurn = 2 * Math.PI;

function combined(acts) {
  const having = (key) => acts.filter((act) => act[key]);
  const act = { parts: Object.assign({}, ...acts.map((one) => one.parts ?? {})) };
  if (having("torque").length > 0) {
    act.torque = (...at) => having("torque").reduce((sum, one) => sum + one.torque(...at), 0);
  }
  if (having("friction").length > 0) {
    act.friction = (...at) => having("friction").reduce((sum, one) => sum + one.friction(...at) - 1, 1);
  }
  return act;
}

/** Noise and encoders upon the engine's signals; in place. Gives the rms of the noise added. */
function measure(recordings, peak, seed) {
  const level = between(seed, "noise", 0.003, 0.006);
  const rms = { torque: level * peak.torque, motorTorque: level * peak.motorTorque };
  for (const [index, { rows }] of recordings.entries()) {
    for (const channel of ["torque", "motorTorque"]) {
      const normal = normals(seed, `${channel}-${index}`);
      rows[channel] = rows[channel].map((value) => value + rms[channel] * normal());
    }
    for (const [channel, step] of [["motor", kTurn / 1e5], ["load", kTurn / 2 ** 22]]) {
      rows[channel] = rows[channel].map((value) => Math.round(value / step) * step);
    }
  }
  return rms;
}

function tableOf(rows, columns) {
  const lines = [columns.map(([name]) => name).join(",")];
  for (let k = 0; k < rows.t.length; ++k) {
    lines.push(columns.map(([, key]) => String(rows[key][k])).join(","));
  }
  return `${lines.join("\n")}\n`;
}

const kColumns = {
  free: [["t", "t"], ["theta_m", "motor"], ["theta_l", "load"], ["tau", "torque"],
    ["tau_m", "motorTorque"]],
  servo: [["t", "t"], ["theta_l", "load"], ["tau_m", "motorTorque"]],
};

const kChannels = {
  t: ["time", "s"],
  theta_m: ["motor_angle", "rad"],
  theta_l: ["load_angle", "rad"],
  tau: ["transmitted_torque", "Nm"],
  tau_m: ["motor_torque", "Nm"],
};

function constantsOf(drive) {
  const constants = { gear_ratio: drive.ratio, motor_inertia_kgm2: drive.motorInertia };
  if (drive.rig === "free") return { ...constants, load_inertia_kgm2: drive.loadInertia };
  return { ...constants, load_mass_kg: drive.mass, arm_length_m: drive.arm };
}

function describe(drive, recordings) {
  const lines = ['schema = "flexspline-dataset/1"', 'name = "case"', `rig = "${drive.rig}"`,
    'license = "CC0-1.0"', 'source = "simulated"', "", "[constants]"];
  for (const [key, value] of Object.entries(constantsOf(drive))) lines.push(`${key} = ${value}`);
  lines.push("", "[channels]");
  for (const [name] of kColumns[drive.rig]) {
    const [quantity, unit] = kChannels[name];
    lines.push(`${name} = { quantity = "${quantity}", unit = "${unit}" }`);
  }
  for (const { id, startsAt, excitation } of recordings) {
    lines.push("", "[[recording]]", `id = "${id}"`, `file = "${id}.csv"`,
      `start_s = ${startsAt.toFixed(6)}`, `excitation = "${excitation.motion}"`,
      `amplitude_deg = ${(excitation.amplitude * 360) / kTurn}`,
      `frequency_hz = ${excitation.frequency}`);
  }
  return `${lines.join("\n")}\n`;
}

function answerOf(spec, drive, hidden, peak, rms) {
  const servo = drive.rig === "servo";
  const names = spec.effects.map((one) => one.id);
  const disturbances = {};
  if (drive.softFriction) disturbances.soft_friction = {};
  if (drive.offVertical !== 0) disturbances.off_vertical = { angle_rad: drive.offVertical };
  return {
    rig: drive.rig,
    effects: names,
    size: spec.effects.map((one) => one.size_fraction),
    coordinate: names.map((id) => effects[id].coordinate),
    info: Object.fromEntries(names.map((id, k) => [id, hidden[k].info])),
    noise_std_nm: servo ? rms.motorTorque : rms.torque,
    twins: [],
    tau_max: servo ? peak.motorTorque : peak.torque,
    equation: names.map((id) => (servo ? "drive" : effects[id].equation)),
    names: names.map(() => []),
    place: names.map(() => null),
    disturbances,
    best_rmse_nm: servo ? rms.motorTorque : rms.torque,
    at_output: servo ? drive.ratio : 1,
    seed: spec.seed,
  };
}

async function make(spec, folder) {
  const { default: load } = await import("@mujoco/mujoco");
  const mujoco = await load();
  const drive = drawDrive(spec.rig, spec.seed);
  const design = drawDesign(drive, spec.seed);
  const { peak } = simulate(mujoco, drive, design, { parts: {} });
  const hidden = spec.effects.map(({ id, size_fraction: size }) =>
    effects[id].make(size, { drive, peak, seed: spec.seed }));
  const { recordings } = simulate(mujoco, drive, design, combined(hidden));
  recordings.forEach((one, k) => {
    one.id = `${one.excitation.motion}-${k + 1}`;
  });
  const rms = measure(recordings, peak, spec.seed);
  mkdirSync(join(folder, "dataset"), { recursive: true });
  for (const { id, rows } of recordings) {
    writeFileSync(join(folder, "dataset", `${id}.csv`), tableOf(rows, kColumns[drive.rig]));
  }
  writeFileSync(join(folder, "dataset", "dataset.toml"), describe(drive, recordings));
  const answer = answerOf(spec, drive, hidden, peak, rms);
  writeFileSync(join(folder, "answer.json"), `${JSON.stringify(answer, null, 2)}\n`);
}

const [first, second] = process.argv.slice(2);
if (first === "--effects") {
  const shown = Object.entries(effects).filter(([, row]) => row.rigs.includes(second));
  process.stdout.write(shown.map(([id]) => `${id}\n`).join(""));
} else if (first && second) {
  await make(JSON.parse(first), second);
} else {
  process.stderr.write("usage: node make.mjs SPEC DIR, or node make.mjs --effects RIG\n");
  process.exit(64);
}
