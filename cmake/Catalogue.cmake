# One row of a catalogue is one source file: every <stem>.cpp of FOLDER defines
#   <ROW> <NAMESPACE>::describe_<stem>();
# This writes the index that calls each of them, in alphabetical order, as
#   std::span<const <ROW>> <NAMESPACE>::<NAME>();
# so that adding a row is adding a file, with no list to edit.
function(flexspline_catalogue target)
  cmake_parse_arguments(ARG "" "NAME;ROW;HEADER;NAMESPACE;FOLDER" "" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS RELATIVE "${CMAKE_CURRENT_SOURCE_DIR}"
       "${CMAKE_CURRENT_SOURCE_DIR}/${ARG_FOLDER}/*.cpp")
  list(SORT sources)
  set(declarations "")
  set(calls "")
  foreach(source IN LISTS sources)
    get_filename_component(stem "${source}" NAME_WE)
    string(APPEND declarations "${ARG_ROW} describe_${stem}();\n")
    string(APPEND calls "      describe_${stem}(),\n")
  endforeach()
  set(index "${CMAKE_CURRENT_BINARY_DIR}/${ARG_NAME}_index.cpp")
  file(CONFIGURE OUTPUT "${index}" @ONLY CONTENT
"#include \"@ARG_HEADER@\"

#include <span>
#include <vector>

namespace @ARG_NAMESPACE@ {

@declarations@
std::span<const @ARG_ROW@> @ARG_NAME@() {
  static const std::vector<@ARG_ROW@> rows = {
@calls@  };
  return rows;
}

}  // namespace @ARG_NAMESPACE@
")
  target_sources(${target} PRIVATE ${sources} "${index}")
endfunction()
