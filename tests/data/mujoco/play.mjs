// Plays a motor torque in MuJoCo: node play.mjs PACKAGE MODEL.xml INPUT.json > OUTPUT.json
// INPUT: { interval, torque: [...] }; OUTPUT: { motor: [...], load: [...] } at the same instants.
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [, , packageFolder, modelFile, inputFile] = process.argv;
const { default: load } = await import(pathToFileURL(`${packageFolder}/mujoco.js`));
const mujoco = await load();
const model = mujoco.MjModel.from_xml_string(readFileSync(modelFile, "utf8"));
const data = new mujoco.MjData(model);
const { interval, torque } = JSON.parse(readFileSync(inputFile, "utf8"));
const step = model.opt.timestep;
const joints = ["motor", "load"].filter((name) => readFileSync(modelFile, "utf8").includes(`joint name="${name}"`));
const played = { motor: [], load: [] };
const { qpos, ctrl } = data;
const steps = Math.round(interval / step);
for (let k = 0; k < torque.length; ++k) {
  joints.forEach((name, i) => played[name].push(qpos[i]));
  if (k + 1 === torque.length) break;
  for (let s = 0; s < steps; ++s) {
    // The torque of the middle of a step.
    ctrl[0] = torque[k] + ((torque[k + 1] - torque[k]) * (s + 0.5)) / steps;
    mujoco.mj_step(model, data);
  }
}
console.log(JSON.stringify(played));
