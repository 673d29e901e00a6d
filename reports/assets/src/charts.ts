// The only file that names the plotting library.

import { init, use } from "echarts/core";
import type { EChartsType } from "echarts/core";
import { CustomChart, HeatmapChart, LineChart, ScatterChart } from "echarts/charts";
import {
  DataZoomInsideComponent,
  GridComponent,
  LegendComponent,
  MarkAreaComponent,
  MarkLineComponent,
  TooltipComponent,
  VisualMapContinuousComponent,
} from "echarts/components";
import { SVGRenderer } from "echarts/renderers";

import type { Figure, Panel } from "./document";
import { heatmapOption, wideExtent } from "./heatmap";
import { linesOption } from "./lines";
import { selectionOf } from "./selection";

use([
  CustomChart, HeatmapChart, LineChart, ScatterChart, DataZoomInsideComponent, GridComponent, LegendComponent,
  MarkAreaComponent, MarkLineComponent, TooltipComponent, VisualMapContinuousComponent, SVGRenderer,
]);

export type Chart = EChartsType;

const optionOf = (panel: Panel, figure: Figure, width: number) =>
  figure.kind === "heatmap" ? heatmapOption(panel, figure) : linesOption(panel, width);

export function drawChart(element: HTMLElement, panel: Panel, figure: Figure): Chart {
  const chart = init(element, undefined, { renderer: "svg" });
  chart.setOption(optionOf(panel, figure, element.clientWidth));
  return chart;
}

/** The same picture as text, where there is no page to draw it on. */
export function chartText(panel: Panel, figure: Figure, width: number, height: number): string {
  const chart = init(null, undefined, { renderer: "svg", ssr: true, width, height });
  chart.setOption(optionOf(panel, figure, width));
  const text = chart.renderToSVGString();
  chart.dispose();
  return text;
}

/** Height that a panel's rows need, and the least width of long names; none: any will do. */
export function extentOf(panel: Panel, figure: Figure): { width?: number; height?: number } {
  const wide = figure.kind === "heatmap" ? wideExtent(panel) : undefined;
  if (wide) return wide;
  const rows = panel.y.categories?.length ?? 0;
  return rows > 0 ? { height: 110 + rows * (figure.kind === "heatmap" ? 38 : 26) } : {};
}

/** Hides what is hidden on the page, and shows the rest. */
export function applySelection(chart: Chart, panel: Panel): void {
  for (const [name, shown] of Object.entries(selectionOf(panel))) {
    chart.dispatchAction({ type: shown ? "legendSelect" : "legendUnSelect", name });
  }
}
