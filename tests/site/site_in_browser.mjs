// Builds the documents as a site and reads it in headless Chromium: every link leads somewhere, every
// equation is set, nothing is fetched from elsewhere, no page is wider than a phone.
import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, readdirSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join, relative, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const kSkipped = 77;
const [build, packages, work] = process.argv.slice(2);
const chromium = ["/usr/bin/chromium", "/usr/bin/chromium-browser"].find(existsSync);
const pandoc = process.env.PATH.split(":").some((folder) => existsSync(join(folder, "pandoc")));
if (!chromium || !pandoc) {
  console.log(`skipped: no ${chromium ? "pandoc" : "chromium"} on this machine`);
  process.exit(kSkipped);
}
const { chromium: driver } = createRequire(join(packages, "package.json"))("playwright-core");

rmSync(work, { recursive: true, force: true });
mkdirSync(work, { recursive: true });
execFileSync("bash", [build, work]);

const failures = [];
let checks = 0;
const check = (holds, what) => {
  checks++;
  if (!holds) failures.push(what);
};

const pagesIn = (folder) =>
  readdirSync(folder, { withFileTypes: true }).flatMap((entry) =>
    entry.isDirectory() ? pagesIn(join(folder, entry.name)) : entry.name.endsWith(".html") ? [join(folder, entry.name)] : []);

const browser = await driver.launch({ executablePath: chromium, args: ["--no-sandbox"] });
const page = await browser.newPage({ viewport: { width: 390, height: 900 } });
page.setDefaultTimeout(120000);  // on a busy machine
const pages = pagesIn(work);
const anchors = new Map();
const links = [];
let at = "";
page.on("console", (message) => check(message.type() !== "error", `${at}: console: ${message.text()}`));
page.on("request", (request) => check(request.url().startsWith("file:"), `${at}: request for ${request.url()}`));
for (const file of pages) {
  at = relative(work, file);
  await page.goto(pathToFileURL(file).href);
  const seen = await page.evaluate(() => ({
    title: document.title.split(" · ")[0],
    wide: document.documentElement.scrollWidth,
    ids: [...document.querySelectorAll("[id]")].map((one) => one.id),
    links: [...document.querySelectorAll("a[href]")].map((one) => one.getAttribute("href")),
    images: [...document.images].filter((one) => one.naturalWidth === 0).length,
    equations: [...document.querySelectorAll("math")].map((one) => one.getBoundingClientRect()).map((box) => Math.min(box.width, box.height)),
    unset: document.querySelectorAll("merror").length,
    raw: document.querySelector("main").innerText.includes("$$"),
  }));
  check(seen.title.length > 0, `${at}: no title`);
  check(seen.wide <= 390, `${at}: ${seen.wide} px wide on a phone`);
  check(seen.images === 0, `${at}: ${seen.images} images are missing`);
  check(seen.unset === 0 && !seen.raw && seen.equations.every((size) => size > 8), `${at}: an equation is not set`);
  check(!at.startsWith("docs/effects/") || at.endsWith("index.html") || seen.equations.length > 0, `${at}: no equation`);
  anchors.set(file, new Set(seen.ids));
  for (const link of seen.links) if (!/^[a-z]+:/.test(link)) links.push([file, link]);
}
for (const [from, link] of links) {
  const [path, anchor] = decodeURIComponent(link).split("#");
  const target = path ? resolve(dirname(from), path) : from;
  const there = existsSync(target) || !target.startsWith(resolve(work)) || !target.endsWith(".html");
  check(there, `${relative(work, from)}: ${link} leads nowhere`);
  check(!anchor || !anchors.has(target) || anchors.get(target).has(anchor), `${relative(work, from)}: ${link}: no such place`);
}
await page.setViewportSize({ width: 1280, height: 900 });
await page.goto(pathToFileURL(join(work, "docs/effects/lugre_friction.html")).href);
await page.screenshot({ path: join(work, "effect.png"), fullPage: true });
await page.goto(pathToFileURL(join(work, "index.html")).href);
await page.screenshot({ path: join(work, "index.png") });
await browser.close();
for (const failure of failures) console.log(failure);
console.log(failures.length === 0 ? `the site holds: ${pages.length} pages, ${checks} checks` : `${failures.length} of ${checks} checks fail`);
process.exit(failures.length === 0 ? 0 : 1);
