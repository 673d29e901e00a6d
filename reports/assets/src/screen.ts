// What is drawn on: a page in a browser, or a sheet of paper where there is no browser.

export const inBrowser = typeof document !== "undefined";

const kSheetWidth = 1240;

export function screenWidth(): number {
  return inBrowser ? window.innerWidth : kSheetWidth;
}

/** Paper is light. */
const dark = inBrowser ? window.matchMedia("(prefers-color-scheme: dark)") : undefined;
let printing = !inBrowser;

export function setPrinting(on: boolean): void {
  printing = on;
}

/** On paper nothing can be scrolled or hovered over. */
export function onPaper(): boolean {
  return printing;
}

/** What a function gives as on paper. */
export function asOnPaper<T>(draw: () => T): T {
  const before = printing;
  printing = true;
  try {
    return draw();
  } finally {
    printing = before;
  }
}

export function isDark(): boolean {
  return Boolean(dark?.matches) && !printing;
}

export function onThemeChange(then: () => void): void {
  dark?.addEventListener("change", then);
}
