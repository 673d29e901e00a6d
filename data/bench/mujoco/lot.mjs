import { createHash } from "node:crypto";

/** In [0, 1): a pure function of (seed, what, index). */
export function share(seed, what, index = 0) {
  const hex = createHash("sha256").update(`${seed}/${what}/${index}`).digest("hex");
  return Number.parseInt(hex.slice(0, 13), 16) / 2 ** 52;
}

export function between(seed, what, low, high, index = 0) {
  return low + (high - low) * share(seed, what, index);
}

/** Normal numbers by a generator of 32 bits (Mulberry32) and Box and Muller. */
export function normals(seed, what) {
  let state = Math.floor(share(seed, what) * 2 ** 32) >>> 0;
  const uniform = () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
  return () => Math.sqrt(-2 * Math.log(1 - uniform())) * Math.cos(2 * Math.PI * uniform());
}
