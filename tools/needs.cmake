# Looks for all that a build needs, before anything is compiled, and lists all missing packages at once. A part that is
# "auto" is left out where its packages are missing.
set(missing "")
set(missing_packages "")
file(READ tools/packages packages)

# sandstroke_needs(FOUND PACKAGE WHAT COMMAND): runs COMMAND, which looks for WHAT. If FOUND is then not true, Debian's
# PACKAGE is missing.
macro(sandstroke_needs found package what command)
  if(NOT packages MATCHES "\n[a-z]+ +${package} ")
    message(FATAL_ERROR "tools/packages does not list ${package} (tools/needs.cmake)")
  endif()
  cmake_language(EVAL CODE "${command}")
  if(NOT ${found})
    string(APPEND missing "\n  ${what}: ${package}")
    list(APPEND missing_packages ${package})
  endif()
endmacro()

sandstroke_needs(PKG_CONFIG_FOUND pkg-config "pkg-config (to find others)" "find_package(PkgConfig QUIET)")
sandstroke_needs(GZIP gzip "gzip (manuals)" "find_program(GZIP gzip)")
sandstroke_needs(Eigen3_FOUND libeigen3-dev "Eigen (arrays)" "find_package(Eigen3 NO_MODULE QUIET)")
sandstroke_needs(spdlog_FOUND libspdlog-dev "spdlog (messages)" "find_package(spdlog QUIET)")
sandstroke_needs(TBB_FOUND libtbb-dev "oneTBB (threads)" "find_package(TBB QUIET)")
sandstroke_needs(hwy_FOUND libhwy-dev "Highway (vector instructions)" "find_package(hwy QUIET)")
sandstroke_needs(CLI11_FOUND libcli11-dev "CLI11 (command lines)" "find_package(CLI11 QUIET)")
sandstroke_needs(tomlplusplus_FOUND libtomlplusplus-dev "toml++ (scenes)" "find_package(tomlplusplus QUIET)")
sandstroke_needs(nlohmann_json_FOUND nlohmann-json3-dev "nlohmann/json (pages)" "find_package(nlohmann_json QUIET)")
sandstroke_needs(PNG_FOUND libpng-dev "libpng (pictures)" "find_package(PNG QUIET)")
sandstroke_needs(ZLIB_FOUND zlib1g-dev "zlib (run files)" "find_package(ZLIB QUIET)")
# Not through pkg-config, for which HDF5's own "make install" leaves no file. Debian's libraries have names of their own.
sandstroke_needs(HDF5_INCLUDE_DIR libhdf5-dev "HDF5's headers (run files)"
                 "find_path(HDF5_INCLUDE_DIR hdf5_hl.h PATH_SUFFIXES hdf5/serial)")
sandstroke_needs(HDF5_LIBRARY libhdf5-dev "HDF5 (run files)"
                 "find_library(HDF5_LIBRARY NAMES hdf5_serial hdf5 NAMES_PER_DIR)")
sandstroke_needs(HDF5_HL_LIBRARY libhdf5-dev "HDF5's high-level library (dimension scales)"
                 "find_library(HDF5_HL_LIBRARY NAMES hdf5_serial_hl hdf5_hl NAMES_PER_DIR)")
include(tools/hdf5.cmake)

# Mesa's llvmpipe draws the pictures, through OSMesa (gone since Mesa 25.1) or EGL. One of the two is enough.
pkg_check_modules(OSMESA QUIET IMPORTED_TARGET osmesa)
pkg_check_modules(EGL QUIET IMPORTED_TARGET egl)
if(SANDSTROKE_GL STREQUAL "osmesa")
  sandstroke_needs(OSMESA_FOUND libosmesa6-dev "OSMesa (pictures)" "")
elseif(SANDSTROKE_GL STREQUAL "egl" OR NOT OSMESA_FOUND)
  sandstroke_needs(EGL_FOUND libegl-dev "EGL (pictures)" "")
endif()

# Between these two, what is missing concerns only a part: where its option is "auto", the part is then left out. The
# option is ON or OFF from there on.
macro(sandstroke_begin_part)
  set(missing_before "${missing}")
  set(packages_before "${missing_packages}")
  set(missing "")
  set(missing_packages "")
endmacro()
macro(sandstroke_end_part option what)
  if(missing AND NOT ${option} STREQUAL "auto")
    string(APPEND missing "\n  (-D${option}=OFF leaves these out)")
  elseif(${option} STREQUAL "auto")
    set(${option} ON)
    if(missing)
      message(STATUS "${what} left out, for want of${missing}\n   (-D${option}=ON insists on them)")
      set(${option} OFF)
      set(missing "")
      set(missing_packages "")
    endif()
  endif()
  set(missing "${missing_before}${missing}")
  list(PREPEND missing_packages ${packages_before})
endmacro()

sandstroke_begin_part()
if(SANDSTROKE_IMPORT)  # also "auto"
  sandstroke_needs(TIFF_FOUND libtiff-dev "libtiff 4.5 (maps of heights)" "pkg_check_modules(TIFF QUIET IMPORTED_TARGET libtiff-4>=4.5)")
  sandstroke_needs(SQLITE_FOUND libsqlite3-dev "SQLite (ROS 2 bags)" "pkg_check_modules(SQLITE QUIET IMPORTED_TARGET sqlite3)")
  sandstroke_needs(LZ4_FOUND liblz4-dev "LZ4 (MCAP, ROS 1 bags)" "pkg_check_modules(LZ4 QUIET IMPORTED_TARGET liblz4)")
  sandstroke_needs(ZSTD_FOUND libzstd-dev "Zstandard (MCAP)" "pkg_check_modules(ZSTD QUIET IMPORTED_TARGET libzstd)")
  sandstroke_needs(BZIP2_FOUND libbz2-dev "bzip2 (ROS 1 bags)" "find_package(BZip2 QUIET)")
  sandstroke_needs(PUGIXML_FOUND libpugixml-dev "pugixml (InkML, SVG)" "pkg_check_modules(PUGIXML QUIET IMPORTED_TARGET pugixml)")
  sandstroke_needs(CSV_LIBRARY libcsv-dev "libcsv (tables)" "find_library(CSV_LIBRARY csv)")
  sandstroke_needs(DATE_INCLUDE_DIR libhowardhinnant-date-dev "date/date.h (ISO 8601)" "find_path(DATE_INCLUDE_DIR date/date.h)")
endif()
sandstroke_end_part(SANDSTROKE_IMPORT "Strokes and maps of other programs are")

sandstroke_begin_part()
if(SANDSTROKE_VIEW)
  sandstroke_needs(Boost_FOUND libboost-dev "Boost 1.74 (Beast and Asio: the live view)" "find_package(Boost 1.74 CONFIG QUIET)")
endif()
sandstroke_end_part(SANDSTROKE_VIEW "Recording and the live view are")
if(SANDSTROKE_CHAI3D AND NOT SANDSTROKE_VIEW)
  message(FATAL_ERROR "SANDSTROKE_CHAI3D records, which needs SANDSTROKE_VIEW=ON")
endif()

# sandstroke_rests_on(OPTION PARTS...): the part needs others.
macro(sandstroke_rests_on option)
  foreach(part ${ARGN})
    if(NOT ${part} AND ${option} STREQUAL "auto")
      message(STATUS "${option}=OFF, because of ${part}=OFF")
      set(${option} OFF)
    elseif(NOT ${part} AND ${option})
      message(FATAL_ERROR "${option}=ON needs ${part}=ON: -D${part}=ON names missing packages, -D${option}=OFF goes on without")
    endif()
  endforeach()
endmacro()
sandstroke_rests_on(SANDSTROKE_PYTHON SANDSTROKE_VALIDATION)
sandstroke_rests_on(SANDSTROKE_TESTS SANDSTROKE_IMPORT SANDSTROKE_VIEW SANDSTROKE_SWEEP SANDSTROKE_VALIDATION)

sandstroke_begin_part()
if(SANDSTROKE_PYTHON)
  # Prefers the system's, which has the packages for the tests, to others on the path; but not to conda's.
  if(NOT Python_EXECUTABLE AND EXISTS /usr/bin/python3 AND NOT DEFINED ENV{CONDA_PREFIX})
    set(Python_EXECUTABLE /usr/bin/python3)
  endif()
  sandstroke_needs(Python_FOUND python3-dev "Python 3.9 with its headers"
                   "find_package(Python 3.9 QUIET COMPONENTS Interpreter Development.Module)")
  sandstroke_needs(pybind11_FOUND pybind11-dev "pybind11 2.9"
                   "find_package(pybind11 2.9 CONFIG QUIET)")
endif()
sandstroke_end_part(SANDSTROKE_PYTHON "The Python module is")
if(SANDSTROKE_PYTHON AND NOT missing)
  message(STATUS "The Python module is for ${Python_EXECUTABLE} (${Python_VERSION}; -DPython_EXECUTABLE= names another)")
endif()

sandstroke_begin_part()
if(SANDSTROKE_TESTS)
  sandstroke_needs(MATIO_FOUND libmatio-dev "matio, which writes .mat"
                   "pkg_check_modules(MATIO QUIET IMPORTED_TARGET matio)")
  sandstroke_needs(GTest_FOUND libgtest-dev "googletest" "find_package(GTest QUIET)")
  sandstroke_needs(GMOCK_INCLUDE_DIR libgmock-dev "gmock/gmock.h"
                   "find_path(GMOCK_INCLUDE_DIR gmock/gmock.h)")
  if(NOT SANDSTROKE_SANITIZE)
    sandstroke_needs(benchmark_FOUND libbenchmark-dev "benchmark" "find_package(benchmark QUIET)")
  endif()
endif()
sandstroke_end_part(SANDSTROKE_TESTS "The tests are")

if(missing)
  list(REMOVE_DUPLICATES missing_packages)
  list(JOIN missing_packages " " missing_packages)
  message(FATAL_ERROR "sandstroke needs these missing packages (Debian's names):${missing}\n"
                      "apt-get install ${missing_packages}, or tools/setup, which installs all.")
endif()
