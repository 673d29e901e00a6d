// One drop-down list for each of a figure's pickers. A choice that does not exist together with the
// others moves to the first that does.

import type { Figure, Frame } from "./document";

const starts = (frame: Frame, choice: string[]) => choice.every((value, i) => frame.choice[i] === value);

/** The frame that agrees with as many leading choices as possible, then with most of the others. */
function nearest(figure: Figure, wanted: string[]): Frame {
  let best = figure.frames[0];
  let bestScore = -1;
  for (const frame of figure.frames) {
    const score = wanted.reduce((sum, value, i) => sum + (frame.choice[i] === value ? 2 ** (wanted.length - i) : 0), 0);
    if (score > bestScore) [best, bestScore] = [frame, score];
  }
  return best;
}

function options(figure: Figure, before: string[], level: number): string[] {
  return [...new Set(figure.frames.filter((frame) => starts(frame, before)).map((frame) => frame.choice[level]))];
}

function fill(select: HTMLSelectElement, values: string[], chosen: string): void {
  select.replaceChildren(...values.map((value) => new Option(value, value, false, value === chosen)));
  select.value = chosen;
  select.disabled = values.length < 2;
}

export function addPickers(figure: Figure, controls: HTMLElement, show: (frame: Frame) => void): void {
  if (figure.frames.length < 2) return;
  const selects = figure.pickers.map((name) => {
    const label = document.createElement("label");
    const select = document.createElement("select");
    label.append(`${name} `, select);
    controls.append(label);
    return select;
  });
  const choose = (frame: Frame) => {
    selects.forEach((select, i) => fill(select, options(figure, frame.choice.slice(0, i), i), frame.choice[i]));
    show(frame);
  };
  selects.forEach((select) =>
    select.addEventListener("change", () => choose(nearest(figure, selects.map((one) => one.value)))),
  );
  selects.forEach((select, i) => fill(select, options(figure, figure.frames[0].choice.slice(0, i), i), figure.frames[0].choice[i]));
}
