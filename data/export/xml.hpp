#pragma once

#include <string>

namespace flexspline::data {

/// A text as content or attribute of XML.
std::string xml_escaped(const std::string& text);

/// A text as it may stand in a comment of XML: "--" is not allowed there.
std::string xml_comment(std::string text);

}  // namespace flexspline::data
