// Lines, points and bands over a number axis, or points over categories.

import type { Axis, Panel, Series } from "./document";
import { escapeHtml, shown, tick } from "./numbers";
import { onPaper, screenWidth } from "./screen";
import { namesOf, selectionOf } from "./selection";
import { colourOf, dashOf, isReference, kFont, kTooltipCss, symbolOf, theme, widthOf } from "./theme";

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

/** Over categories, symbols of different estimators stand a little apart, so that none hides another. */
function pointSeries(series: Series, dodged: boolean): Option {
  return {
    type: "scatter",
    name: series.name,
    data: pairs(series),
    symbol: symbolOf(series),
    symbolSize: series.x.length > 60 ? 4 : 11,
    symbolOffset: dodged ? [0, (series.rank % 4) * 6 - 9] : [0, 0],
    itemStyle: { color: colourOf(series), opacity: isReference(series) ? 0.35 : 0.9 },
    z: isReference(series) ? 2 : 3,
  };
}

const hasSymbols = (series: Series) => series.style === "points" || series.x.length <= 12;

function lineSeries(series: Series): Option {
  const few = hasSymbols(series);
  return {
    type: "line",
    name: series.name,
    data: pairs(series),
    showSymbol: few,
    symbol: few ? symbolOf(series) : "none",
    symbolSize: 8,
    lineStyle: { color: colourOf(series), width: widthOf(series), type: dashOf(series), opacity: isReference(series) || series.role === "highlight" ? 0.4 : 1 },
    itemStyle: { color: colourOf(series) },
    emphasis: { disabled: true },
    animation: false,
    z: series.role === "highlight" ? 1 : isReference(series) ? 2 : 3,
  };
}

function seriesOption(series: Series, panel: Panel): Option {
  if (series.style === "band") return bandSeries(series);
  if (series.style !== "points") return lineSeries(series);
  const several = panel.series.filter((one) => one.style === "points").length > 1;
  return pointSeries(series, several && Boolean(panel.y.categories));
}

/** Bands come last, because the legend draws the first series of a name. */
function seriesOptions(panel: Panel): Option[] {
  const bands = panel.series.filter((one) => one.style === "band");
  const others = panel.series.filter((one) => one.style !== "band");
  return [...others, ...bands].map((one) => seriesOption(one, panel));
}

/** Where something on the x axis ends, each label one line below the one before. */
function markOption(panel: Panel): Option {
  const labelled = new Set<string>();
  return {
    silent: true,
    symbol: "none",
    precision: 12,
    lineStyle: { color: theme().muted, type: [4, 4], width: 1 },
    data: (panel.marks ?? []).map((mark) => {
      const again = labelled.has(mark.label);
      labelled.add(mark.label);
      return { xAxis: mark.at, label: { show: !again && mark.at > 0, formatter: shown(mark.at, 3), color: theme().muted, fontSize: 11, position: panel.y.categories ? "start" : "end" } };
    }),
  };
}

/** Stretches of the x axis that are to be looked at. */
function spanOption(panel: Panel): Option {
  const data = (panel.spans ?? []).map(([from, to]) => [{ xAxis: from }, { xAxis: to }]);
  return { silent: true, itemStyle: { color: theme().highlight, opacity: 0.22 }, data };
}

/** 1, 2 and 5 of every decade between two values; of more than three decades their beginnings. */
function roundTicks(low: number, high: number): number[] {
  const digits = high / low > 1e3 ? [1] : [1, 2, 5];
  const ticks: number[] = [];
  for (let decade = Math.floor(Math.log10(low)); decade <= Math.log10(high); ++decade) {
    for (const digit of digits) ticks.push(Number(`${digit}e${decade}`));
  }
  return ticks.filter((tick) => tick >= low && tick <= high);
}

/** A logarithmic axis of few values apart from each other, e.g. frequencies, is labelled at those. */
function logTicks(axis: Axis, values: number[]): Option {
  const distinct = [...new Set(values)].filter((value) => value > 0).sort((a, b) => a - b);
  if (!axis.log || axis.range || !distinct.length) return {};
  const apart = distinct.every((value, i) => !i || value > 1.4 * distinct[i - 1]);
  if (distinct.length < 9 && apart) return { customValues: distinct };
  return { customValues: roundTicks(distinct[0] / 1.25, distinct[distinct.length - 1] * 1.25) };
}

function logRange(axis: Axis, values: number[]): Option {
  if (!axis.log || axis.range || !values.length) return {};
  return { min: Math.min(...values) / 1.25, max: Math.max(...values) * 1.25 };
}

/** A little beyond the data on both sides alike: rounded ends would set a loop off its middle. */
function linearRange(axis: Axis, values: number[]): Option {
  const seen = values.filter(Number.isFinite);
  const [low, high] = seen.reduce(([a, b], value) => [Math.min(a, value), Math.max(b, value)], [Infinity, -Infinity]);
  if (axis.log || axis.range || !(high > low)) return {};
  return { min: low - 0.05 * (high - low), max: high + 0.05 * (high - low) };
}

/** As wide as the longest name, within reason. */
function categoryWidth(categories: string[]): number {
  const longest = Math.max(...categories.map((name) => name.length));
  return Math.min(screenWidth() < 600 ? 96 : 230, Math.max(96, 6.2 * longest));
}

function axisOption(axis: Axis, values: number[], other: Option): Option {
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
    const label = { color: colours.text, fontSize: 11, width: categoryWidth(axis.categories), overflow: "truncate", interval: 0 };
    return { ...common, type: "category", data: axis.categories, axisLabel: label };
  }
  return {
    ...common,
    type: axis.log ? "log" : "value",
    scale: true,
    min: axis.range?.[0],
    max: axis.range?.[1],
    axisLabel: {
      color: colours.muted,
      fontSize: 11,
      formatter: tick,
      hideOverlap: true,
      showMinLabel: axis.log ? undefined : false,
      showMaxLabel: axis.log ? undefined : false,
      ...logTicks(axis, values),
    },
    ...logRange(axis, values),
    ...linearRange(axis, values),
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

export const kLegendRow = 30;

/** On paper every name is written, on as many rows as that takes; on a page it stands beside. */
export function legendRows(panel: Panel, width: number): number {
  if (!onPaper() || panel.cells) return 0;
  let rows = 1;
  let used = 0;
  for (const name of namesOf(panel)) {
    const needed = (panel.y.categories ? 46 : 64) + 7 * name.length;
    if (used > 0 && used + needed > width) [rows, used] = [rows + 1, 0];
    used += needed;
  }
  return rows;
}

function legendOption(panel: Panel): Option {
  const colours = theme();
  const shownOnes = panel.series.filter((one) => one.style !== "band");
  return {
    show: onPaper(),
    bottom: 0,
    selected: selectionOf(panel),
    data: shownOnes.map((one) => ({ name: one.name, itemStyle: hasSymbols(one) ? {} : { opacity: 0 } })),
    textStyle: { color: colours.text },
    itemGap: 18,
    itemWidth: panel.y.categories ? 12 : 30,
    itemHeight: 10,
    inactiveColor: colours.muted,
  };
}

/** For a place of that width. */
export function linesOption(panel: Panel, width: number): Option {
  const colours = theme();
  const overCategories = Boolean(panel.y.categories);
  const series = seriesOptions(panel);
  const carrier = series.find((one) => one.type !== "custom");
  if (carrier && panel.marks?.length) carrier.markLine = markOption(panel);
  if (carrier && panel.spans?.length) carrier.markArea = spanOption(panel);
  const xs = panel.series.flatMap((one) => one.x.filter((x): x is number => x !== null));
  return {
    animation: false,
    textStyle: { color: colours.text, fontFamily: kFont },
    grid: { left: panel.y.categories ? categoryWidth(panel.y.categories) + 30 : 74, right: 20, top: panel.marks?.length ? 22 : 10, bottom: 46 + kLegendRow * legendRows(panel, width), outerBoundsMode: "none" },
    legend: legendOption(panel),
    tooltip: {
      trigger: overCategories ? "item" : "axis",
      confine: true,
      extraCssText: kTooltipCss,
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
    xAxis: axisOption(panel.x, xs, { nameGap: 26 }),
    yAxis: axisOption(panel.y, [], { nameGap: overCategories ? 12 : 56, inverse: overCategories }),
    series,
  };
}
