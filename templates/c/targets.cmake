
# The functions in C under CasADi's convention: @name@::c, which casadi.external() loads too.
enable_language(C)
add_library(@name@_c SHARED
@sources@)
add_library(@name@::c ALIAS @name@_c)
set_target_properties(@name@_c PROPERTIES C_STANDARD 99)
target_include_directories(@name@_c PUBLIC ${CMAKE_CURRENT_SOURCE_DIR}/.. ${CMAKE_CURRENT_SOURCE_DIR})
target_compile_options(@name@_c PRIVATE $<$<C_COMPILER_ID:GNU>:-fno-tree-vectorize>)
target_link_libraries(@name@_c PUBLIC m)
