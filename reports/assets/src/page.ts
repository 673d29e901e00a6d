// Draws each figure when it comes near the screen, and again when its picker, its size or the colour
// scheme changes.

import type { Chart } from "./charts";
import { applySelection, drawChart, extentOf } from "./charts";
import { addCopyButtons } from "./copy";
import type { Figure, Frame, Panel } from "./document";
import { readFigures, unpack } from "./document";
import { addDownloads } from "./download";
import { scaleStrip } from "./heatmap";
import { listenToKeys } from "./keyboard";
import { fillLegend, refreshLegend } from "./legend";
import { addPickers } from "./picker";
import { asOnPaper, onPaper, onThemeChange, setPrinting } from "./screen";
import { notesOf, sheetFor } from "./sheet";

class DrawnFigure {
  private charts: Chart[] = [];
  private frame: Frame;
  private readonly panels: HTMLElement;
  private readonly legend = document.createElement("div");
  private seen = false;

  constructor(private readonly figure: Figure, element: HTMLElement, private readonly selectionChanged: () => void) {
    this.frame = figure.frames[0];
    this.panels = element.querySelector<HTMLElement>(".panels")!;
    const controls = element.querySelector<HTMLElement>(".controls")!;
    addPickers(figure, controls, (frame) => {
      this.frame = frame;
      this.draw();
    });
    addDownloads(figure.id, figure.cell_unit ?? "", controls, () => this.frame.panels, () => asOnPaper(() => sheetFor(figure, this.frame.panels)));
    if (figure.kind === "heatmap" && figure.scale) this.panels.before(scaleStrip(figure.scale, figure.cell_unit ?? ""));
    this.legend.className = "legend";
    if (figure.kind !== "heatmap") this.panels.after(this.legend);
    this.layOut();
    new ResizeObserver(() => this.fit()).observe(this.panels);
  }

  /** A place without a width (not laid out yet, or hidden) keeps the picture it has. */
  private fit(): void {
    if (this.panels.clientWidth > 0) this.charts.forEach((chart) => chart.resize());
  }

  /** Space for every panel, so that the page does not jump when they are drawn. */
  private layOut(): HTMLElement[] {
    this.charts.forEach((chart) => chart.dispose());
    this.charts = [];
    const places = this.frame.panels.map((panel) => this.placeFor(panel));
    this.panels.dataset.count = String(places.length);
    this.panels.replaceChildren(...places.map((place) => place.parentElement!));
    fillLegend(this.legend, this.frame.panels, this.selectionChanged);
    return places;
  }

  private placeFor(panel: Panel): HTMLElement {
    const box = document.createElement("div");
    box.className = `panel ${this.figure.kind}`;
    const title = document.createElement("h4");
    title.textContent = panel.title;
    const place = document.createElement("div");
    place.className = "chart";
    const { width, height } = extentOf(panel, this.figure);
    if (width && !onPaper()) place.style.minWidth = `${width}px`;
    if (height) place.style.height = `${height}px`;
    if (panel.title) box.append(title);
    box.append(place);
    for (const text of notesOf(panel)) {
      const note = document.createElement("p");
      note.className = "mark";
      note.textContent = text;
      box.append(note);
    }
    return place;
  }

  draw(): void {
    this.seen = true;
    const places = this.layOut();
    this.charts = this.frame.panels.map((panel, i) => drawChart(places[i], panel, this.figure));
    if (this.figure.kind === "lines") this.charts.forEach((chart, i) => this.addKeys(places[i], chart, this.frame.panels[i]));
  }

  private addKeys(place: HTMLElement, chart: Chart, panel: Panel): void {
    place.tabIndex = 0;
    place.setAttribute("role", "group");
    place.setAttribute("aria-label", `${panel.title || this.figure.title}: plus and minus zoom, arrows move, zero shows all`);
    listenToKeys(place, chart);
  }

  applySelection(): void {
    this.charts.forEach((chart, i) => applySelection(chart, this.frame.panels[i]));
    refreshLegend(this.legend);
  }

  redraw(): void {
    if (this.seen) this.draw();
  }
}

/** A browser that cannot unpack them (before 2023) says where the figures are. */
async function carriedFigures(): Promise<Record<string, Figure>> {
  try {
    return readFigures(await unpack(document.getElementById("figures")?.textContent ?? ""));
  } catch (error) {
    document.querySelectorAll(".panels").forEach((one) =>
      (one.textContent = `This browser cannot draw the figures (${error}); they lie beside this page as figures/*.svg.`));
    return {};
  }
}

export async function startPage(): Promise<void> {
  addCopyButtons();
  const figures = await carriedFigures();
  const drawn: DrawnFigure[] = [];
  const selectionChanged = () => drawn.forEach((one) => one.applySelection());
  const waiting = new Map<Element, DrawnFigure>();
  const observer = new IntersectionObserver(
    (entries) =>
      entries.filter((entry) => entry.isIntersecting).forEach((entry) => {
        observer.unobserve(entry.target);
        waiting.get(entry.target)?.draw();
        waiting.delete(entry.target);
      }),
    { rootMargin: "400px" },
  );
  for (const element of document.querySelectorAll<HTMLElement>("figure[data-figure]")) {
    const figure = figures[element.dataset.figure ?? ""];
    if (!figure?.frames.length) continue;
    const one = new DrawnFigure(figure, element, selectionChanged);
    drawn.push(one);
    waiting.set(element, one);
    observer.observe(element);
  }
  onThemeChange(() => drawn.forEach((one) => one.redraw()));
  const print = (on: boolean) => {
    setPrinting(on);
    document.documentElement.classList.toggle("printing", on);
    drawn.forEach((one) => (on ? one.draw() : one.redraw()));
  };
  window.addEventListener("beforeprint", () => print(true));
  window.addEventListener("afterprint", () => print(false));
}
