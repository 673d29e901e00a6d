# The MuJoCo engine from its lock file, in the build folder: exported joints are simulated in it.
set(engine "${PROJECT_BINARY_DIR}/mujoco")
find_program(NPM_PROGRAM npm REQUIRED)
add_custom_command(
  OUTPUT "${engine}/installed.stamp"
  COMMAND "${CMAKE_COMMAND}" -E make_directory "${engine}"
  COMMAND "${CMAKE_COMMAND}" -E copy "${CMAKE_CURRENT_LIST_DIR}/package.json"
          "${CMAKE_CURRENT_LIST_DIR}/package-lock.json" "${engine}"
  COMMAND "${CMAKE_COMMAND}" -E chdir "${engine}"
          "${NPM_PROGRAM}" ci --ignore-scripts --no-audit --no-fund --loglevel=error
  COMMAND "${CMAKE_COMMAND}" -E touch "${engine}/installed.stamp"
  DEPENDS "${CMAKE_CURRENT_LIST_DIR}/package.json" "${CMAKE_CURRENT_LIST_DIR}/package-lock.json"
  COMMENT "Installing MuJoCo for the tests of exports from its lock file" VERBATIM)
target_sources(flexspline_data_tests PRIVATE "${engine}/installed.stamp")
file(CONFIGURE OUTPUT mujoco_dir.hpp CONTENT "#pragma once\n\n#define FLEXSPLINE_MUJOCO_DIR \"@engine@\"\n" @ONLY)
