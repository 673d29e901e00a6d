// Lines, points and bands over a number axis, or points over categories.

import type { Axis, Panel, Series } from "./document";
import { escapeHtml, shown, tick } from "./numbers";
import { colourOf, dashOf, symbolOf, theme, widthOf } from "./theme";

type Option = Record<string, any>;

const pairs = (series: Series) => series.y.map((y, i) => [series.x[i] ?? null, y]);

/** A band is one polygon; it belongs to its estimator's legend entry. */
function bandSeries(series: Series): Option {
  const lower = series.lower ?? [];
  const upper = series.upper ?? [];
  return {
    type: "custom",
    name: series.name.replace(/, 95 %$/, ""),
    silent: true,
    clip: true,
    z: 1,
    color: colourOf(series),
    data: [[series.x[0], series.y[0]]],
    tooltip: { show: false },
    renderItem: (_: unknown, api: any) => {
      const there = series.x.map((x, i) => api.coord([x, upper[i]]));
      const back = series.x.map((x, i) => api.coord([x, lower[i]])).reverse();
      const points = [...there, ...back].filter((p) => p.every(Number.isFinite));
      return { type: "polygon", shape: { points }, style: { fill: colourOf(series), opacity: 0.18 } };
    },
  };
}

function pointSeries(series: Series): Option {
  return {
    type: "scatter",
    name: series.name,
    data: pairs(series),
    symbol: symbolOf(series),
    symbolSize: series.x.length > 60 ? 4 : 11,
    itemStyle: { color: colourOf(series), opacity: 0.9 },
    z: 3,
  };
}

function lineSeries(series: Series): Option {
  const few = series.x.length <= 12;
  return {
    type: "line",
    name: series.name,
    data: pairs(series),
    showSymbol: few,
    symbol: symbolOf(series),
    symbolSize: 8,
    lineStyle: { color: colourOf(series), width: widthOf(series), type: dashOf(series), opacity: series.role === "measured" ? 0.55 : 1 },
    itemStyle: { color: colourOf(series) },
    emphasis: { disabled: true },
    animation: false,
    z: series.role === "measured" ? 2 : 3,
  };
}

function seriesOption(series: Series): Option {
  if (series.style === "band") return bandSeries(series);
  return series.style === "points" ? pointSeries(series) : lineSeries(series);
}

/** Where something on the x axis ends, each label one line below the one before. */
function markOption(panel: Panel): Option {
  const labelled = new Set<string>();
  return {
    silent: true,
    symbol: "none",
    lineStyle: { color: theme().muted, type: [4, 4], width: 1 },
    data: (panel.marks ?? []).map((mark) => {
      const again = labelled.has(mark.label);
      labelled.add(mark.label);
      return { xAxis: mark.at, label: { show: !again && mark.at > 0, formatter: shown(mark.at, 3), color: theme().muted, fontSize: 11, position: "end" } };
    }),
  };
}

function axisOption(axis: Axis, other: Option): Option {
  const colours = theme();
  const common = {
    name: axis.label,
    nameLocation: "middle",
    nameTextStyle: { color: colours.text, fontSize: 12 },
    axisLine: { show: true, onZero: false, lineStyle: { color: colours.muted } },
    axisTick: { show: true, lineStyle: { color: colours.muted } },
    splitLine: { show: true, lineStyle: { color: colours.grid } },
    ...other,
  };
  if (axis.categories) {
    const label = { color: colours.text, fontSize: 11, width: 96, overflow: "truncate", interval: 0 };
    return { ...common, type: "category", data: axis.categories, axisLabel: label };
  }
  return {
    ...common,
    type: axis.log ? "log" : "value",
    scale: true,
    min: axis.range?.[0],
    max: axis.range?.[1],
    axisLabel: { color: colours.muted, fontSize: 11, formatter: tick, hideOverlap: true },
  };
}

function tooltipText(panel: Panel, items: any[]): string {
  if (!items.length) return "";
  const x = panel.x.categories ? items[0].name : `${shown(items[0].value[0])}`;
  const seen = new Set<string>();
  const lines = items.filter((item) => !seen.has(item.seriesName) && seen.add(item.seriesName));
  const values = lines.map((item) => {
    const at = panel.y.categories ? `${escapeHtml(panel.y.categories[item.value[1]] ?? "")}: ${shown(item.value[0], 3)}` : shown(item.value[1]);
    return `<tr><td>${item.marker}${escapeHtml(item.seriesName)}</td><td style="text-align:right;padding-left:12px">${at}</td></tr>`;
  });
  const [name, unit] = panel.x.label.split(" / ");
  const head = panel.y.categories ? escapeHtml(panel.x.label) : `${escapeHtml(name)} ${x} ${escapeHtml(unit ?? "")}`;
  return `<b>${head}</b><br>${escapeHtml(panel.y.categories ? "" : panel.y.label)}<table>${values.join("")}</table>`;
}

export function linesOption(panel: Panel): Option {
  const colours = theme();
  const overCategories = Boolean(panel.y.categories);
  const series = panel.series.map(seriesOption);
  const carrier = series.find((one) => one.type !== "custom");
  if (carrier && panel.marks?.length) carrier.markLine = markOption(panel);
  const names = [...new Set(panel.series.filter((one) => one.style !== "band").map((one) => one.name))];
  return {
    animation: false,
    textStyle: { color: colours.text, fontFamily: "inherit" },
    grid: { left: 12, right: 18, top: panel.marks?.length ? 22 : 12, bottom: 12, containLabel: true, outerBoundsMode: "same", outerBounds: { left: 4, right: 10, top: panel.marks?.length ? 22 : 8, bottom: 46 } },
    legend: { bottom: 0, type: "scroll", data: names, formatter: (name: string) => name, textStyle: { color: colours.text, width: 180, overflow: "truncate" }, itemWidth: 34, itemHeight: 10, pageIconColor: colours.text, pageTextStyle: { color: colours.text }, inactiveColor: colours.muted },
    tooltip: {
      trigger: overCategories ? "item" : "axis",
      confine: true,
      axisPointer: { type: "cross", label: { show: false }, lineStyle: { color: colours.muted }, crossStyle: { color: colours.muted } },
      backgroundColor: colours.surface,
      borderColor: colours.grid,
      textStyle: { color: colours.text, fontSize: 12 },
      formatter: (items: any) => tooltipText(panel, Array.isArray(items) ? items : [items]),
    },
    dataZoom: overCategories ? [] : [
      { type: "inside", xAxisIndex: 0, filterMode: "none", zoomOnMouseWheel: "ctrl", moveOnMouseWheel: false },
      { type: "inside", yAxisIndex: 0, filterMode: "none", zoomOnMouseWheel: "ctrl", moveOnMouseWheel: false },
    ],
    xAxis: axisOption(panel.x, { nameGap: 26 }),
    yAxis: axisOption(panel.y, { nameGap: overCategories ? 12 : 44, inverse: overCategories }),
    series,
  };
}
