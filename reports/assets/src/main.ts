// Draws each figure when it comes near the screen, and again when its picker, its size or the colour
// scheme changes.

import type { Chart } from "./charts";
import { drawChart, linkCharts } from "./charts";
import type { Figure, Frame, Panel } from "./document";
import { readFigures } from "./document";
import { addDownloads } from "./download";
import { fitHeatmap, scaleStrip } from "./heatmap";
import { addPickers } from "./picker";
import { onThemeChange, setPrinting } from "./theme";

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
    addDownloads(figure.id, figure.cell_unit ?? "", controls, () => this.frame.panels, () => [...this.panels.querySelectorAll("svg")]);
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
    const rows = panel.y.categories?.length ?? 0;
    if (rows > 0) place.style.height = `${110 + rows * (this.figure.kind === "heatmap" ? 38 : 26)}px`;
    if (this.figure.kind === "heatmap") fitHeatmap(place, panel);
    if (panel.title) box.append(title);
    box.append(place);
    for (const mark of panel.marks ?? []) {
      const note = document.createElement("p");
      note.className = "mark";
      note.textContent = `${mark.at}: ${mark.label}`;
      if (mark.at > 0) box.append(note);
    }
    return place;
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

function start(): void {
  const figures = readFigures();
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

start();
