# SPDX-License-Identifier: GPL-3.0-or-later
# Every package the project uses; all are Debian 12 packages, listed in scripts/packages.txt.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
set(CGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE TRUE)
find_package(CGAL 5.5 REQUIRED)
find_package(fmt REQUIRED)
find_package(spdlog REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(tomlplusplus QUIET)
if(NOT TARGET tomlplusplus::tomlplusplus)
    find_path(TOMLPLUSPLUS_INCLUDE toml++/toml.h REQUIRED)
    add_library(gf_tomlplusplus INTERFACE)
    target_include_directories(gf_tomlplusplus SYSTEM INTERFACE ${TOMLPLUSPLUS_INCLUDE})
    add_library(tomlplusplus::tomlplusplus ALIAS gf_tomlplusplus)
endif()

find_package(HDF5 REQUIRED COMPONENTS C)
add_library(gf_hdf5 INTERFACE)
target_include_directories(gf_hdf5 SYSTEM INTERFACE ${HDF5_INCLUDE_DIRS})
target_link_libraries(gf_hdf5 INTERFACE ${HDF5_C_LIBRARIES})

find_path(UDUNITS_INCLUDE udunits2.h REQUIRED)
find_library(UDUNITS_LIBRARY udunits2 REQUIRED)
add_library(gf_udunits INTERFACE)
target_include_directories(gf_udunits SYSTEM INTERFACE ${UDUNITS_INCLUDE})
target_link_libraries(gf_udunits INTERFACE ${UDUNITS_LIBRARY})

find_path(RANDOM123_INCLUDE Random123/philox.h REQUIRED)  # headers only
add_library(gf_random123 INTERFACE)
target_include_directories(gf_random123 SYSTEM INTERFACE ${RANDOM123_INCLUDE})

find_package(PkgConfig REQUIRED)
pkg_check_modules(PLPLOT REQUIRED IMPORTED_TARGET plplot)

if(GF_VTK)
    find_package(VTK 9.1 REQUIRED COMPONENTS CommonCore CommonDataModel IOLegacy IOXML)
endif()
