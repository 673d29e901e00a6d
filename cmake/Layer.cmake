# A layer is a static library of every .cpp below the folders named, with its public headers in
# include/flexspline/<layer>/. Folders that hold a catalogue are added by flexspline_catalogue.
option(FLEXSPLINE_WARNINGS_AS_ERRORS "treat compiler warnings as errors" OFF)

function(flexspline_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wno-restrict
                         $<$<BOOL:${FLEXSPLINE_WARNINGS_AS_ERRORS}>:-Werror>)
endfunction()

function(flexspline_layer name)
  cmake_parse_arguments(ARG "" "" "FOLDERS;LINKS;PRIVATE_LINKS;PRECOMPILED" ${ARGN})
  set(sources "")
  foreach(folder IN LISTS ARG_FOLDERS)
    file(GLOB found CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/${folder}/*.cpp")
    list(APPEND sources ${found})
  endforeach()
  add_library(flexspline_${name} STATIC ${sources})
  target_include_directories(flexspline_${name}
    PUBLIC "$<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>" "$<INSTALL_INTERFACE:include>"
    PRIVATE "${CMAKE_CURRENT_SOURCE_DIR}")
  target_compile_features(flexspline_${name} PUBLIC cxx_std_20)
  target_link_libraries(flexspline_${name} PUBLIC ${ARG_LINKS} PRIVATE ${ARG_PRIVATE_LINKS})
  flexspline_warnings(flexspline_${name})
  flexspline_precompile(flexspline_${name} ${ARG_PRECOMPILED})
endfunction()

# Half of the time that a file takes goes into the headers that every file reads.
option(FLEXSPLINE_PRECOMPILED_HEADERS "precompile heavy headers" ON)

function(flexspline_precompile target)
  if(FLEXSPLINE_PRECOMPILED_HEADERS)
    target_precompile_headers(${target} PRIVATE <algorithm> <array> <cmath> <filesystem> <functional> <map>
      <memory> <optional> <span> <string> <string_view> <utility> <vector> <tl/expected.hpp> ${ARGN})
  endif()
endfunction()
