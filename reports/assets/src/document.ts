// The figures as the report's C++ side composes them (reports/include/.../figure.hpp).

export interface Axis {
  label: string;
  log?: boolean;
  categories?: string[];
  range?: [number, number];
}

export interface Series {
  name: string;
  style: "line" | "points" | "band";
  role: "measured" | "truth" | "published" | "estimator" | "plain" | "highlight";
  rank: number;
  x: (number | null)[];
  y: (number | null)[];
  lower?: (number | null)[];
  upper?: (number | null)[];
}

export type Cell = [column: number, row: number, value: number | null, note: string];

export interface Panel {
  title: string;
  x: Axis;
  y: Axis;
  series: Series[];
  marks?: { at: number; label: string }[];
  spans?: [from: number, to: number][];
  cells?: Cell[];
}

export interface Frame {
  choice: string[];
  panels: Panel[];
}

export interface Figure {
  id: string;
  kind: "lines" | "heatmap" | "scatter";
  title: string;
  caption: string;
  alt: string;
  pickers: string[];
  frames: Frame[];
  scale?: [number, number];
  cell_unit?: string;
  derived_from?: string;
  y_label?: string;
}

/** An x that repeats the series before it is written once. */
function shareX(figure: Figure): void {
  for (const frame of figure.frames) {
    for (const panel of frame.panels) {
      panel.series.forEach((series, i) => (series.x ??= panel.series[i - 1]?.x ?? []));
    }
  }
}

function lessFirst(panel: Panel, label: string): Panel {
  const [first, ...rest] = panel.series;
  const unit = panel.y.label.split(" / ")[1] ?? "";
  const series = rest.filter((one) => one.role !== "highlight").map((one) => ({
    ...one,
    y: one.y.map((y, i) => (y === null || first.y[i] === null ? null : first.y[i]! - y)),
  }));
  const title = panel.title.replace(/ \(cut: .*$/, "");
  return { ...panel, title, y: { label: unit ? `${label} / ${unit}` : label }, series };
}

function derive(figure: Figure, all: Record<string, Figure>): void {
  const source = figure.derived_from ? all[figure.derived_from] : undefined;
  if (!source) return;
  figure.pickers = source.pickers;
  figure.frames = source.frames.map((frame) => ({
    choice: frame.choice,
    panels: frame.panels.map((panel) => lessFirst(panel, figure.y_label ?? "")),
  }));
}

/** What the page carries: JSON behind gzip and base64. A plain loop: Uint8Array.from takes 200 ms for 0.8 MB. */
export async function unpack(text: string): Promise<string> {
  const letters = atob(text);
  const bytes = new Uint8Array(letters.length);
  for (let i = 0; i < letters.length; i++) bytes[i] = letters.charCodeAt(i);
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).text();
}

export function readFigures(text: string): Record<string, Figure> {
  const all: Record<string, Figure> = JSON.parse(text);
  Object.values(all).forEach(shareX);
  Object.values(all).forEach((figure) => derive(figure, all));
  return all;
}
