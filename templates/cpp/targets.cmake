add_library(@name@ STATIC
@sources@)
add_library(@name@::@name@ ALIAS @name@)
target_compile_features(@name@ PUBLIC cxx_std_17)
target_include_directories(@name@ PUBLIC ${CMAKE_CURRENT_SOURCE_DIR}/.. ${CMAKE_CURRENT_SOURCE_DIR})
# Straight-line code: vectorising it across statements only costs time.
target_compile_options(@name@ PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fno-tree-vectorize>)
find_package(Eigen3 QUIET NO_MODULE)
if(TARGET Eigen3::Eigen)
  target_link_libraries(@name@ PUBLIC Eigen3::Eigen)
endif()

option(@NAME@_SELFTEST "build @name@_selftest" ${@NAME@_TOP_LEVEL})
if(@NAME@_SELFTEST)
  add_executable(@name@_selftest @name@_selftest.cpp)
  target_link_libraries(@name@_selftest PRIVATE @name@::@name@)
  enable_testing()
  add_test(NAME @name@_selftest COMMAND @name@_selftest)
endif()
