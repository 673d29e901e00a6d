# flexspline_npm_packages(OUTPUT stamp FOLDER folder LOCK folder-of-package-lock COMMENT text)
# Packages of the npm registry, as their lock file says. They are part of the target `downloads`, so
# that what needs a network can be done, and fail, before anything is compiled.
find_program(NPM_PROGRAM npm REQUIRED)
add_custom_target(downloads)

function(flexspline_npm_packages)
  cmake_parse_arguments(ARG "" "OUTPUT;FOLDER;LOCK;COMMENT" "" ${ARGN})
  # What an interrupted install left goes first: npm 9 of Debian 12 removes it while it writes.
  add_custom_command(
    OUTPUT "${ARG_OUTPUT}"
    COMMAND "${CMAKE_COMMAND}" -E rm -rf "${ARG_FOLDER}/node_modules"
    COMMAND "${CMAKE_COMMAND}" -E make_directory "${ARG_FOLDER}"
    COMMAND "${CMAKE_COMMAND}" -E copy "${ARG_LOCK}/package.json" "${ARG_LOCK}/package-lock.json" "${ARG_FOLDER}"
    COMMAND "${CMAKE_COMMAND}" -E chdir "${ARG_FOLDER}"
            "${NPM_PROGRAM}" ci --ignore-scripts --no-audit --no-fund --loglevel=error
    COMMAND "${CMAKE_COMMAND}" -E touch "${ARG_OUTPUT}"
    DEPENDS "${ARG_LOCK}/package.json" "${ARG_LOCK}/package-lock.json"
    COMMENT "${ARG_COMMENT}" VERBATIM)
  string(MAKE_C_IDENTIFIER "downloads_${ARG_OUTPUT}" target)
  add_custom_target(${target} DEPENDS "${ARG_OUTPUT}")
  add_dependencies(downloads ${target})
endfunction()
