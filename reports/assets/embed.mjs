// Writes a C++ source that holds the bundle: raw strings, split because compilers limit their size.
import { readFileSync, writeFileSync } from "node:fs";

const [scriptFile, styleFile, output] = process.argv.slice(2);
const kPiece = 12000;

function chunksOf(text) {
  const letters = Array.from(text);
  const chunks = [];
  for (let i = 0; i < letters.length; i += kPiece) chunks.push(letters.slice(i, i + kPiece).join(""));
  return chunks;
}

function functionOf(name, text) {
  if (text.includes(')asset"')) throw new Error(`${name}: the bundle holds the raw string's delimiter`);
  const literals = chunksOf(text).map((chunk) => `      R"asset(${chunk})asset"sv,\n`);
  return `std::string ${name}() {
  static constexpr std::string_view pieces[] = {
${literals.join("")}  };
  std::string text;
  for (const std::string_view piece : pieces) text += piece;
  return text;
}
`;
}

// The licence asks that the notice travels with the code.
const notice =
  "/*! Apache ECharts, copyright the Apache Software Foundation, Apache-2.0; zrender, BSD-3-Clause; tslib, 0BSD */";
const script = notice + readFileSync(scriptFile, "utf8").replaceAll("</script", "<\\/script");
const style = readFileSync(styleFile, "utf8").replaceAll("</style", "<\\/style");
writeFileSync(
  output,
  `#include <string>
#include <string_view>

#include "page.hpp"

namespace flexspline::reports {

using namespace std::string_view_literals;

${functionOf("page_script", script)}
${functionOf("page_style", style)}
}  // namespace flexspline::reports
`,
);
