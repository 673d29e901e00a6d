// Draws the report of the study folder given, for the browser test.
#include <iostream>

#include "flexspline/reports/report.hpp"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const auto page = flexspline::reports::write_report(argv[1]);
  if (!page) {
    std::cerr << page.error().message() << '\n';
    return static_cast<int>(page.error().code);
  }
  std::cout << page->page.string() << '\n';
  return 0;
}
