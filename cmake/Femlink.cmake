# SPDX-License-Identifier: GPL-2.0-or-later
# The continuum of the deformable wall: a library over deal.II and CHOLMOD. Without deal.II, walls cannot be
# built here, but those in files can be used: that part, femlink/core, needs LAPACK and BLAS alone.

set(GRAINFALL_WITH_DEALII "auto" CACHE STRING "build the continuum: auto (if deal.II is found), ON or OFF")
set_property(CACHE GRAINFALL_WITH_DEALII PROPERTY STRINGS auto ON OFF)
if(GRAINFALL_WITH_DEALII)
    find_package(deal.II 9.4 QUIET CONFIG HINTS /usr/share/cmake/deal.II)
endif()
find_path(CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse)
find_library(CHOLMOD_LIBRARY cholmod)
find_library(TBB_LIBRARY tbb)
set(GRAINFALL_CONTINUUM OFF)
if(deal.II_FOUND AND CHOLMOD_INCLUDE_DIR AND CHOLMOD_LIBRARY AND TBB_LIBRARY)
    set(GRAINFALL_CONTINUUM ON)
elseif(GRAINFALL_WITH_DEALII STREQUAL "ON")
    message(FATAL_ERROR "No deal.II 9.4 with CHOLMOD found: install Debian's package 'libdeal.ii-dev' or leave out "
                        "-DGRAINFALL_WITH_DEALII=ON.")
endif()
if(NOT GRAINFALL_CONTINUUM)
    message(STATUS "deal.II: not used; deformable walls cannot be built, only read from files")
    return()
endif()
message(STATUS "deal.II ${DEAL_II_PACKAGE_VERSION}: deformable walls")

file(GLOB continuum_sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/femlink/continuum/*.cpp")
add_library(grainfall_continuum STATIC ${continuum_sources})
# YADE loads modules with their symbols global; Eigen's, compiled here with other options than in grainfall._core,
# must not meet those there.
set_target_properties(grainfall_continuum PROPERTIES
    POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
target_include_directories(grainfall_continuum SYSTEM PRIVATE ${DEAL_II_INCLUDE_DIRS} "${CHOLMOD_INCLUDE_DIR}")
# deal.II's own list names 150 libraries; these are the ones called from here.
find_library(DEALII_LIBRARY deal.ii REQUIRED HINTS "${DEAL_II_PATH}/lib/${CMAKE_LIBRARY_ARCHITECTURE}")
target_link_libraries(grainfall_continuum
    PUBLIC grainfall_kernels
    PRIVATE grainfall_warnings grainfall_dense "${DEALII_LIBRARY}" "${TBB_LIBRARY}" "${CHOLMOD_LIBRARY}")
