# Installs the remaining files (beside program, manual and libraries), and makes Debian packages of all (tools/package).
include(GNUInstallDirs)
set(doc ${CMAKE_INSTALL_DATAROOTDIR}/doc)
install(FILES README.md DESTINATION ${doc}/sandstroke COMPONENT program)
install(DIRECTORY strokes/ DESTINATION ${doc}/sandstroke/examples COMPONENT program)
# Debian has the texts of common licences. It requires one file that says which licence applies to which files.
install(FILES LICENSE src/report/assets/echarts.LICENSE src/report/assets/echarts.NOTICE src/lettering/futural.NOTICE
        DESTINATION ${doc}/sandstroke COMPONENT licences)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The sandstroke authors <maintainers@sandstroke.invalid>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program development)
if(SANDSTROKE_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python_debian)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME sandstroke)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
if(SANDSTROKE_GL STREQUAL "egl" OR NOT TARGET sandstroke_osmesa)  # the drawing library is loaded at run time, unseen by dpkg-shlibdeps
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS libgl1-mesa-dri)
else()
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS libosmesa6)
endif()
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "ffmpeg, hershey-fonts-data")  # films; more fonts for scripts
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "Plays scripted or recorded strokes through a bed of sand: a stroke goes in;
a height field, a force trace, a picture and a verdict come out, the same
bits for the same input. Needs neither a screen nor the haptic device.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libsandstroke-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "libeigen3-dev, libspdlog-dev, libtbb-dev, libhwy-dev")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "For programs of your own: the simulation (sand, haptics, sim) as static
libraries, with headers and a CMake package.")

set(CPACK_DEBIAN_PYTHON_DEBIAN_PACKAGE_NAME python3-sandstroke)
set(CPACK_DEBIAN_PYTHON_DEBIAN_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_DEBIAN_PACKAGE_RECOMMENDS "python3-xarray, python3-matplotlib")
set(CPACK_DEBIAN_PYTHON_DEBIAN_DESCRIPTION "The simulation of sandstroke as a Python module: runs of strokes through
sand, a device that is stepped tick by tick, and pictures, as NumPy arrays.")
if(SANDSTROKE_PYTHON)
  math(EXPR next "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_DEBIAN_PACKAGE_DEPENDS "python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}), \
python3 (<< ${Python_VERSION_MAJOR}.${next}), python3-numpy, ${CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS}")
endif()

configure_file(tools/debian/changelog.in changelog @ONLY)
execute_process(COMMAND ${GZIP} -9nc changelog OUTPUT_FILE changelog.gz WORKING_DIRECTORY ${PROJECT_BINARY_DIR})
foreach(component PROGRAM DEVELOPMENT PYTHON_DEBIAN)
  string(TOLOWER ${component} lower)
  install(FILES tools/debian/copyright ${PROJECT_BINARY_DIR}/changelog.gz
          DESTINATION ${doc}/${CPACK_DEBIAN_${component}_PACKAGE_NAME} COMPONENT ${lower})
endforeach()
include(CPack)
