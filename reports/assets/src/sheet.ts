// The panels of a figure on one sheet, as an SVG file for papers.

import { chartText, extentOf } from "./charts";
import type { Figure, Panel } from "./document";
import { readFigures } from "./document";
import { kLegendRow, legendRows } from "./lines";
import { escapeHtml } from "./numbers";
import { kFont } from "./theme";

interface Picture {
  title: string;
  notes: string[];
  width: number;
  height: number;
  svg: string;
}

const kGap = 24;
const kTitle = 24;
const kNote = 16;

/** What stands below a panel: the places on its x axis that mean something. */
export function notesOf(panel: Panel): string[] {
  return (panel.marks ?? []).filter((mark) => mark.at > 0).map((mark) => `${mark.at}: ${mark.label}`);
}

const textAt = (x: number, y: number, size: number, weight: number, text: string) =>
  `<text x="${x}" y="${y}" font-family="${escapeHtml(kFont)}" font-size="${size}" font-weight="${weight}" fill="#1c1f23">${escapeHtml(text)}</text>`;

function placed(picture: Picture, x: number, y: number): string {
  const below = y + kTitle + picture.height;
  const notes = picture.notes.map((note, i) => textAt(x, below + kNote * (i + 0.8), 11, 400, note));
  const svg = picture.svg.replace("<svg ", `<svg x="${x}" y="${y + kTitle}" `);
  return textAt(x, y + 0.7 * kTitle, 14, 600, picture.title) + svg + notes.join("");
}

const heightOf = (picture: Picture) => kTitle + picture.height + kNote * picture.notes.length;

/** Two beside each other where there are several. */
function sheetOf(pictures: Picture[]): string {
  const columns = pictures.length > 1 ? 2 : 1;
  const column = Math.max(...pictures.map((one) => one.width));
  let y = kGap / 2;
  let body = "";
  for (let i = 0; i < pictures.length; i += columns) {
    const row = pictures.slice(i, i + columns);
    body += row.map((one, k) => placed(one, kGap / 2 + k * (column + kGap), y)).join("");
    y += Math.max(...row.map(heightOf)) + kGap;
  }
  const width = columns * (column + kGap);
  return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${y}" viewBox="0 0 ${width} ${y}"><rect width="100%" height="100%" fill="#ffffff"/>${body}</svg>\n`;
}

/** A figure's panels, for one choice of its pickers, on one sheet. */
export function sheetFor(figure: Figure, panels: Panel[]): string {
  const several = panels.length > 1;
  const pictures = panels.map((panel) => {
    const wanted = extentOf(panel, figure);
    const width = Math.max(wanted.width ?? 0, several ? 560 : 900);
    const height = (wanted.height ?? (several ? 380 : 460)) + kLegendRow * Math.max(0, legendRows(panel, width) - 1);
    return { title: panel.title, notes: notesOf(panel), width, height, svg: chartText(panel, figure, width, height) };
  });
  return sheetOf(pictures);
}

/** Every figure as it is first shown, by its id. */
export function drawSheets(text: string): string {
  const sheets: Record<string, string> = {};
  for (const [id, figure] of Object.entries(readFigures(text))) {
    if (figure.frames.length) sheets[id] = sheetFor(figure, figure.frames[0].panels);
  }
  return JSON.stringify(sheets);
}
