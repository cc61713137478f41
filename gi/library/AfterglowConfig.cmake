# find_package(Afterglow): the targets Afterglow::gi, a shared library, and Afterglow::gi_static.
include(CMakeFindDependencyMacro)
find_dependency(Vulkan)
include(${CMAKE_CURRENT_LIST_DIR}/AfterglowTargets.cmake)
