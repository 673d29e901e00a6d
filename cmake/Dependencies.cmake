# Packages of Debian 12, by the names that docs/building.md lists. Installed beside the package for
# find_package, which needs the same.
find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(Ceres 2.1 REQUIRED)
find_package(SUNDIALS 6.4 REQUIRED COMPONENTS cvodes nvecserial sunmatrixdense
             sunnonlinsolfixedpoint)
find_package(Boost 1.74 REQUIRED)
find_package(fmt 9 CONFIG REQUIRED)
find_package(nlohmann_json 3.11 CONFIG REQUIRED)
find_package(tomlplusplus CONFIG REQUIRED)
find_package(OpenSSL REQUIRED COMPONENTS Crypto)
find_package(ZLIB REQUIRED)
find_package(tl-expected REQUIRED CONFIG)
pkg_check_modules(ipopt REQUIRED IMPORTED_TARGET ipopt)
pkg_check_modules(netcdf REQUIRED IMPORTED_TARGET netcdf)
pkg_check_modules(libzip REQUIRED IMPORTED_TARGET libzip)
