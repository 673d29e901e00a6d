// Draws each figure when it comes near the screen, and again when its picker, its size or the colour
// scheme changes.

import type { Chart } from "./charts";
import { drawChart, extentOf, linkCharts } from "./charts";
import type { Figure, Frame, Panel } from "./document";
import { readFigures } from "./document";
import { addDownloads } from "./download";
import { scaleStrip } from "./heatmap";
import { addPickers } from "./picker";
import { onThemeChange, setPrinting } from "./screen";
import { notesOf } from "./sheet";
import type { Picture } from "./sheet";

class DrawnFigure {
  private charts: Chart[] = [];
  private frame: Frame;
  private readonly panels: HTMLElement;
  private seen = false;

  constructor(private readonly figure: Figure, element: HTMLElement) {
    this.frame = figure.frames[0];
    this.panels = element.querySelector<HTMLElement>(".panels")!;
    const controls = element.querySelector<HTMLElement>(".controls")!;
    addPickers(figure, controls, (frame) => {
      this.frame = frame;
      this.draw();
    });
    addDownloads(figure.id, figure.cell_unit ?? "", controls, () => this.frame.panels, () => this.pictures());
    if (figure.kind === "heatmap" && figure.scale) this.panels.before(scaleStrip(figure.scale, figure.cell_unit ?? ""));
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
    if (width) place.style.minWidth = `${width}px`;
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

  private pictures(): Picture[] {
    const serializer = new XMLSerializer();
    return this.charts.map((chart, i) => ({
      title: this.frame.panels[i].title,
      notes: notesOf(this.frame.panels[i]),
      width: chart.getWidth(),
      height: chart.getHeight(),
      svg: serializer.serializeToString(chart.getDom().querySelector("svg")!),
    }));
  }

  draw(): void {
    this.seen = true;
    const places = this.layOut();
    this.charts = this.frame.panels.map((panel, i) => drawChart(places[i], panel, this.figure));
    if (this.charts.length > 1 && this.figure.kind === "lines") linkCharts(this.figure.id);
  }

  redraw(): void {
    if (this.seen) this.draw();
  }
}

export function startPage(): void {
  const figures = readFigures(document.getElementById("figures")?.textContent ?? "{}");
  const drawn: DrawnFigure[] = [];
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
    const one = new DrawnFigure(figure, element);
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
