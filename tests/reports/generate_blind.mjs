// Makes the fixtures of the diagnosis, trial and verification pages: invented numbers, nulls, and names that try
// to run in the page. Run `node generate_blind.mjs` after a change of the format.
import { createHash } from "node:crypto";
import { writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const kHostile = `</script><img src=x onerror="window.hacked=1"><b>bold</b> & 'quoted'`;
const round = (x) => (Number.isFinite(x) ? Number(x.toFixed(4)) + 0 : null);
const seal = (artefact) => ({ ...artefact, sha256: createHash("sha256").update(JSON.stringify(artefact)).digest("hex") });
const write = (path, artefact) => writeFileSync(join(here, path), JSON.stringify(seal(artefact)) + "\n");

const kPoints = 240;
/** Two cycles of a sine: a spring, drag, and a friction that remembers its last reversal. */
function seriesOf(recording, role, amplitude, frequency) {
  const columns = { time: [], motion: [], rate: [], measured: [], before: [], after: [], motor_angle: [] };
  let memory = 0;
  for (let i = 0; i < kPoints; i++) {
    const phase = (4 * Math.PI * i) / (kPoints - 1);
    const motion = amplitude * Math.sin(phase), rate = 2 * Math.PI * frequency * amplitude * Math.cos(phase);
    const step = (4 * Math.PI / (kPoints - 1)) * amplitude * Math.cos(phase);
    memory += (step - memory * Math.abs(step)) / 0.03;
    memory = Math.max(-1, Math.min(1, memory));
    const modelled = 60 * motion + 40 * rate + 0.9 * Math.tanh(40 * rate);
    const noise = 0.12 * Math.sin(97 * i * i);
    columns.time.push(i / (kPoints - 1) * 2 / frequency);
    columns.motion.push(motion);
    columns.rate.push(rate);
    columns.measured.push(modelled + 1.1 * memory + noise);
    columns.before.push(modelled + 1.1 * Math.tanh(30 * rate));
    columns.after.push(modelled + 1.08 * memory);
    columns.motor_angle.push((1440 * i) / (kPoints - 1));
  }
  return { recording, role, equation: "torsion", ...Object.fromEntries(Object.entries(columns).map(([key, values]) => [key, values.map(round)])) };
}

const kRecordings = [["sine-slow", "train", 0.12, 0.05], ["sine-fast", "train", 0.12, 0.4], ["sine-a0.20-f0.05", "holdout", 0.2, 0.05], [kHostile, "holdout", 0.06, 0.1]];
const candidate = (effect, round, misfit_removed, delta_bic, ratio, outcome) => ({ effect, round, misfit_removed, delta_bic, holdout_rmse_ratio: ratio, outcome });
write("diagnosis_fixture/diagnosis.json", {
  schema: "flexspline-diagnosis/1",
  dataset: { name: `case-017 ${kHostile}`, sha256: "0123456789abcdef".repeat(4) },
  baseline: { model: "f, g, h full trajectory", rmse_nm: { train: 0.31, holdout: 0.33 }, noise_std_nm: 0.085 },
  verdict: "partly_explained",
  says: "Presliding hysteresis was left out: after each reversal the torque lags by 0.11 deg. Something small that is ordered by the motor angle remains.",
  mismatch: [
    { recording: "sine-a0.20-f0.05", interval_s: [3.5, 7.5], coordinate: "reversal_memory", equation: "torsion", share_of_excess: 0.41, says: "after each reversal the torque lags" },
    { recording: "sine-a0.20-f0.05", interval_s: [13.5, 17.5], coordinate: "torsion", equation: "torsion", share_of_excess: 0.18, says: "near the largest torsion" },
    { recording: kHostile, interval_s: [null, null], coordinate: "motor_angle", equation: "torsion", share_of_excess: null, says: kHostile },
  ],
  causes: [
    { effect: "presliding_hysteresis", probability: 0.98, size_fraction: 0.034, size: 1.31, unit: "Nm", size_of: "the largest torque across the transmission", equation: "tau += F sum_i w_i z_i,  dz_i = dphi - z_i |dphi| / s_i",
      parameters: [{ name: "breakaway", value: 0.11, std: 0.004, ci95: [0.1022, 0.1178], unit: "deg", meaning: "way after which it slips" }, { name: "force", value: 1.08, std: null, ci95: null, unit: "Nm", meaning: "at which it slips", no_interval: "of a fixed grid, not fitted" }],
      alternatives: ["viscoelastic_creep", "backlash"], evidence: { score_p_value: 1e-12, holdout_rmse_ratio: 0.46, delta_bic: -812, ablation_ratio: 2.17, placebo_ratio: 0.99 } },
    { effect: kHostile, probability: null, size_fraction: null, equation: kHostile, size: null, unit: kHostile, size_of: kHostile, parameters: [{ name: kHostile, value: null, std: null, ci95: null, unit: kHostile, meaning: kHostile, no_interval: kHostile }],
      alternatives: [], evidence: { score_p_value: null, holdout_rmse_ratio: null, delta_bic: null } },
  ],
  confusable: [{ effect: "presliding_hysteresis", with: "viscoelastic_creep", similarity: 0.71, why: "both lag behind the motion at one frequency" }, { effect: kHostile, with: kHostile, similarity: null, why: kHostile }],
  holdout: { rmse_before_nm: 0.33, rmse_after_nm: 0.15, ratio: 0.46, ci95: [0.43, 0.49], noise_floor_nm: 0.14, over_noise: 1.07, nested: false, recordings: [] },
  next_experiment: { separates: ["presliding_hysteresis", "viscoelastic_creep"], excitation: "sine", amplitude_deg: 0.2, frequency_hz: 0.5, amplitude: 0.2, separation_sigma: 7.2,
    says: "Record a sine of 0.2 deg at 0.5 Hz: presliding does not care for the frequency, a relaxing branch does." },
  units: { motion: "deg", rate: "deg/s", effort: "Nm", rmse: "Nm" },
  tried: [
    candidate("presliding_hysteresis", 1, 0.93, -812, 0.46, "accepted"), candidate("viscoelastic_creep", 1, 0.61, -402, 0.71, "explains less than presliding hysteresis"),
    candidate("backlash", 1, 0.22, -60, 0.95, "explains less than presliding hysteresis"), candidate("stribeck_friction", 1, 0.05, 4, 1.01, "no better on hold-out"),
    candidate("gravity_load", 1, 0.01, 11, 1.0, "BIC"), candidate("kinematic_error", 2, 0.02, 6, 1.0, "no better on hold-out"), candidate(kHostile, 2, null, null, null, kHostile),
  ],
  moved: [{ name: "b1", before: 65.6, after: 22.1, std: 1.3, unit: "Nm s/deg" }, { name: "a1", before: 14.133, after: 14.02, std: 0.1, unit: "Nm/deg" }, { name: kHostile, before: null, after: null, std: null, unit: "" }],
  series: kRecordings.map((one) => seriesOf(...one)),
  model: { effects: [{ effect: "presliding_hysteresis", parameters: [0.11, 1.08] }] },
  notes: [{ code: "remark", says: "sine-fast: the first 0.3 s are marked invalid and were not used" }, { code: "check_channel", says: kHostile }],
  seconds: 12.4,
});

const rate = (count, of, lower, upper) => ({ count, of, rate: of > 0 ? round(count / of) : null, ci95: [lower, upper] });
const scores = (cases) => ({
  cases, failed: 1, null: 15, null_ok: 15, single: 30, single_top: 28, single_exact: 27, pair: 9, pair_all: 7, pair_one: 9, unknown: 6, unknown_ok: 6, unknown_unnamed: 6,
  named: 45, false_names: 2, coord: 39, coord_ok: 37, holdout_after_over_noise_median: 1.03, holdout_after_over_best_median: 1.04, gain_share_median: 0.97, seconds_median: 8.1, seconds_max: 24.6,
  rates: {
    null_ok: rate(15, 15, 0.782, 1), single_top: rate(28, 30, 0.779, 0.992), single_exact: rate(27, 30, 0.735, 0.979), pair_all: rate(7, 9, 0.4, 0.972),
    pair_one: rate(9, 9, 0.664, 1), unknown_ok: rate(6, 6, 0.541, 1), unknown_unnamed: rate(6, 6, 0.541, 1), coord_ok: rate(37, 39, 0.827, 0.994), false_name: rate(2, 60, 0.004, 0.115),
  },
});
const kEffects = ["presliding_hysteresis", "viscoelastic_creep", "backlash", "direction_asymmetry", "stribeck_friction", "load_dependent_friction", "kinematic_error",
  "motor_torque_ripple", "gravity_load", "inertia_torque", "torque_sensor_offset", "sensor_delay", "position_dependent_friction"];
const confusion = [
  { truth: "nothing", named: "adequate", count: 15 }, ...kEffects.map((effect, i) => ({ truth: effect, named: effect, count: 1 + (i % 3) })),
  { truth: "viscoelastic_creep", named: "presliding_hysteresis", count: 1 }, { truth: "two effects", named: "one of the two", count: 9 },
  { truth: "unknown:cross", named: "no name", count: 6 }, { truth: kHostile, named: "failed", count: 1 },
];
const trialCase = (key, rig, effects, size, verdict, named, right, failure = null) =>
  ({ key, rig, effects, size, trace: size.map((one) => round(0.6 * one)), verdict, named, right, after_over_noise: named.length ? 1.04 : null, seconds: 8.5, failure });
write("trial_fixture/trial.json", {
  schema: "flexspline-trial-result/1", name: "trial", title: `Blind trial ${kHostile}`, build_id: "abc123",
  design: { seed: 7, cases: 60, rigs: ["locked", "free"], none: 0.25, one: 0.5, two: 0.15, unknown: 0.1, size_fraction: [0.02, 0.1], effects: [kHostile] },
  scores: scores(60), scores_seen: scores(52), by_rig: { locked: scores(30), free: scores(30) },
  by_size: [[0.02, 0.03, 8, 7, 6, 6], [0.03, 0.04, 7, 7, 7, 6], [0.04, 0.06, 6, 6, 6, 6], [0.06, 0.08, 5, 5, 5, 5], [0.08, 0.1, 4, 4, 4, 4]].map(([from, to, cases, detected, top, exact]) => ({ from, to, cases, detected, single_top: top, single_exact: exact })),
  by_trace: [[0, 0.002, 3, 0, 0, 0], [0.004, 0.008, 4, 3, 2, 2], [0.008, 0.016, 9, 9, 9, 8], [0.016, 0.032, 14, 14, 14, 14]].map(([from, to, cases, detected, top, exact]) => ({ from, to, cases, detected, single_top: top, single_exact: exact })),
  by_effect: kEffects.map((effect, i) => ({ rig: i % 2 ? "free" : "locked", effect, cases: 2, failed: 0, single_top: 2, single_exact: i === 1 ? 1 : 2, coord: 2, coord_ok: 2, holdout_after_over_noise_median: i === 3 ? null : 1.02 })),
  confusion,
  twins: [{ rig: "locked", effect: "torque_constant_error", twin: "torque_sensor_gain", reason: "No load is known." }],
  not_concealed: [`case-0009: ${kHostile}`],
  cases: [trialCase("case-0000", "locked", [], [], "adequate", [], true), trialCase("case-0001", "free", ["backlash"], [0.05], "explained", ["backlash"], true),
    trialCase("case-0002", "locked", ["viscoelastic_creep"], [0.03], "explained", ["presliding_hysteresis"], false),
    trialCase("case-0003", "free", ["backlash", "gravity_load"], [0.05, 0.08], "failed", [], false, kHostile)],
});

const difference = (where, quantity, before, after, over_tolerance, level) => ({ where, quantity, before, after, over_tolerance, level });
const check = (artefact, level, numbers, unequal, over_tolerance, worst = [], reason = "") => ({ artefact, level, numbers, unequal, over_tolerance, reason, worst });
write("verification_fixture/verification.json", {
  schema: "flexspline-verification/1", folder: `out/${kHostile}`, level: "differs", holds: false,
  says: "Of 5 artefacts, 1 the same to the last bit, 1 the same within tolerance, 1 in statistical agreement, 1 different, 1 missing. What changed since, and may explain it: seed, library.",
  changed: [{ kind: "seed", name: "seeds", before: "[1]", after: "[2]" }, { kind: "library", name: "versions/Ceres", before: "2.1.0", after: kHostile }],
  tolerances: [{ quantity: "series", relative: 1e-6, of_std: 0, statistical: 0.05, says: "samples of a curve" }, { quantity: "parameter", relative: 1e-6, of_std: 1e-3, statistical: 1e-3, says: "estimates" }],
  artefacts: [
    check("inputs/h_one.json", "bitwise", 4000, 0, 0),
    check("cases/h_one--paper--r0.json", "numeric", 5000, 12, 0.2, [difference("estimate/cost", "error", "1.5", "1.5000001", 0.2, "numeric")]),
    check("cases/h_one--trajectory--r0.json", "statistical", 5000, 700, 90, [difference("estimate/parameters/a1/value", "parameter", "14.1", "14.2", 90, "statistical")]),
    check(`cases/${kHostile}.json`, "differs", 5000, 900, 4000, [difference(`recordings/${kHostile}/rmse`, "error", "0.1", kHostile, 4000, "differs")]),
    check("cases/gone.json", "missing", 0, 0, null, [], "only the other run has it, not the folder to verify"),
  ],
});
