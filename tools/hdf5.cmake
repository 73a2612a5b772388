# The library hdf5_and_hl: HDF5, and its part for dimension scales. Debian's shared HDF5 brings 30 more libraries (curl,
# Kerberos, LDAP, for files in the cloud). Loading them takes longer than a short command, so a program may ask for the
# static one by its property STATIC_HDF5. What is loaded into other programs must not: they may have an HDF5 of their own.
if(NOT HDF5_INCLUDE_DIR OR NOT HDF5_LIBRARY OR NOT HDF5_HL_LIBRARY)
  return()  # tools/needs.cmake says so
endif()

# Its headers and its library may come from two prefixes. Then the program would build, but HDF5 would stop it.
file(STRINGS ${HDF5_INCLUDE_DIR}/H5public.h HDF5_VERSION REGEX "^#define +H5_VERS_INFO ")
string(REGEX REPLACE "^[^\"]*\"([^\"]*)\".*" "\\1" HDF5_VERSION "${HDF5_VERSION}")
file(STRINGS ${HDF5_LIBRARY} same REGEX "${HDF5_VERSION}" LIMIT_COUNT 1)
if(NOT same)
  message(FATAL_ERROR "${HDF5_LIBRARY} is not \"${HDF5_VERSION}\", but the headers in ${HDF5_INCLUDE_DIR} are.\n"
                      "Name those that belong together: -DHDF5_INCLUDE_DIR=, -DHDF5_LIBRARY=, -DHDF5_HL_LIBRARY=.")
endif()
file(STRINGS ${HDF5_INCLUDE_DIR}/H5pubconf.h parallel REGEX "^#define +H5_HAVE_PARALLEL ")
if(parallel)
  message(FATAL_ERROR "The HDF5 of ${HDF5_INCLUDE_DIR} is parallel (MPI). sandstroke needs a serial one: put its prefix "
                      "first in CMAKE_PREFIX_PATH, or name it by -DHDF5_INCLUDE_DIR=, -DHDF5_LIBRARY=, -DHDF5_HL_LIBRARY=.")
endif()

cmake_path(GET HDF5_LIBRARY PARENT_PATH beside)
find_library(HDF5_STATIC_LIBRARY libhdf5.a PATHS ${beside} NO_DEFAULT_PATH)
find_library(HDF5_HL_STATIC_LIBRARY libhdf5_hl.a PATHS ${beside} NO_DEFAULT_PATH)
find_library(SZIP_LIBRARY NAMES libsz.a sz HINTS ${beside})  # and what the static ones may need
find_library(AEC_LIBRARY NAMES libaec.a aec HINTS ${beside})
set(shared ${HDF5_HL_LIBRARY} ${HDF5_LIBRARY})
set(static ${shared})
if(HDF5_STATIC_LIBRARY AND HDF5_HL_STATIC_LIBRARY AND ZLIB_FOUND AND NOT SANDSTROKE_SANITIZE)  # tests/leaks.supp names the shared one
  set(needed ${SZIP_LIBRARY} ${AEC_LIBRARY})
  list(FILTER needed EXCLUDE REGEX NOTFOUND)
  list(APPEND needed ZLIB::ZLIB m ${CMAKE_DL_LIBS})
  try_compile(HDF5_STATIC_LINKS
              SOURCE_FROM_CONTENT main.c "#include <hdf5_hl.h>\nint main(void) { return H5LTpath_valid(-1, \"\", 0); }\n"
              SOURCES ${PROJECT_SOURCE_DIR}/tools/hdf5_without_s3.c
              CMAKE_FLAGS -DINCLUDE_DIRECTORIES=${HDF5_INCLUDE_DIR}
              LINK_LIBRARIES ${HDF5_HL_STATIC_LIBRARY} ${HDF5_STATIC_LIBRARY} ${needed})
  if(HDF5_STATIC_LINKS)
    add_library(sandstroke_hdf5_without_s3 STATIC tools/hdf5_without_s3.c)
    set(static ${HDF5_HL_STATIC_LIBRARY} ${HDF5_STATIC_LIBRARY} sandstroke_hdf5_without_s3 ${needed})
  else()
    message(STATUS "The program loads the shared HDF5, because ${HDF5_STATIC_LIBRARY} cannot be linked")
  endif()
endif()
add_library(hdf5_and_hl INTERFACE)
target_include_directories(hdf5_and_hl SYSTEM INTERFACE ${HDF5_INCLUDE_DIR})
target_link_libraries(hdf5_and_hl INTERFACE "$<IF:$<BOOL:$<TARGET_PROPERTY:STATIC_HDF5>>,${static},${shared}>")
