# SPDX-License-Identifier: GPL-2.0-or-later
# The extension module grainfall._core and the importable package in <build>/python.
#
# The compile flags are part of YADE's binary interface: with Eigen's alignment left on, State has
# another size than in the installed library.

# The system's Python, not whichever python3 stands first on PATH: YADE runs in this one.
set(Python3_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "Python that YADE runs in")
find_package(Python3 3.11 REQUIRED COMPONENTS Interpreter Development.Module)
find_package(OpenMP REQUIRED COMPONENTS CXX)
find_package(Boost 1.74 REQUIRED COMPONENTS python${Python3_VERSION_MAJOR}${Python3_VERSION_MINOR} serialization)

add_library(yade_interface INTERFACE)
target_include_directories(yade_interface INTERFACE "${PROJECT_SOURCE_DIR}")
target_compile_definitions(yade_interface INTERFACE
    EIGEN_DONT_ALIGN EIGEN_DONT_VECTORIZE EIGEN_DISABLE_UNALIGNED_ARRAY_ASSERT
    BOOST_BIND_GLOBAL_PLACEHOLDERS BOOST_ALLOW_DEPRECATED_HEADERS)
if(YADE_SOURCE_DIR)
    if(NOT EXISTS "${YADE_SOURCE_DIR}/core/Scene.hpp")
        message(FATAL_ERROR "YADE_SOURCE_DIR = ${YADE_SOURCE_DIR}: no core/Scene.hpp in it; "
                            "give the root of a YADE source tree or leave the option empty.")
    endif()
    find_package(MPI COMPONENTS CXX)
    find_package(Boost 1.74 REQUIRED COMPONENTS log thread)
    target_include_directories(yade_interface SYSTEM INTERFACE "${YADE_SOURCE_DIR}" ${MPI_CXX_INCLUDE_DIRS})
    # The options that Debian's build of YADE was compiled with; they decide the layout of its classes.
    target_compile_definitions(yade_interface INTERFACE
        YADE_REAL_BIT=64 YADE_REAL_DEC=15 YADE_OPENMP YADE_MPI YADE_OPENGL YADE_FEM PARTIALSAT
        YADE_BOOST_LOG BOOST_LOG_DYN_LINK MAX_LOG_LEVEL=5)
    target_link_libraries(yade_interface INTERFACE Boost::log Boost::thread)
else()
    target_include_directories(yade_interface SYSTEM INTERFACE "${PROJECT_SOURCE_DIR}/yade-headers")
endif()
target_link_libraries(yade_interface INTERFACE
    Eigen3::Eigen Python3::Module OpenMP::OpenMP_CXX Boost::python311 Boost::serialization
    "${YADE_LIBRARY_DIR}/libyade.so" "${YADE_LIBRARY_DIR}/libpkg_common.so" "${YADE_LIBRARY_DIR}/libpkg_dem.so")

file(GLOB extension_sources CONFIGURE_DEPENDS
    "${PROJECT_SOURCE_DIR}/laws/yade/*.cpp"
    "${PROJECT_SOURCE_DIR}/engines/*/yade/*.cpp"
    "${PROJECT_SOURCE_DIR}/femlink/core/*.cpp"
    "${PROJECT_SOURCE_DIR}/femlink/yade/*.cpp"
    "${PROJECT_SOURCE_DIR}/python/module/*.cpp")
add_library(grainfall_core MODULE ${extension_sources})
target_link_libraries(grainfall_core PRIVATE yade_interface grainfall_dense grainfall_warnings)
# A square root need not report its errors to errno: it is one instruction then.
target_compile_options(grainfall_core PRIVATE -fno-math-errno)
# At -O2 the compiler leaves Eigen's loops over three numbers out of line where several kernels share them, and a
# contact costs a fifth more than the same law written by hand (benchmarks/effect_cost/measure.py).
file(GLOB inner_loops CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/laws/yade/contact_kernels_*.cpp"
     "${PROJECT_SOURCE_DIR}/laws/yade/wet_contact.cpp" "${PROJECT_SOURCE_DIR}/engines/flat/yade/flat_*.cpp"
     "${PROJECT_SOURCE_DIR}/femlink/core/*.cpp" "${PROJECT_SOURCE_DIR}/femlink/yade/wall_*.cpp" "${PROJECT_SOURCE_DIR}/femlink/yade/ExplicitFarField.cpp")
# -Wno-psabi: functions over vectors of four numbers are all inlined, so that no convention of passing them matters.
# (YADE's own -frounding-math would take the square roots of four numbers one by one, and is no part of its interface.)
set_source_files_properties(${inner_loops} PROPERTIES COMPILE_OPTIONS "$<$<CONFIG:Release>:-O3>;-Wno-psabi")
# Boost.Python and Eigen are most of a translation unit's compile time.
target_precompile_headers(grainfall_core PRIVATE <lib/serialization/Serializable.hpp>)
set(package_dir "${PROJECT_BINARY_DIR}/python/grainfall")
set_target_properties(grainfall_core PROPERTIES
    PREFIX "" OUTPUT_NAME "_core" SUFFIX ".so"
    LIBRARY_OUTPUT_DIRECTORY "${package_dir}"
    BUILD_RPATH "${YADE_LIBRARY_DIR}" INSTALL_RPATH "${YADE_LIBRARY_DIR}")

# The deformable wall in numpy: contacts without deal.II, and the continuum with it.
find_package(pybind11 2.10 REQUIRED CONFIG)
function(grainfall_add_femlink_module name)
    add_library(grainfall_femlink_${name} MODULE "${PROJECT_SOURCE_DIR}/femlink/module/${name}_module.cpp")
    target_link_libraries(grainfall_femlink_${name} PRIVATE
        grainfall_kernels grainfall_dense grainfall_warnings pybind11::headers Python3::Module ${ARGN})
    # g++ 12 takes pybind11's move of an Eigen vector for a read of an unset one.
    target_compile_options(grainfall_femlink_${name} PRIVATE -Wno-maybe-uninitialized)
    set_target_properties(grainfall_femlink_${name} PROPERTIES
        PREFIX "" OUTPUT_NAME "_${name}" SUFFIX ".so" LIBRARY_OUTPUT_DIRECTORY "${package_dir}/femlink"
        CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
    install(TARGETS grainfall_femlink_${name} LIBRARY DESTINATION "${python_dir}/grainfall/femlink")
    add_dependencies(grainfall_package grainfall_femlink_${name})
endfunction()

file(GLOB_RECURSE package_sources CONFIGURE_DEPENDS RELATIVE "${PROJECT_SOURCE_DIR}/python"
     "${PROJECT_SOURCE_DIR}/python/grainfall/*.py")
# Copies of files that are gone from the sources would be installed too.
file(GLOB_RECURSE copies RELATIVE "${PROJECT_BINARY_DIR}/python" "${package_dir}/*.py")
list(REMOVE_ITEM copies ${package_sources} grainfall/_build_info.py)
foreach(stale IN LISTS copies)
    file(REMOVE "${PROJECT_BINARY_DIR}/python/${stale}")
endforeach()
foreach(source IN LISTS package_sources)
    add_custom_command(OUTPUT "${PROJECT_BINARY_DIR}/python/${source}"
        COMMAND "${CMAKE_COMMAND}" -E copy "${PROJECT_SOURCE_DIR}/python/${source}"
                "${PROJECT_BINARY_DIR}/python/${source}"
        DEPENDS "${PROJECT_SOURCE_DIR}/python/${source}")
    list(APPEND package_copies "${PROJECT_BINARY_DIR}/python/${source}")
endforeach()
add_custom_target(grainfall_package ALL DEPENDS ${package_copies})

# Where /usr/bin/python3 looks without being told: python3/dist-packages under /usr, else dist-packages of its version.
set(GRAINFALL_PYTHON_DIR "" CACHE PATH "folder for the Python package, under the prefix; empty: where Debian's Python looks")
set(python_dir "${GRAINFALL_PYTHON_DIR}")
if(NOT python_dir AND CMAKE_INSTALL_PREFIX STREQUAL "/usr")
    set(python_dir "lib/python3/dist-packages")
elseif(NOT python_dir)
    set(python_dir "lib/python${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR}/dist-packages")
endif()
install(DIRECTORY "${PROJECT_BINARY_DIR}/python/grainfall" DESTINATION "${python_dir}"
        FILES_MATCHING PATTERN "*.py" PATTERN "__pycache__" EXCLUDE)
install(TARGETS grainfall_core LIBRARY DESTINATION "${python_dir}/grainfall")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/scenarios" DESTINATION share/grainfall FILES_MATCHING PATTERN "*.py")
install(FILES "${PROJECT_SOURCE_DIR}/README.md" "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION share/doc/grainfall)

grainfall_add_femlink_module(wall)
# The explicit continuum's cell loops take half as long again at -O2.
target_compile_options(grainfall_femlink_wall PRIVATE -fno-math-errno $<$<CONFIG:Release>:-O3>)
if(GRAINFALL_CONTINUUM)
    grainfall_add_femlink_module(continuum grainfall_continuum)
endif()
