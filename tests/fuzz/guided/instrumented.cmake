# What reads files of others is compiled for libFuzzer. All else is linked from the build folder that
# FLEXSPLINE_FUZZ_REST names, of another preset of the same sources: it is there already, and to compile it
# again would take most of an hour. Its rows of a catalogue that are here, too, are not taken from there.
set(FLEXSPLINE_FUZZ_REST "${PROJECT_SOURCE_DIR}/build/release" CACHE PATH "build folder with the layers' libraries")
set(folders data/readers data/tables data/import data/artefacts data/table_readers studies/config)
set(instrumented "${PROJECT_BINARY_DIR}/data/table_readers_index.cpp" "${PROJECT_SOURCE_DIR}/core/nesting.cpp")
foreach(folder IN LISTS folders)
  file(GLOB found CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/${folder}/*.cpp")
  list(APPEND instrumented ${found})
endforeach()
file(GLOB found CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/reports/parse_*.cpp" "${PROJECT_SOURCE_DIR}/studies/*/read_*.cpp")
list(APPEND instrumented ${found} "${PROJECT_SOURCE_DIR}/reports/json_fields.cpp"
  "${PROJECT_SOURCE_DIR}/reports/lock_file.cpp" "${PROJECT_SOURCE_DIR}/reports/read_checked.cpp"
  "${PROJECT_SOURCE_DIR}/studies/results/row_json.cpp" "${PROJECT_SOURCE_DIR}/studies/conceal/answer_json.cpp")
list(REMOVE_DUPLICATES instrumented)
add_library(flexspline_fuzz_instrumented STATIC ${instrumented})
target_compile_options(flexspline_fuzz_instrumented PRIVATE -fsanitize=fuzzer-no-link)
target_sources(flexspline_fuzz_instrumented PRIVATE "${CMAKE_CURRENT_SOURCE_DIR}/guided/seen_child.cpp")
set_source_files_properties("${CMAKE_CURRENT_SOURCE_DIR}/guided/seen_child.cpp" PROPERTIES
  COMPILE_OPTIONS "-fno-sanitize=fuzzer-no-link" SKIP_PRECOMPILE_HEADERS ON)
flexspline_precompile(flexspline_fuzz_instrumented <fmt/format.h> <nlohmann/json.hpp>)
set_source_files_properties("${PROJECT_SOURCE_DIR}/data/tables/hdf5_handle.cpp"
  "${PROJECT_SOURCE_DIR}/data/table_readers/hdf5.cpp" "${PROJECT_SOURCE_DIR}/data/table_readers/netcdf.cpp"
  PROPERTIES INCLUDE_DIRECTORIES "${hdf5_INCLUDE_DIRS}")

set(rest "")
set(others "")
foreach(layer reports studies estimators data core)
  list(APPEND rest "${FLEXSPLINE_FUZZ_REST}/${layer}/libflexspline_${layer}.a")
  get_target_property(linked flexspline_${layer} LINK_LIBRARIES)
  list(FILTER linked EXCLUDE REGEX "^flexspline_")
  list(APPEND others ${linked})
  target_include_directories(flexspline_fuzz_linked INTERFACE "${PROJECT_SOURCE_DIR}/${layer}/include")
  target_include_directories(flexspline_fuzz_instrumented PRIVATE "${PROJECT_SOURCE_DIR}/${layer}/include"
    "${PROJECT_SOURCE_DIR}/${layer}")
endforeach()
list(REMOVE_DUPLICATES others)
target_link_libraries(flexspline_fuzz_instrumented PRIVATE ${others})
target_compile_definitions(flexspline_fuzz_linked INTERFACE FLEXSPLINE_FUZZ_GUIDED)
target_link_libraries(flexspline_fuzz_linked INTERFACE -fsanitize=fuzzer flexspline_fuzz_instrumented
  -Wl,--start-group ${rest} -Wl,--end-group ${others})
