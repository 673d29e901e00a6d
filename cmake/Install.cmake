# What `cmake --install` and `cpack -G DEB` lay down: the program, a static library and the public
# headers a layer, and the package that find_package(flexspline CONFIG) finds.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(layers core data estimators studies reports)
set(package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/flexspline")
foreach(layer IN LISTS layers)
  set_target_properties(flexspline_${layer} PROPERTIES EXPORT_NAME ${layer})
  add_library(flexspline::${layer} ALIAS flexspline_${layer})
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/${layer}/include/" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
          COMPONENT development)
  list(APPEND targets flexspline_${layer})
endforeach()
install(TARGETS ${targets} EXPORT flexspline ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT development)
install(EXPORT flexspline NAMESPACE flexspline:: FILE flexsplineTargets.cmake
        DESTINATION "${package_folder}" COMPONENT development)
configure_package_config_file(cmake/flexsplineConfig.cmake.in "${CMAKE_BINARY_DIR}/flexsplineConfig.cmake"
                              INSTALL_DESTINATION "${package_folder}")
write_basic_package_version_file("${CMAKE_BINARY_DIR}/flexsplineConfigVersion.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_BINARY_DIR}/flexsplineConfig.cmake" "${CMAKE_BINARY_DIR}/flexsplineConfigVersion.cmake"
              cmake/Dependencies.cmake
        DESTINATION "${package_folder}" COMPONENT development)

install(TARGETS flexspline RUNTIME COMPONENT program)
install(FILES "${CMAKE_BINARY_DIR}/studies/app/flexspline.1" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1"
        COMPONENT program)
file(GLOB example_studies CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/studies/*.toml")
install(FILES ${example_studies} DESTINATION "${CMAKE_INSTALL_DATADIR}/flexspline/studies" COMPONENT program)
install(DIRECTORY studies/models DESTINATION "${CMAKE_INSTALL_DATADIR}/flexspline/studies" COMPONENT program)
install(DIRECTORY docs/examples/ DESTINATION "${CMAKE_INSTALL_DATADIR}/flexspline/examples" COMPONENT program)
install(FILES README.md CHANGELOG.md CITATION.cff DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT program)
install(DIRECTORY docs DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT program PATTERN examples EXCLUDE)
install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DOCDIR}" RENAME copyright COMPONENT program)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "the authors of flexspline <flexspline@localhost>")
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME flexspline)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libflexspline-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "coinor-libipopt-dev, libboost-dev, libceres-dev, libeigen3-dev, libexpected-dev, libfmt-dev, \
libhdf5-dev, liblz4-dev, libmatio-dev, libnetcdf-dev, libsqlite3-dev, libssl-dev, libsundials-dev, libtomlplusplus-dev, libzip-dev, libzstd-dev, \
nlohmann-json3-dev, zlib1g-dev")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "${PROJECT_DESCRIPTION}: the program")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "${PROJECT_DESCRIPTION}: libraries and headers for C++")
set(CPACK_STRIP_FILES ON)
include(CPack)
