cmake_minimum_required(VERSION 3.25)
# Writes OUTPUT with the commit and a hash over LIBRARIES, the layers that results come from, so that
# a change of the report or of a command does not make a study start again. Rewritten only when it
# differs.
set(hashes "")
foreach(library IN LISTS LIBRARIES)
  file(SHA256 "${library}" hash)
  string(APPEND hashes "${hash}")
endforeach()
string(SHA256 identity "${hashes}")
execute_process(COMMAND git -C "${SOURCE}" describe --always --dirty --abbrev=12
                OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT commit)
  set(commit "unknown")
endif()
file(CONFIGURE OUTPUT "${OUTPUT}" @ONLY CONTENT
"#pragma once

namespace flexspline::app {

inline constexpr const char* kCommit = \"@commit@\";
inline constexpr const char* kBuildId = \"@identity@\";

}  // namespace flexspline::app
")
