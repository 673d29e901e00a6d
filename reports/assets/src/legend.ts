// The legend below a figure: one button a series, for mouse and keyboard alike.

import type { Panel, Series } from "./document";
import { isHidden, toggle } from "./selection";
import { colourOf, dashOf, isReference, symbolOf } from "./theme";

const kShapes: Record<string, string> = {
  circle: "M14 1a5 5 0 1 0 .01 0z",
  emptyCircle: "M14 1a5 5 0 1 0 .01 0zm0 2a3 3 0 1 1-.01 0z",
  diamond: "M14 0l6 6-6 6-6-6z",
  triangle: "M14 1l6 10h-12z",
  rect: "M9 1h10v10h-10z",
  roundRect: "M11 1h6a2 2 0 0 1 2 2v6a2 2 0 0 1-2 2h-6a2 2 0 0 1-2-2v-6a2 2 0 0 1 2-2z",
  arrow: "M14 0l6 12-6-4-6 4z",
};

function lineOf(series: Series): string {
  const dash = dashOf(series);
  const width = isReference(series) || series.role === "highlight" ? 5 : 2;
  const opacity = width > 2 ? 0.5 : 1;
  const dashes = Array.isArray(dash) ? ` stroke-dasharray="${dash.join(" ")}"` : "";
  return `<path d="M0 6h28" fill="none" stroke="${colourOf(series)}" stroke-width="${width}" opacity="${opacity}"${dashes}/>`;
}

const symbolPath = (series: Series) => `<path d="${kShapes[symbolOf(series)]}" fill="${colourOf(series)}" fill-rule="evenodd"/>`;

function swatchOf(series: Series): string {
  const few = series.style === "points" || series.x.length <= 12;
  const drawn = (series.style === "points" ? "" : lineOf(series)) + (few ? symbolPath(series) : "");
  return `<svg width="28" height="12" viewBox="0 0 28 12" aria-hidden="true">${drawn}</svg>`;
}

function entryOf(series: Series, changed: () => void): HTMLButtonElement {
  const button = document.createElement("button");
  button.type = "button";
  button.innerHTML = swatchOf(series);
  button.append(series.name);
  button.setAttribute("aria-pressed", String(!isHidden(series.name)));
  button.addEventListener("click", () => {
    toggle(series.name);
    changed();
  });
  return button;
}

/** Every name of the panels once. */
export function fillLegend(place: HTMLElement, panels: Panel[], changed: () => void): void {
  const first = new Map<string, Series>();
  for (const series of panels.flatMap((panel) => panel.series)) {
    if (series.style !== "band" && !first.has(series.name)) first.set(series.name, series);
  }
  place.replaceChildren(...[...first.values()].map((series) => entryOf(series, changed)));
}

/** After a change anywhere: the same buttons, so that the keyboard's focus stays. */
export function refreshLegend(place: HTMLElement): void {
  for (const button of place.querySelectorAll("button")) {
    button.setAttribute("aria-pressed", String(!isHidden(button.textContent ?? "")));
  }
}
