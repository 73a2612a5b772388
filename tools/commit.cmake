# The commit that is built, which goes into every file that the program writes, and its dates: SANDSTROKE_COMMIT,
# SANDSTROKE_COMMIT_DATE (2026-11-29) and SANDSTROKE_COMMIT_TIME (as e-mails have it). Configures again when HEAD moves.
find_package(Git QUIET)
if(GIT_FOUND AND EXISTS ${PROJECT_SOURCE_DIR}/.git)  # a file in a work tree of its own
  # sandstroke_git(VARIABLE ARGUMENTS...): what git prints.
  function(sandstroke_git variable)
    execute_process(COMMAND ${GIT_EXECUTABLE} -C ${PROJECT_SOURCE_DIR} ${ARGN}
                    OUTPUT_VARIABLE printed OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    set(${variable} "${printed}" PARENT_SCOPE)
  endfunction()
  sandstroke_git(head_log rev-parse --git-path logs/HEAD)
  cmake_path(ABSOLUTE_PATH head_log BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
  if(EXISTS ${head_log})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${head_log})
  endif()
  sandstroke_git(SANDSTROKE_COMMIT rev-parse --short=12 HEAD)
  sandstroke_git(SANDSTROKE_COMMIT_DATE log -1 --format=%cs)
  sandstroke_git(SANDSTROKE_COMMIT_TIME log -1 --format=%cD)
endif()
if(NOT SANDSTROKE_COMMIT)
  set(SANDSTROKE_COMMIT "unknown")
  string(TIMESTAMP SANDSTROKE_COMMIT_TIME "%a, %d %b %Y %H:%M:%S +0000" UTC)  # heeds SOURCE_DATE_EPOCH
endif()
