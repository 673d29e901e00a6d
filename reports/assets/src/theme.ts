// Okabe and Ito's colours, told apart by colour-blind readers; every role has a line style too, so
// that a grey print can be read.

import type { Series } from "./document";
import { isDark } from "./screen";

export interface Theme {
  text: string;
  muted: string;
  grid: string;
  surface: string;
  measured: string;
  truth: string;
  highlight: string;
}

const kLight: Theme = {
  text: "#1c1f23", muted: "#5b626b", grid: "#e3e6ea", surface: "#ffffff", measured: "#22262b", truth: "#6b7280", highlight: "#E8C400",
};
const kDark: Theme = {
  text: "#e8eaed", muted: "#a2a9b3", grid: "#33383f", surface: "#1b1e23", measured: "#f2f3f5", truth: "#a2a9b3", highlight: "#F0E442",
};

const kPaletteLight = ["#D55E00", "#0072B2", "#009E73", "#CC79A7", "#B98A00", "#3B93C4", "#8A6D3B"];
const kPaletteDark = ["#FF8A3D", "#56B4E9", "#2FCB9C", "#E59BC4", "#F0C419", "#7FC7EE", "#C7A56B"];
const kDashes: (string | number[])[] = ["solid", [9, 4], [2, 3], [10, 3, 2, 3], [5, 2], [1, 2], [12, 6]];
const kSymbols = ["circle", "diamond", "triangle", "rect", "emptyCircle", "roundRect", "arrow"];

/** Named, because the library measures text with it. */
export const kFont = "system-ui, 'Segoe UI', Roboto, 'Helvetica Neue', 'DejaVu Sans', sans-serif";

/** A tooltip is never wider than its chart, nor than a phone. */
export const kTooltipCss = "white-space: normal; max-width: min(100%, 340px)";

export function theme(): Theme {
  return isDark() ? kDark : kLight;
}

const cycled = <T>(list: T[], rank: number): T => list[rank % list.length];

export function colourOf(series: Series): string {
  if (series.role === "measured") return theme().measured;
  if (series.role === "truth" || series.role === "published") return theme().truth;
  if (series.role === "highlight") return theme().highlight;
  return cycled(isDark() ? kPaletteDark : kPaletteLight, series.rank);
}

export function dashOf(series: Series): string | number[] {
  if (isReference(series) || ["published", "highlight"].includes(series.role)) return "solid";
  return cycled(kDashes, series.rank + Math.floor(series.rank / kPaletteLight.length));
}

export function widthOf(series: Series): number {
  if (series.role === "highlight") return 11;
  return isReference(series) ? 5 : 1.8;
}

/** What the others are compared with lies below them, wide and soft. */
export function isReference(series: Series): boolean {
  return series.role === "measured" || series.role === "truth";
}

export function symbolOf(series: Series): string {
  return cycled(kSymbols, series.rank + Math.floor(series.rank / kPaletteLight.length));
}

/** Cividis: dark is small, bright is large; the same order in grey and for every kind of sight. */
const kCividis = ["#00224e", "#123570", "#3b496c", "#575d6d", "#707173", "#8a8678", "#a59c74", "#c3b369", "#e1cc55", "#fee838"];

export const heatColours = kCividis;

export function inkOn(share: number): string {
  return share > 0.52 ? "#111111" : "#ffffff";
}
