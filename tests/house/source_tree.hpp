#pragma once

#include <string>
#include <vector>

namespace flexspline::house {

/// One line of one file of the project, to be quoted where it breaks a rule.
struct SourceLine {
  std::string file;  ///< relative to the project's root, with forward slashes
  int number = 0;
  std::string text;

  std::string place() const { return file + ":" + std::to_string(number) + ": " + text; }
};

/// Every line of the C++ files of the layers and the tests.
std::vector<SourceLine> lines_of_code();

/// Every line of the CMake files of the project.
std::vector<SourceLine> lines_of_cmake();

/// Every line of the files that people write: code, CMake, scripts, studies, documents.
std::vector<SourceLine> lines_of_text();

/// What the line includes, without its quotes; empty if it includes nothing.
std::string included(const std::string& text);

/// Whether a file may include a header: the layers, and the only places that name a library.
bool may_include(const std::string& file, const std::string& header);

/// Whether the text has the absolute path of somebody's own folder in it.
bool names_a_private_path(const std::string& text);

}  // namespace flexspline::house
