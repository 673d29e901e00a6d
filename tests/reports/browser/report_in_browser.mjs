// Opens the reports of the fixtures in headless Chromium, at the width of a desk and of a phone, and
// checks what a person would notice. Pictures of the pages are left in the working folder.
import { execFileSync } from "node:child_process";
import { cpSync, existsSync, mkdirSync, readdirSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

const kSkipped = 77;
const [drawReport, fixtures, packages, work, program, study] = process.argv.slice(2);
const kReports = [
  { name: "paper", study, page: "report/index.html", figures: 18 },
  { name: "study", fixture: "fixture", page: "report/index.html", figures: 12 },
  { name: "diagnosis", fixture: "diagnosis_fixture", page: "index.html", figures: 6 },
  { name: "trial", fixture: "trial_fixture", page: "report/index.html", figures: 3 },
  { name: "verification", fixture: "verification_fixture", page: "index.html", figures: 2 },
];
const kMostBytes = 3_000_000;
const kInteractiveWithin = 1000;  // ms
const kTimesText = 3.5;
const kTurns = 12;
const chromium = ["/usr/bin/chromium", "/usr/bin/chromium-browser"].find(existsSync);
if (!chromium) {
  console.log("skipped: no chromium on this machine (Debian: apt-get install chromium)");
  process.exit(kSkipped);
}
const { chromium: driver } = createRequire(join(packages, "package.json"))("playwright-core");

const failures = [];
let checks = 0;
const check = (holds, what) => {
  checks++;
  if (!holds) failures.push(what);
};

/// The summary is one sheet of A4 with three figures of some size, and nothing is cut off.
async function checkSummary(from, file, at) {
  const page = await from.context().browser().newPage();
  await page.goto(new URL(file, from.url()).href);
  const print = await page.pdf({ preferCSSPageSize: true, printBackground: true });
  writeFileSync(join(work, "summary.pdf"), print);
  const sheets = print.toString("latin1").match(/\/Type \/Page\b/g);
  check(sheets !== null && sheets.length === 1, `${at}: the summary has ${sheets?.length} sheets`);
  await page.emulateMedia({ media: "print" });
  const drawn = await page.locator("figure > svg").evaluateAll((all) =>
    all.map((one) => one.getBoundingClientRect()).filter((box) => box.width > 600 && box.height > 120).length);
  check(drawn === 3, `${at}: ${drawn} figures on the summary`);
  const wide = await page.evaluate(() => document.documentElement.scrollWidth);
  check(wide <= (page.viewportSize()?.width ?? 0), `${at}: the summary is ${wide} px wide`);
  await page.emulateMedia({ media: "screen" });
  await page.setViewportSize({ width: 390, height: 844 });
  const onPhone = await page.evaluate(() => document.documentElement.scrollWidth);
  check(onPhone <= 390, `${at}: the summary is ${onPhone} px wide on a phone`);
  await page.close();
}

async function checkFigure(page, figure, at) {
  const id = await figure.getAttribute("data-figure");
  await figure.scrollIntoViewIfNeeded();
  const drawn = figure.locator(".chart svg").first();
  await drawn.waitFor({ timeout: 60000 }).catch(() => check(false, `${at}: figure ${id} is not drawn`));
  const strokes = await figure.locator(".chart").evaluateAll((charts) =>
    charts.map((chart) => chart.querySelectorAll("svg path[clip-path], svg g[clip-path] path, svg path").length));
  check(strokes.length > 0 && strokes.every((count) => count > 5), `${at}: a panel of ${id} has no series (${strokes})`);
  return id;
}

/** Centres of the symbols of a scatter; a few places in the middle of any other chart. */
function placesToHover(chart) {
  const box = chart.getBoundingClientRect();
  const symbols = [...chart.querySelectorAll("svg path")].map((path) => path.getBoundingClientRect());
  const small = symbols.filter((one) => one.width > 7 && one.width < 16 && Math.abs(one.width - one.height) < 3 && one.bottom < box.bottom - 60);
  const middle = [[0.5, 0.4], [0.6, 0.5], [0.7, 0.2], [0.35, 0.62]].map(([x, y]) => [box.x + x * box.width, box.y + y * box.height]);
  return [...small.slice(0, 3).map((one) => [one.x + one.width / 2, one.y + one.height / 2]), ...middle];
}

async function checkHover(page, figure, id, at) {
  for (const [x, y] of await figure.locator(".chart").first().evaluate(placesToHover)) {
    await page.mouse.move(x, y, { steps: 3 });
    await page.waitForTimeout(120);
    const text = await figure.locator(".chart > div").allInnerTexts();
    if (text.some((one) => /\d/.test(one))) return;
  }
  check(false, `${at}: hovering over ${id} shows no tooltip`);
}

const pictureOf = (figure) => figure.locator(".chart svg").first().evaluate((svg) => svg.innerHTML);

const pressed = (page, name) => page.locator(".legend button", { hasText: name }).evaluateAll((buttons, exactly) =>
  buttons.filter((one) => one.textContent === exactly).map((one) => one.getAttribute("aria-pressed")), name);

/** A chart follows an action with the next frame: whether it does within a second. */
async function changesFrom(page, figure, before) {
  for (let i = 0; i < 20; i++) {
    if ((await pictureOf(figure)) !== before) return true;
    await page.waitForTimeout(50);
  }
  return false;
}

/** What one legend hides is hidden in every figure of the page, by keyboard too. */
async function checkLegend(page, figure, id, at) {
  const entry = figure.locator(".legend button").last();
  if ((await entry.count()) === 0) return;
  const name = await entry.textContent();
  const before = await pictureOf(figure);
  await entry.focus();
  await page.keyboard.press("Space");
  const states = await pressed(page, name);
  check(states.length > 0 && states.every((one) => one === "false"), `${at}: hiding ${name} in ${id} does not reach every figure (${states})`);
  check((await figure.locator(".chart").count()) > 1 || (await changesFrom(page, figure, before)), `${at}: hiding ${name} changes nothing in ${id}`);
  await page.keyboard.press("Space");
  check((await pressed(page, name)).every((one) => one === "true"), `${at}: ${name} does not come back in ${id}`);
}

/** Plus, an arrow and zero on a chart that has the focus. */
async function checkKeys(page, figure, id, at) {
  const chart = figure.locator(".chart[tabindex]").first();
  if ((await chart.count()) === 0) return;
  const whole = await pictureOf(figure);
  await chart.focus();
  await page.keyboard.press("+");
  check(await changesFrom(page, figure, whole), `${at}: plus does not zoom ${id}`);
  const zoomed = await pictureOf(figure);
  await page.keyboard.press("ArrowRight");
  check(await changesFrom(page, figure, zoomed), `${at}: an arrow does not move ${id}`);
  await page.keyboard.press("0");
}

/** Text that is read stands out from what is behind it: 4.5 to 1, WCAG AA. */
const lowContrast = () => {
  const rgb = (text) => text.match(/[\d.]+/g).map(Number);
  const light = ([r, g, b]) => {
    const [x, y, z] = [r, g, b].map((v) => (v / 255 <= 0.04045 ? v / 255 / 12.92 : ((v / 255 + 0.055) / 1.055) ** 2.4));
    return 0.2126 * x + 0.7152 * y + 0.0722 * z;
  };
  const behind = (element) => {
    for (let one = element; one; one = one.parentElement) {
      const colour = rgb(getComputedStyle(one).backgroundColor);
      if (colour.length < 4 || colour[3] > 0) return colour;
    }
    return [255, 255, 255];
  };
  const low = new Set();
  for (const element of document.querySelectorAll("main *:not(.chart *)")) {
    const own = [...element.childNodes].some((node) => node.nodeType === 3 && node.textContent.trim());
    if (!own || element.closest(".scale, option, svg") || !element.getClientRects().length) continue;
    const [a, b] = [light(rgb(getComputedStyle(element).color)), light(behind(element))].sort((x, y) => y - x);
    if ((a + 0.05) / (b + 0.05) < 4.5) low.add(`${element.tagName} ${element.className}`);
  }
  return [...low];
};

async function checkPickers(figure, id, at) {
  for (const select of await figure.locator("select").all()) {
    const values = await select.locator("option").evaluateAll((options) => options.map((one) => one.value));
    if (values.length < 2) continue;
    const before = await pictureOf(figure);
    await select.selectOption(values[1]);
    const after = await pictureOf(figure);
    check(before !== after, `${at}: the picker of ${id} changes nothing`);
    check((await select.inputValue()) === values[1], `${at}: the picker of ${id} does not stay on what was chosen`);
  }
}

async function checkLayout(page, at) {
  const { wide, screen } = await page.evaluate(() => ({ wide: document.documentElement.scrollWidth, screen: innerWidth }));
  check(wide <= screen, `${at}: the page is ${wide} px wide on a screen of ${screen}`);
  const unnamed = await page.evaluate(() =>
    [...document.querySelectorAll(".panels")].filter((one) => !one.getAttribute("aria-label")).length);
  check(unnamed === 0, `${at}: ${unnamed} figures without an alternative text`);
  const low = await page.evaluate(lowContrast);
  check(low.length === 0, `${at}: too little contrast: ${low}`);
  const uncopied = await page.evaluate(() => [...document.querySelectorAll("pre")].filter((one) => !one.parentElement.querySelector("button.copy")).length);
  check(uncopied === 0, `${at}: ${uncopied} listings cannot be copied`);
  check(await page.evaluate(() => window.hacked === undefined && !document.querySelector("main img")), `${at}: a hostile name ran`);
}

/** Every figure as a file too, each a drawing that a browser can read. */
async function checkFiles(page, folder, at) {
  const pictures = readdirSync(join(folder, "report", "figures")).filter((one) => one.endsWith(".svg"));
  const ids = await page.locator("figure[data-figure]").evaluateAll((all) => all.map((one) => one.dataset.figure));
  check(pictures.length === ids.length, `${at}: ${pictures.length} files for ${ids.length} figures`);
  for (const name of pictures) {
    const text = readFileSync(join(folder, "report", "figures", name), "utf8");
    const broken = await page.evaluate((svg) => new DOMParser().parseFromString(svg, "image/svg+xml").querySelector("parsererror") !== null, text);
    check(!broken, `${at}: ${name} is not XML`);
  }
}

async function interactiveAfter(browser, url) {
  const page = await browser.newPage({ viewport: { width: 1440, height: 900 } });
  await page.goto(url);
  const time = await page.evaluate(() => performance.getEntriesByType("navigation")[0].domInteractive);
  await page.close();
  return time;
}

/**
 * A busy machine must not look like a slow page, nor a slow one: there the page is held against its text alone, which
 * takes 300 ms where all takes 800. The quickest of each counts, in turns, as what else runs comes and goes.
 */
async function startsInTime(browser, url) {
  const bare = join(work, "bare.html");
  writeFileSync(bare, readFileSync(fileURLToPath(url), "utf8").replace(/<script.*?<\/script>/gs, ""));
  let whole = Infinity;
  let text = Infinity;
  for (let turn = 0; turn < kTurns; turn++) {
    whole = Math.min(whole, await interactiveAfter(browser, url));
    if (whole <= kInteractiveWithin) break;
    text = Math.min(text, await interactiveAfter(browser, pathToFileURL(bare).href));
    if (turn > 1 && whole <= kTimesText * text) break;
  }
  return { whole, text, inTime: whole <= kInteractiveWithin || whole <= kTimesText * text };
}

async function checkStart(browser, url, at) {
  const { whole, text, inTime } = await startsInTime(browser, url);
  const size = statSync(fileURLToPath(url)).size;
  const beside = text < Infinity ? `, its text alone after ${Math.round(text)}` : "";
  console.log(`${at}: ${size} bytes, interactive after ${Math.round(whole)} ms${beside}`);
  check(inTime, `${at}: interactive only after ${Math.round(whole)} ms${beside}`);
  check(size <= kMostBytes, `${at}: ${size} bytes`);
}

/** On paper nothing is wider than the paper, which a browser would shrink, and figures are drawn anew for it. */
async function checkPrint(page, at) {
  await page.emulateMedia({ media: "print" });
  await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
  const { paper, widest, charts } = await page.evaluate(() => ({
    paper: document.querySelector("main").getBoundingClientRect().right,
    widest: Math.max(...[...document.querySelectorAll("main table, main .chart svg, main p")].map((one) => one.getBoundingClientRect().right)),
    charts: [...document.querySelectorAll(".chart svg")].map((one) => Number(one.getAttribute("width"))),
  }));
  check(paper < 720, `${at}: the print is ${paper} px wide`);
  check(widest <= paper + 1, `${at}: something in print reaches ${widest} px, the paper ${paper}`);
  check(charts.every((one) => one <= paper + 1), `${at}: charts are printed ${Math.max(...charts)} px wide`);
  await page.evaluate(() => dispatchEvent(new Event("afterprint")));
  await page.emulateMedia({ media: null });
}

async function visit(browser, report, url, width, scheme, folder) {
  const at = `${report.name}, ${width} px, ${scheme}`;
  const desk = width > 1000 && scheme === "light";  // pointer and keyboard act alike on every screen
  const page = await browser.newPage({ viewport: { width, height: 900 }, colorScheme: scheme });
  page.setDefaultTimeout(120000);  // a picture of a long page takes longer than 30 s on a busy machine
  page.on("console", (message) => check(!["error", "warning"].includes(message.type()), `${at}: console: ${message.text()}`));
  page.on("pageerror", (error) => check(false, `${at}: ${error}`));
  page.on("request", (request) => check(request.url() === url || /^(data|blob):/.test(request.url()), `${at}: request for ${request.url()}`));
  await page.goto(url);
  check((await page.title()).length > 0, `${at}: the page has no title`);
  await page.locator("details").evaluateAll((all) => all.forEach((one) => (one.open = true)));
  const figures = await page.locator("figure[data-figure]").all();
  check(figures.length >= report.figures, `${at}: only ${figures.length} figures`);
  for (const figure of figures) {
    const id = await checkFigure(page, figure, at);
    await checkPickers(figure, id, at);
    if (!desk) continue;
    await checkHover(page, figure, id, at);
    await checkLegend(page, figure, id, at);
    await checkKeys(page, figure, id, at);
  }
  await checkLayout(page, at);
  const misfit = await page.evaluate(() =>
    [...document.querySelectorAll(".chart")].filter((one) => one.querySelector("svg").getAttribute("width") !== String(one.clientWidth)).length);
  check(misfit === 0, `${at}: ${misfit} charts are not as wide as their place`);
  if (folder) await checkFiles(page, folder, at);
  await page.evaluate(() => scrollTo(0, 0));
  await page.mouse.move(1, 1);
  await page.screenshot({ path: join(work, `${report.name}-${width}-${scheme}.png`), fullPage: true });
  if (desk) {
    const pdf = await page.pdf({ format: "A4" });
    writeFileSync(join(work, `${report.name}.pdf`), pdf);
    check(pdf.length > 20000, `${at}: the print is empty`);
    await checkPrint(page, at);
    const summary = page.locator("p.summary a");
    if ((await summary.count()) > 0) await checkSummary(page, await summary.getAttribute("href"), at);
  }
  await page.close();
}

rmSync(work, { recursive: true, force: true });
mkdirSync(work, { recursive: true });
const browser = await driver.launch({ executablePath: chromium, args: ["--no-sandbox"] });
for (const report of kReports) {
  const folder = join(work, report.name);
  if (report.study) {
    execFileSync(program, ["run", report.study, "--out", folder, "--quiet"]);
  } else {
    cpSync(join(fixtures, report.fixture), folder, { recursive: true });
    execFileSync(drawReport, [folder]);
  }
  const url = pathToFileURL(join(folder, report.page)).href;
  await checkStart(browser, url, report.name);
  await visit(browser, report, url, 1440, "light", folder);
  await visit(browser, report, url, 1440, "dark");
  await visit(browser, report, url, 390, "light");
}
await browser.close();
for (const failure of failures) console.log(failure);
console.log(failures.length === 0 ? `the reports hold: ${checks} checks` : `${failures.length} of ${checks} checks fail`);
process.exit(failures.length === 0 ? 0 : 1);
