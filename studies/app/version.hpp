#pragma once

#include <map>
#include <string>

namespace flexspline::app {

/// Program, compiler and libraries by name.
std::map<std::string, std::string> versions();

/// The same as text of --version.
std::string version_text();

/// Identifies the code that results come from: a hash of the layers that compute.
std::string build_id();

}  // namespace flexspline::app
