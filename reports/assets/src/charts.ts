// The only file that names the plotting library.

import { connect, init, use } from "echarts/core";
import type { EChartsType } from "echarts/core";
import { CustomChart, HeatmapChart, LineChart, ScatterChart } from "echarts/charts";
import {
  DataZoomInsideComponent,
  GridComponent,
  LegendComponent,
  LegendScrollComponent,
  MarkAreaComponent,
  MarkLineComponent,
  TooltipComponent,
  VisualMapContinuousComponent,
} from "echarts/components";
import { SVGRenderer } from "echarts/renderers";

import type { Figure, Panel } from "./document";
import { heatmapOption } from "./heatmap";
import { linesOption } from "./lines";

use([
  CustomChart, HeatmapChart, LineChart, ScatterChart, DataZoomInsideComponent, GridComponent, LegendComponent,
  LegendScrollComponent, MarkAreaComponent, MarkLineComponent, TooltipComponent, VisualMapContinuousComponent, SVGRenderer,
]);

export type Chart = EChartsType;

export function drawChart(element: HTMLElement, panel: Panel, figure: Figure): Chart {
  const chart = init(element, undefined, { renderer: "svg" });
  chart.setOption(figure.kind === "heatmap" ? heatmapOption(panel, figure) : linesOption(panel));
  chart.group = figure.id;
  return chart;
}

/** Hiding a series in one panel hides it in the others. */
export function linkCharts(id: string): void {
  connect(id);
}
