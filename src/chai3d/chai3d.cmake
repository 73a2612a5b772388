# CHAI3D as chai3d_system, found where somebody has built it (src/record/README.md says how). The repository has nothing
# of it.
set(given "${chai3d_DIR}")
find_package(chai3d CONFIG QUIET)  # lower case, and without a version: its version file is malformed
if(NOT chai3d_FOUND)
  message(FATAL_ERROR "SANDSTROKE_CHAI3D=ON needs CHAI3D, which is not in chai3d_DIR=\"${given}\": give the folder in "
                      "which it was built, with its chai3dConfig.cmake, as -Dchai3d_DIR=FOLDER")
endif()
get_target_property(chai3d_archive chai3d LOCATION)
if(NOT EXISTS "${chai3d_archive}")
  message(FATAL_ERROR "CHAI3D is configured but not built in ${chai3d_DIR}: build its target chai3d first")
endif()
find_library(CHAI3D_DRD_LIBRARY drd HINTS ${CHAI3D_LIBRARY_DIRS} REQUIRED)
find_library(CHAI3D_USB_LIBRARY usb-1.0 REQUIRED)

add_library(chai3d_system INTERFACE)
# Only CHAI3D's own headers: all of them would bring a second Eigen.
target_include_directories(chai3d_system SYSTEM INTERFACE ${CHAI3D_SOURCE_DIR}/src ${CHAI3D_SOURCE_DIR}/externals/DHD/include)
# CHAI3D was compiled with LINUX, but its package does not say so. Without it classes have other sizes.
target_compile_definitions(chai3d_system INTERFACE LINUX)
# Not all of CHAI3D_LIBRARIES: devices do not need the parts with OpenGL and sound.
target_link_libraries(chai3d_system INTERFACE chai3d ${CHAI3D_DRD_LIBRARY} ${CHAI3D_USB_LIBRARY} pthread dl)
