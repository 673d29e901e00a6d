/** From 0 to 1 over t in [0, width] with three continuous derivatives; value and first derivative. */
function softStep(t, width) {
  const u = Math.min(1, Math.max(0, t / width));
  const rest = 1 - u;
  return [u ** 4 * (35 + u * (-84 + u * (70 - 20 * u))), (140 * u ** 3 * rest ** 3) / width];
}

function softRamp(t, width) {
  const u = t / width;
  if (u <= 0) return [0, 0];
  const area = u >= 1 ? u - 0.5 : u ** 5 * (7 + u * (-14 + u * (10 - 2.5 * u)));
  return [width * area, softStep(t, width)[0]];
}

function sine(x) {
  const rate = 2 * Math.PI * x.frequency;
  return (t) => {
    const [gate, opening] = softStep(t, 0.5 / x.frequency);
    const s = Math.sin(rate * t);
    return [gate * s, opening * s + gate * rate * Math.cos(rate * t)];
  };
}

/** Out and back on either side at each of the speeds in turn. */
function legs(x, speeds) {
  const duration = x.cycles / x.frequency;
  const unit = (0.96 * duration) / speeds.reduce((sum, v) => sum + 4 / v, 0);
  const width = (0.2 * unit) / Math.max(...speeds);
  const changes = [];
  let time = 0;
  let last = 0;
  for (const v of speeds) {
    for (const sign of [1, -1, -1, 1]) {
      changes.push([time, (sign * v - last) / unit]);
      last = sign * v;
      time += unit / v;
    }
  }
  changes.push([time, -last / unit]);
  return (t) => {
    let value = 0;
    let rate = 0;
    for (const [start, by] of changes) {
      const [area, height] = softRamp(t - start, width);
      value += by * area;
      rate += by * height;
    }
    return [value, rate];
  };
}

/** The motion of a recording: t -> [rad, rad/s], from rest at 0. */
export function motionOf(x) {
  const shape = x.motion === "sine" ? sine(x) : legs(x, x.motion === "ramp" ? [1, 1] : [1, 2, 4]);
  return (t) => shape(t).map((value) => x.amplitude * value);
}
