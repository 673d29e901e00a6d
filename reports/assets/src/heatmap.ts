// Numbers over two category axes, coloured by their size.

import type { Cell, Figure, Panel } from "./document";
import { escapeHtml, shown } from "./numbers";
import { screenWidth } from "./screen";
import { heatColours, inkOn, kFont, kTooltipCss, theme } from "./theme";

type Option = Record<string, any>;

const kNotes: Record<string, string> = { trained: " T", outside: " *", right: " ✓" };

/**
 * Where a number stands among the colours, 0 to 1: errors on a logarithmic scale that all panels share; others, which
 * may be negative, between the least and the largest of their panel.
 */
function sharesOf(panel: Panel, figure: Figure): (value: number) => number {
  if (figure.scale || (figure.cell_unit ?? "").startsWith("%")) {
    const [low, high] = (figure.scale ?? [0.1, 100]).map(Math.log10);
    return (value) => Math.min(1, Math.max(0, (Math.log10(Math.max(value, 1e-12)) - low) / (high - low)));
  }
  const values = (panel.cells ?? []).flatMap((cell) => (cell[2] === null ? [] : [cell[2]]));
  const low = Math.min(...values);
  const high = Math.max(...values);
  return (value) => (high > low ? (value - low) / (high - low) : 0.5);
}

function cellText(value: number | null, unit: string): string {
  if (value === null) return "–";
  return value >= 1e5 ? value.toExponential(0).replace("e+", "e") : unit.startsWith("%") ? shown(value, 2) : String(value);
}

function cellOption(cell: Cell, shareOf: (value: number) => number, unit: string): Option {
  const [column, row, value, note] = cell;
  const share = value === null ? 0 : shareOf(value);
  return {
    value: [column, row, share, value],
    label: { color: value === null ? theme().text : inkOn(share), formatter: cellText(value, unit) + (kNotes[note] ?? "") },
    itemStyle: value === null ? { color: "transparent" } : undefined,
    note,
  };
}

function tooltipText(panel: Panel, item: any, unit: string): string {
  const [column, row, , value] = item.value;
  const said = { trained: "trained on this recording", outside: "outside its domain of validity", right: "the right answer" }[item.data.note as string];
  const place = `${panel.y.label}: ${panel.y.categories?.[row]}, ${panel.x.label}: ${panel.x.categories?.[column]}`;
  return `${escapeHtml(place)}<br><b>${unit.startsWith("%") ? shown(value, 3) : value}</b> ${escapeHtml(unit)}${said ? `<br>${said}` : ""}`;
}

/** Names that would run into each other are written upwards. */
function isWide(panel: Panel): boolean {
  const names = panel.x.categories ?? [];
  const longest = Math.max(0, ...names.map((name) => Math.min(name.length, 24)));
  return names.length * (6.2 * longest + 8) > Math.min(screenWidth(), 1240) - 220;
}

/** Least width and height that such names need; none where any place will do. */
export function wideExtent(panel: Panel): { width: number; height: number } | undefined {
  if (!isWide(panel)) return undefined;
  return { width: 200 + 34 * panel.x.categories!.length, height: 230 + 30 * (panel.y.categories?.length ?? 0) };
}

function axisOption(label: string, categories: string[] | undefined, gap: number, rotate = 0): Option {
  const colours = theme();
  return {
    type: "category",
    data: categories ?? [],
    name: label,
    nameLocation: "middle",
    nameGap: gap,
    nameTextStyle: { color: colours.text },
    axisLine: { show: false },
    axisTick: { show: false },
    splitLine: { show: false },
    axisLabel: { color: colours.text, fontSize: 11, interval: 0, rotate, width: screenWidth() < 600 && !rotate ? 90 : 160, overflow: "truncate" },
  };
}

export function heatmapOption(panel: Panel, figure: Figure): Option {
  const colours = theme();
  const shareOf = sharesOf(panel, figure);
  const unit = figure.cell_unit ?? "";
  return {
    animation: false,
    textStyle: { color: colours.text, fontFamily: kFont },
    grid: { left: 8, right: 8, top: 8, bottom: 8, outerBoundsMode: "same", outerBounds: { left: 4, right: 4, top: 4, bottom: 4 } },
    tooltip: {
      confine: true,
      extraCssText: kTooltipCss,
      backgroundColor: colours.surface,
      borderColor: colours.grid,
      textStyle: { color: colours.text, fontSize: 12 },
      formatter: (item: any) => tooltipText(panel, item, unit),
    },
    visualMap: { show: false, min: 0, max: 1, dimension: 2, inRange: { color: heatColours } },
    xAxis: axisOption(panel.x.label, panel.x.categories, isWide(panel) ? 150 : 26, isWide(panel) ? 60 : 0),
    yAxis: axisOption(panel.y.label, panel.y.categories, 40),
    series: [
      {
        type: "heatmap",
        name: panel.title,
        data: (panel.cells ?? []).map((cell) => cellOption(cell, shareOf, unit)),
        label: { show: true, fontSize: 11 },
        itemStyle: { borderColor: colours.surface, borderWidth: 2 },
        emphasis: { itemStyle: { borderColor: colours.text } },
      },
    ],
  };
}

/** The scale as a strip with its decades. */
export function scaleStrip(scale: [number, number], unit: string): HTMLElement {
  const strip = document.createElement("div");
  strip.className = "scale";
  const [low, high] = scale.map(Math.log10);
  const bar = document.createElement("div");
  bar.className = "bar";
  bar.style.background = `linear-gradient(to right, ${heatColours.join(",")})`;
  const ticks = document.createElement("div");
  ticks.className = "ticks";
  for (let decade = Math.round(low); decade <= Math.round(high); decade++) {
    const label = document.createElement("span");
    label.textContent = `${Number((10 ** decade).toPrecision(1))}${unit.startsWith("%") ? " %" : ""}`;
    ticks.append(label);
  }
  strip.append(bar, ticks);
  return strip;
}
