// Makes docs/images/hero.png from the built program: what a diagnosis says of a gear without any
// viscosity whose loop is that of Table I, first with that loop alone, then from rest and at other
// frequencies.
//
//   node docs/images/hero.mjs build/release
//
// Needs chromium (Debian) and the front end's packages, which the build has installed.
import { execFileSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

const build = resolve(process.argv[2] ?? "build/release");
const source = resolve(dirname(fileURLToPath(import.meta.url)), "../..");
const work = mkdtempSync(join(tmpdir(), "flexspline-hero-"));
const flexspline = (...given) => execFileSync(join(build, "bin/flexspline"), [...given, "--quiet"], { cwd: work, encoding: "utf8" });

const kRatio = 50;
/** Recordings with the output locked, as a data set of their own. */
function writeDataset(name, recordings) {
  mkdirSync(join(work, name));
  let toml = `schema = "flexspline-dataset/1"\nname = "${name}"\nrig = "locked"\nlicense = "CC0-1.0"\n[constants]\ngear_ratio = ${kRatio}\n[channels]\n` +
    't = { quantity = "time", unit = "s" }\ntheta_m = { quantity = "motor_angle", unit = "deg" }\ntau = { quantity = "transmitted_torque", unit = "Nm" }\n';
  recordings.forEach((one, i) => {
    const rows = one.time.map((t, k) => `${t - one.time[0]},${kRatio * one.motion[k]},${one.effort[k]}`);
    writeFileSync(join(work, name, `${i}.csv`), `t,theta_m,tau\n${rows.join("\n")}\n`);
    toml += `[[recording]]\nid = "${one.id}"\nfile = "${i}.csv"\nstart_s = ${2500 * i}\nexcitation = "sine"\n` +
      `amplitude_deg = ${one.amplitude}\nfrequency_hz = ${one.frequency_hz}\n`;
  });
  writeFileSync(join(work, name, "dataset.toml"), toml);
}

const table = (law) => [
  `law = "${law.law}"`, `scale = ${law.scale}`, `knots = [${law.knots}]`, `coefficients = [${law.coefficients}]`,
].join("\n");

/** Slip elements beside a spring, as the study finds them behind Table I's loop, and no viscosity. */
function writeModel(model) {
  const slip = model.effects.find((one) => one.effect === "presliding_hysteresis");
  const parameters = slip.parameters.map((one) => `  { name = "${one.name}", value = ${one.value} },`).join("\n");
  writeFileSync(join(work, "model.toml"), `schema = "flexspline-model/1"\n[f]\n${table(model.f)}\n[g_inverse]\n` +
    `law = "odd_polynomial"\nscale = 1\ncoefficients = [0]\n[[effect]]\neffect = "presliding_hysteresis"\nparameters = [\n${parameters}\n]\n`);
}

/** Normal deviates, the same ones every time. */
let state = 2003;
const uniform = () => (state = (state * 48271) % 2147483647) / 2147483647;
const normal = () => Math.sqrt(-2 * Math.log(uniform())) * Math.cos(2 * Math.PI * uniform());

/** Three cycles from rest, with the study's half percent of noise in the torque. */
function record(amplitude, frequency) {
  const id = `sine-a${amplitude}-f${frequency}`;
  flexspline("simulate", "model.toml", "--excitation", "sine", "--amplitude", `${amplitude}deg`, "--frequency", `${frequency}Hz`, "--samples", String(kPerCycle), "--out", id);
  const file = readdirSync(join(work, id)).find((one) => one.endsWith(".csv"));
  const [head, ...rows] = readFileSync(join(work, id, file), "utf8").trim().split("\n").map((row) => row.split(","));
  const column = (name) => rows.map((row) => Number(row[head.indexOf(name)]));
  const toDegrees = 180 / Math.PI;
  const toml = readFileSync(join(work, id, "dataset.toml"), "utf8");
  const motion = column("torsion").map((x) => (toml.includes('unit = "rad"') ? toDegrees * x : x));
  const effort = column("torque");
  const peak = Math.max(...effort.map(Math.abs));
  return { id, amplitude, frequency_hz: frequency, time: column("time"), motion, effort: effort.map((y) => y + 0.005 * peak * normal()) };
}

const kPerCycle = 400;
/** The steady loop alone: how it was reached, which tells memory from viscosity too, is cut off. */
const lastCycle = (one) => ({ ...one, ...Object.fromEntries(["time", "motion", "effort"].map((key) => [key, one[key].slice(-kPerCycle - 1)])) });

flexspline("run", join(source, "studies/paper.toml"), "--out", "paper");
writeModel(JSON.parse(readFileSync(join(work, "paper/cases/rate_independent--presliding_three_loops--r0.json"), "utf8")).estimate.model);
writeDataset("one-loop", [lastCycle(record(0.2, 0.005))]);
writeDataset("three-frequencies", [[0.2, 0.0025], [0.2, 0.005], [0.2, 0.01], [0.12, 0.005], [0.12, 0.01]].map(([a, f]) => record(a, f)));
for (const name of ["one-loop", "three-frequencies"]) console.log(flexspline("diagnose", name, "--out", `${name}-diagnosis`));

const { chromium } = createRequire(join(build, "reports/npm/package.json"))("playwright-core");
const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--no-sandbox"] });
async function pictureOf(name, width) {
  const page = await browser.newPage({ viewport: { width, height: 900 }, colorScheme: "light" });
  await page.goto(pathToFileURL(join(work, `${name}-diagnosis/index.html`)).href);
  await page.locator("#figure-headline svg").first().waitFor();
  await page.addStyleTag({ content: ".controls, .files { display: none !important } section { margin: 0 !important; border: 0 !important } .chart { height: 250px !important } .verdict { font-size: 0.95rem } #verdict { padding: 0 12px 6px } #verdict h2, #verdict p:not(.verdict), #verdict h3, .table, figcaption { display: none }" });
  await page.waitForTimeout(300);
  const png = await page.locator("#verdict").screenshot();
  await page.close();
  return `<img src="data:image/png;base64,${png.toString("base64")}" alt="">`;
}
const [one, several] = [await pictureOf("one-loop", 460), await pictureOf("three-frequencies", 860)];
const page = await browser.newPage({ viewport: { width: 1260, height: 900 } });
await page.setContent(`<style>body{margin:0;font:600 19px system-ui,"DejaVu Sans",sans-serif;background:#fff}
  main{display:grid;grid-template-columns:440px 1fr;gap:12px;padding:8px}h2{font-size:18px;margin:2px 12px 6px}img{width:100%}</style>
  <main><div><h2>The paper's loop alone</h2>${one}</div><div><h2>The same gear from rest, at three frequencies: held out</h2>${several}</div></main>`);
await page.locator("main").screenshot({ path: join(source, "docs/images/hero.png") });
await browser.close();
rmSync(work, { recursive: true });
