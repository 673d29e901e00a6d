// Opens the reports of the fixtures in headless Chromium, at the width of a desk and of a phone, and
// checks what a person would notice. Pictures of the pages are left in the working folder.
import { execFileSync } from "node:child_process";
import { cpSync, existsSync, mkdirSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const kSkipped = 77;
const [drawReport, fixtures, packages, work] = process.argv.slice(2);
const kReports = [
  { name: "study", fixture: "fixture", page: "report/index.html", figures: 8 },
  { name: "diagnosis", fixture: "diagnosis_fixture", page: "index.html", figures: 4 },
  { name: "trial", fixture: "trial_fixture", page: "report/index.html", figures: 3 },
];
const chromium = ["/usr/bin/chromium", "/usr/bin/chromium-browser"].find(existsSync);
if (!chromium) {
  console.log("skipped: no chromium on this machine (Debian: apt-get install chromium)");
  process.exit(kSkipped);
}
const { chromium: driver } = createRequire(join(packages, "package.json"))("playwright-core");

const failures = [];
const check = (holds, what) => {
  if (!holds) failures.push(what);
};

async function checkFigure(page, figure, at) {
  const id = await figure.getAttribute("data-figure");
  await figure.scrollIntoViewIfNeeded();
  const drawn = figure.locator(".chart svg").first();
  await drawn.waitFor({ timeout: 5000 }).catch(() => check(false, `${at}: figure ${id} is not drawn`));
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
  check(await page.evaluate(() => window.hacked === undefined && !document.querySelector("main img")), `${at}: a hostile name ran`);
}

async function visit(browser, report, url, width, scheme) {
  const at = `${report.name}, ${width} px, ${scheme}`;
  const page = await browser.newPage({ viewport: { width, height: 900 }, colorScheme: scheme });
  page.on("console", (message) => check(!["error", "warning"].includes(message.type()), `${at}: console: ${message.text()}`));
  page.on("pageerror", (error) => check(false, `${at}: ${error}`));
  page.on("request", (request) => check(request.url() === url || /^(data|blob):/.test(request.url()), `${at}: request for ${request.url()}`));
  await page.goto(url);
  check((await page.title()).length > 0, `${at}: the page has no title`);
  const interactive = await page.evaluate(() => performance.getEntriesByType("navigation")[0].domInteractive);
  console.log(`${at}: interactive after ${Math.round(interactive)} ms`);
  const figures = await page.locator("figure[data-figure]").all();
  check(figures.length >= report.figures, `${at}: only ${figures.length} figures`);
  for (const figure of figures) {
    const id = await checkFigure(page, figure, at);
    await checkHover(page, figure, id, at);
    await checkPickers(figure, id, at);
  }
  await checkLayout(page, at);
  const misfit = await page.evaluate(() =>
    [...document.querySelectorAll(".chart")].filter((one) => one.querySelector("svg").getAttribute("width") !== String(one.clientWidth)).length);
  check(misfit === 0, `${at}: ${misfit} charts are not as wide as their place`);
  await page.evaluate(() => scrollTo(0, 0));
  await page.mouse.move(1, 1);
  await page.screenshot({ path: join(work, `${report.name}-${width}-${scheme}.png`), fullPage: true });
  if (width > 1000 && scheme === "light") {
    const pdf = await page.pdf({ format: "A4" });
    writeFileSync(join(work, `${report.name}.pdf`), pdf);
    check(pdf.length > 20000, `${at}: the print is empty`);
  }
  await page.close();
}

rmSync(work, { recursive: true, force: true });
mkdirSync(work, { recursive: true });
const browser = await driver.launch({ executablePath: chromium, args: ["--no-sandbox"] });
for (const report of kReports) {
  const folder = join(work, report.name);
  cpSync(join(fixtures, report.fixture), folder, { recursive: true });
  execFileSync(drawReport, [folder]);
  const url = pathToFileURL(join(folder, report.page)).href;
  await visit(browser, report, url, 1440, "light");
  await visit(browser, report, url, 1440, "dark");
  await visit(browser, report, url, 390, "light");
}
await browser.close();
for (const failure of failures) console.log(failure);
console.log(failures.length === 0 ? "the reports hold" : `${failures.length} failures`);
process.exit(failures.length === 0 ? 0 : 1);
