# The library hdf5_and_hl: HDF5, and its part for dimension scales. Debian's shared HDF5 brings 30 more libraries (curl,
# Kerberos, LDAP, for files in the cloud). Loading them takes longer than a short command, so a program may ask for the
# static one by its property STATIC_HDF5. What is loaded into other programs must not: they may have an HDF5 of their own.
find_library(HDF5_STATIC_LIBRARY libhdf5.a HINTS ${HDF5_LIBRARY_DIRS})
find_library(HDF5_HL_STATIC_LIBRARY libhdf5_hl.a HINTS ${HDF5_LIBRARY_DIRS})
find_library(SZIP_LIBRARY NAMES libsz.a sz HINTS ${HDF5_LIBRARY_DIRS})  # and what the static ones need
find_library(AEC_LIBRARY NAMES libaec.a aec HINTS ${HDF5_LIBRARY_DIRS})
set(shared ${HDF5_HL_LIBRARY} PkgConfig::HDF5)
set(static ${shared})
if(HDF5_STATIC_LIBRARY AND HDF5_HL_STATIC_LIBRARY AND SZIP_LIBRARY AND AEC_LIBRARY AND ZLIB_FOUND AND NOT SANDSTROKE_SANITIZE)  # tests/leaks.supp names the shared one
  include(CheckSourceCompiles)
  set(CMAKE_REQUIRED_INCLUDES ${HDF5_INCLUDE_DIRS})
  set(CMAKE_REQUIRED_LIBRARIES ${HDF5_HL_STATIC_LIBRARY} ${HDF5_STATIC_LIBRARY} ${SZIP_LIBRARY} ${AEC_LIBRARY} ZLIB::ZLIB m ${CMAKE_DL_LIBS})
  check_source_compiles(C "#include <hdf5_hl.h>\nint main(void) { return H5LTpath_valid(-1, \"\", 0); }" HDF5_STATIC_LINKS)
  if(HDF5_STATIC_LINKS)
    set(static ${CMAKE_REQUIRED_LIBRARIES})
  endif()
  unset(CMAKE_REQUIRED_INCLUDES)
  unset(CMAKE_REQUIRED_LIBRARIES)
endif()
add_library(hdf5_and_hl INTERFACE)
target_include_directories(hdf5_and_hl SYSTEM INTERFACE ${HDF5_INCLUDE_DIRS})
target_link_libraries(hdf5_and_hl INTERFACE "$<IF:$<BOOL:$<TARGET_PROPERTY:STATIC_HDF5>>,${static},${shared}>")
