# The library hdf5_and_hl: HDF5, and its part for dimension scales. Debian's shared HDF5 brings 30 more libraries (curl,
# Kerberos, LDAP, for files in the cloud). Loading them takes longer than a short command, so a program may ask for the
# static one by its property STATIC_HDF5. What is loaded into other programs must not: they may have an HDF5 of their own.
if(NOT HDF5_INCLUDE_DIR OR NOT HDF5_LIBRARY OR NOT HDF5_HL_LIBRARY)
  return()  # tools/needs.cmake says so
endif()

# Forgets what was found, so that another HDF5 can be taken in the same build folder.
macro(sandstroke_refuse_hdf5 why)
  unset(HDF5_INCLUDE_DIR CACHE)
  unset(HDF5_LIBRARY CACHE)
  unset(HDF5_HL_LIBRARY CACHE)
  message(FATAL_ERROR "${why}\nPut another HDF5's prefix first in CMAKE_PREFIX_PATH, or name it by -DHDF5_INCLUDE_DIR=, "
                      "-DHDF5_LIBRARY= and -DHDF5_HL_LIBRARY=.")
endmacro()

# Its headers and its library may come from two prefixes. Then the program would build, but HDF5 would stop it.
file(STRINGS ${HDF5_INCLUDE_DIR}/H5public.h version REGEX "^#define +H5_VERS_INFO ")
string(REGEX REPLACE "^[^\"]*\"([^\"]*)\".*" "\\1" version "${version}")  # as in the library: "HDF5 library version: 1.10.8"
file(STRINGS ${HDF5_LIBRARY} same REGEX "${version}$" LIMIT_COUNT 1)
if(NOT same)
  string(REGEX REPLACE ".* " "" version "${version}")
  sandstroke_refuse_hdf5("${HDF5_INCLUDE_DIR} has the headers of HDF5 ${version}, but ${HDF5_LIBRARY} is of another version.")
endif()
file(STRINGS ${HDF5_INCLUDE_DIR}/H5pubconf.h parallel REGEX "^#define +H5_HAVE_PARALLEL ")
if(parallel)
  sandstroke_refuse_hdf5("The HDF5 of ${HDF5_INCLUDE_DIR} is parallel (MPI), but sandstroke needs a serial one.")
endif()

set(shared ${HDF5_HL_LIBRARY} ${HDF5_LIBRARY})
set(static ${shared})
set(HDF5_STATIC_LINKS OFF)
if(NOT SANDSTROKE_SANITIZE)  # tests/leaks.supp names the shared one
  cmake_path(REPLACE_EXTENSION HDF5_LIBRARY LAST_ONLY a OUTPUT_VARIABLE archive)
  cmake_path(REPLACE_EXTENSION HDF5_HL_LIBRARY LAST_ONLY a OUTPUT_VARIABLE hl_archive)
  cmake_path(GET HDF5_LIBRARY PARENT_PATH beside)
  find_library(SZIP_LIBRARY NAMES libsz.a sz HINTS ${beside})  # and what they may need
  find_library(AEC_LIBRARY NAMES libaec.a aec HINTS ${beside})
  set(needed ${SZIP_LIBRARY} ${AEC_LIBRARY})
  list(FILTER needed EXCLUDE REGEX NOTFOUND)
  list(APPEND needed ZLIB::ZLIB m ${CMAKE_DL_LIBS})
  if(EXISTS ${archive} AND EXISTS ${hl_archive} AND ZLIB_FOUND)
    try_compile(HDF5_STATIC_LINKS
                SOURCE_FROM_CONTENT main.c "#include <hdf5_hl.h>\nint main(void) { return H5LTpath_valid(-1, \"\", 0); }\n"
                SOURCES ${PROJECT_SOURCE_DIR}/tools/hdf5_without_s3.c
                CMAKE_FLAGS -DINCLUDE_DIRECTORIES=${HDF5_INCLUDE_DIR}
                LINK_LIBRARIES ${hl_archive} ${archive} ${needed}
                NO_CACHE)
  endif()
  if(HDF5_STATIC_LINKS)
    add_library(sandstroke_hdf5_without_s3 STATIC tools/hdf5_without_s3.c)
    set(static ${hl_archive} ${archive} sandstroke_hdf5_without_s3 ${needed})
  else()
    message(STATUS "The program loads the shared HDF5: ${archive} is not there, or cannot be linked")
  endif()
endif()
add_library(hdf5_and_hl INTERFACE)
target_include_directories(hdf5_and_hl SYSTEM INTERFACE ${HDF5_INCLUDE_DIR})
target_link_libraries(hdf5_and_hl INTERFACE "$<IF:$<BOOL:$<TARGET_PROPERTY:STATIC_HDF5>>,${static},${shared}>")
