# Packs the build, takes the program's package apart and diagnoses the example that came with it.
# Needs BUILD, WORK.
cmake_minimum_required(VERSION 3.25)

include("${CMAKE_CURRENT_LIST_DIR}/call.cmake")

file(REMOVE_RECURSE "${WORK}")
file(MAKE_DIRECTORY "${WORK}")
call(cpack -G DEB --config "${BUILD}/CPackConfig.cmake" -B "${WORK}")
file(GLOB package "${WORK}/flexspline_*.deb")
call(dpkg -x "${package}" "${WORK}/root")
set(example "${WORK}/root/usr/share/flexspline/examples/locked-gear")
call("${WORK}/root/usr/bin/flexspline" diagnose "${example}" --out "${WORK}/diagnosis")
call("${WORK}/root/usr/bin/flexspline" validate "${WORK}/root/usr/share/flexspline/studies/paper.toml")
foreach(file diagnosis/index.html root/usr/share/man/man1/flexspline.1 root/usr/share/doc/flexspline/docs/dataset.md)
  if(NOT EXISTS "${WORK}/${file}")
    message(FATAL_ERROR "${file} is missing")
  endif()
endforeach()
