// Plus and minus zoom a chart that has the focus, arrows move, zero shows all of it.

import type { Chart } from "./charts";

type Range = [start: number, end: number];

const kSteps: Record<string, [axis: number, move: number]> = {
  ArrowLeft: [0, -0.2], ArrowRight: [0, 0.2], ArrowDown: [1, -0.2], ArrowUp: [1, 0.2],
};

function zoomed([start, end]: Range, factor: number): Range {
  const half = Math.min(50, ((end - start) * factor) / 2);
  const middle = Math.min(100 - half, Math.max(half, (start + end) / 2));
  return [middle - half, middle + half];
}

function moved([start, end]: Range, share: number): Range {
  const by = Math.min(100 - end, Math.max(-start, share * (end - start)));
  return [start + by, end + by];
}

export function listenToKeys(place: HTMLElement, chart: Chart): void {
  place.addEventListener("keydown", (event) => {
    const zooms = (chart.getOption() as any).dataZoom as { start: number; end: number }[];
    if (zooms.length < 2 || event.ctrlKey || event.altKey || event.metaKey) return;
    let ranges: Range[] = zooms.map((one) => [one.start, one.end]);
    const step = kSteps[event.key];
    if (step) ranges[step[0]] = moved(ranges[step[0]], step[1]);
    else if (event.key === "+" || event.key === "=") ranges = ranges.map((one) => zoomed(one, 0.7));
    else if (event.key === "-") ranges = ranges.map((one) => zoomed(one, 1 / 0.7));
    else if (event.key === "0") ranges = ranges.map(() => [0, 100]);
    else return;
    event.preventDefault();
    ranges.forEach(([start, end], dataZoomIndex) => chart.dispatchAction({ type: "dataZoom", dataZoomIndex, start, end }));
  });
}
