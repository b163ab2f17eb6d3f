# SPDX-License-Identifier: GPL-2.0-or-later
# Finds the installed YADE and stops, with one sentence, if it is not the one that yade-headers/ was verified with.
# Sets YADE_LIBRARY_DIR; writes grainfall/_build_info.py, which the package reads when it is imported.

set(Python3_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "Python that YADE runs in")
find_path(YADE_LIBRARY_DIR libyade.so
    HINTS "/usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/yade-double" /usr/lib/x86_64-linux-gnu/yade-double
    DOC "folder of YADE's libraries (double precision)")
if(NOT YADE_LIBRARY_DIR)
    message(FATAL_ERROR "No YADE found: install Debian's package 'yade' (2023.02a, double precision) or give "
                        "-DYADE_LIBRARY_DIR=<folder of libyade.so>; -DGRAINFALL_WITH_YADE=OFF builds the kernels alone.")
endif()

set(guard "${PROJECT_SOURCE_DIR}/python/grainfall/_yade_guard.py")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${guard}")
set(GRAINFALL_HEADERS "yade-headers")
set(guard_options "")
if(YADE_SOURCE_DIR)
    # Compiled against YADE's own headers, the module fits the YADE they belong to: that one is recorded instead.
    set(GRAINFALL_HEADERS "source")
    set(guard_options "--any-version")
endif()
execute_process(COMMAND "${Python3_EXECUTABLE}" "${guard}" "${YADE_LIBRARY_DIR}" ${guard_options}
    OUTPUT_VARIABLE yade_found RESULT_VARIABLE yade_refused)
if(yade_refused)
    message(FATAL_ERROR "${yade_found}")
endif()

list(GET yade_found 0 YADE_VERSION)
list(GET yade_found 1 YADE_BITS)
list(GET yade_found 2 YADE_ID_LIBYADE)
list(GET yade_found 3 YADE_ID_COMMON)
list(GET yade_found 4 YADE_ID_DEM)
if(YADE_SOURCE_DIR AND EXISTS "${YADE_SOURCE_DIR}/RELEASE")
    file(STRINGS "${YADE_SOURCE_DIR}/RELEASE" yade_source_version LIMIT_COUNT 1)
    if(NOT yade_source_version STREQUAL YADE_VERSION)
        message(FATAL_ERROR "The source tree ${YADE_SOURCE_DIR} is YADE ${yade_source_version}, but the YADE installed in "
                            "${YADE_LIBRARY_DIR} is ${YADE_VERSION}.")
    endif()
endif()
message(STATUS "YADE ${YADE_VERSION}, ${YADE_BITS}-bit, in ${YADE_LIBRARY_DIR}; compiled against ${GRAINFALL_HEADERS}")
file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/python/grainfall/_build_info.py" @ONLY CONTENT
"# SPDX-License-Identifier: GPL-2.0-or-later
\"\"\"How this copy was built; written by CMake.\"\"\"
PACKAGE_VERSION = \"@PROJECT_VERSION@\"
HEADERS = \"@GRAINFALL_HEADERS@\"
VERSION = \"@YADE_VERSION@\"
BITS = @YADE_BITS@
BUILD_IDS = {
    \"libyade.so\": \"@YADE_ID_LIBYADE@\",
    \"libpkg_common.so\": \"@YADE_ID_COMMON@\",
    \"libpkg_dem.so\": \"@YADE_ID_DEM@\",
}
")
