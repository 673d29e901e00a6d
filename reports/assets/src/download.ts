// What is shown, as a file: the picture as SVG, its numbers as CSV.

import type { Panel } from "./document";

function save(name: string, type: string, text: string): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([text], { type }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

const field = (value: unknown) => {
  const text = value === null || value === undefined ? "" : String(value);
  return /[",\r\n]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text;
};

function rowsOf(panel: Panel): unknown[][] {
  const cells = (panel.cells ?? []).map(([column, row, value, note]) => [
    panel.title, note, panel.x.categories?.[column], panel.y.categories?.[row], value, "", "",
  ]);
  const points = panel.series.flatMap((series) =>
    series.y.map((y, i) => [panel.title, series.name, series.x[i], panel.y.categories?.[y ?? -1] ?? y, "", series.lower?.[i], series.upper?.[i]]),
  );
  return [...cells, ...points];
}

function csvOf(panels: Panel[], cellUnit: string): string {
  const { x, y } = panels[0];
  const head = ["panel", "series", `x: ${x.label}`, `y: ${y.label}`, cellUnit, "lower", "upper"];
  return [head, ...panels.flatMap(rowsOf)].map((row) => row.map(field).join(",")).join("\n") + "\n";
}

function button(text: string, act: () => void): HTMLButtonElement {
  const element = document.createElement("button");
  element.type = "button";
  element.textContent = text;
  element.addEventListener("click", act);
  return element;
}

export function addDownloads(id: string, cellUnit: string, controls: HTMLElement, panels: () => Panel[], sheet: () => string): void {
  const group = document.createElement("span");
  group.className = "downloads";
  const saveSvg = () => save(`${id}.svg`, "image/svg+xml", sheet());
  group.append(button("SVG", saveSvg), button("CSV", () => save(`${id}.csv`, "text/csv", csvOf(panels(), cellUnit))));
  controls.append(group);
}
