// One program for two places: it draws the page where there is one, and elsewhere (node) figures as
// files, from standard input to standard output.

import { startPage } from "./page";
import { inBrowser } from "./screen";
import { drawSheets } from "./sheet";

declare const process: any;

if (inBrowser) {
  startPage();
} else {
  let text = "";
  process.stdin.setEncoding("utf8");
  process.stdin.on("data", (piece: string) => (text += piece));
  process.stdin.on("end", () => process.stdout.write(drawSheets(text)));
}
