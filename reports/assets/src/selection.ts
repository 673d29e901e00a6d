// Which series are hidden, by name, for the whole page: hiding an estimator in one figure hides it
// in every other, and it stays hidden when a picker changes.

import type { Panel } from "./document";

const hidden = new Set<string>();

export function isHidden(name: string): boolean {
  return hidden.has(name);
}

export function toggle(name: string): void {
  if (!hidden.delete(name)) hidden.add(name);
}

/** Names with an entry in the legend; a band belongs to its line. */
export function namesOf(panel: Panel): string[] {
  return panel.series.filter((one) => one.style !== "band").map((one) => one.name);
}

export function selectionOf(panel: Panel): Record<string, boolean> {
  return Object.fromEntries(namesOf(panel).map((name) => [name, !hidden.has(name)]));
}
