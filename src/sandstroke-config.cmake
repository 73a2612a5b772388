# find_package(sandstroke): targets sandstroke::core, ::sand, ::haptics, ::sim and ::measure, each with what it links.
include(CMakeFindDependencyMacro)
foreach(dependency Eigen3 spdlog TBB hwy)
  find_dependency(${dependency} CONFIG)
endforeach()
include(${CMAKE_CURRENT_LIST_DIR}/sandstroke-targets.cmake)
