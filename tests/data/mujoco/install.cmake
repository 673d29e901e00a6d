# The MuJoCo engine from its lock file, in the build folder: exported joints are simulated in it.
set(engine "${PROJECT_BINARY_DIR}/mujoco")
flexspline_npm_packages(OUTPUT "${engine}/installed.stamp" FOLDER "${engine}" LOCK "${CMAKE_CURRENT_LIST_DIR}"
  COMMENT "Installing MuJoCo for the tests of exports from its lock file")
target_sources(flexspline_data_tests PRIVATE "${engine}/installed.stamp")
file(CONFIGURE OUTPUT mujoco_dir.hpp CONTENT "#pragma once\n\n#define FLEXSPLINE_MUJOCO_DIR \"@engine@\"\n" @ONLY)
