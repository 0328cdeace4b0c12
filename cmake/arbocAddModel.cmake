# arboc_add_model(NAME MODEL file.urdf [FUNCTIONS f...] [BASE fixed|floating] [TARGETS cpp c]
#                 [SCALARS s...] [OPTIONS o...] [DEPENDS file...] [SELFTEST])
#
# Compiles a model when the project is built, and gives the target NAME::NAME: link it and include
# <NAME/NAME.hpp>; of TARGETS c NAME::c and <NAME/NAME_casadi.h>.
#
#   FUNCTIONS  as --functions takes them, separated by blanks: rnea crba ..., dynamics (the default)
#              or all
#   BASE       how the root link is attached to the world: --base
#   TARGETS    languages: --target; cpp is the default
#   OPTIONS    any other options of `arboc compile`: --frames flange --jacobian rnea.tau:q
#   SCALARS    float, double8, float16 ...: a translation unit for each besides that for double
#   DEPENDS    further files on which the result depends
#   SELFTEST   builds the self-test as well and adds it to CTest
#
# The code is generated anew when the model, what is asked for, or arboc itself has changed; files
# whose bytes stay the same are left alone, so that only what changed is compiled.
include_guard(GLOBAL)

# Everything that is written to the folder, relative to it.
function(arboc_files name functions targets result)
  set(files CMakeLists.txt manifest.json)
  set(headers)
  if("cpp" IN_LIST targets)
    list(APPEND files ${name}.hpp ${name}_raw.hpp ${name}_batch.hpp ${name}_selftest.cpp)
    foreach(function IN LISTS functions)
      list(APPEND files ${name}_${function}.hpp ${name}_${function}_double.cpp)
    endforeach()
    list(APPEND headers ${ARBOC_RUNTIME_HEADERS})
  endif()
  if("c" IN_LIST targets)
    list(APPEND files ${name}_casadi.h)
    foreach(function IN LISTS functions)
      list(APPEND files ${name}_${function}.c)
      if(function IN_LIST ARBOC_FUNCTIONS AND NOT function MATCHES "_(derivatives|hessian)$")
        list(APPEND files jac_${name}_${function}.c)
      endif()
    endforeach()
    list(APPEND headers ${ARBOC_C_RUNTIME_HEADERS})
  endif()
  list(TRANSFORM headers PREPEND arboc/)
  set(${result} ${files} ${headers} PARENT_SCOPE)
endfunction()

# Straight-line code: vectorising it across statements only costs time.
function(arboc_set_properties target include name)
  target_include_directories(${target} PUBLIC "${include}" "${include}/${name}")
  add_dependencies(${target} ${name}_generate)
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_compile_options(${target} PRIVATE
    $<$<OR:$<CXX_COMPILER_ID:GNU>,$<C_COMPILER_ID:GNU>>:-fno-tree-vectorize>)
endfunction()

# NAME::NAME of the sources that end in .cpp, but for the self-test.
function(arboc_add_cpp name include files)
  list(FILTER files INCLUDE REGEX "_(double|float)[0-9]*\\.cpp$")
  add_library(${name} STATIC ${files})
  add_library(${name}::${name} ALIAS ${name})
  target_compile_features(${name} PUBLIC cxx_std_17)
  arboc_set_properties(${name} "${include}" ${name})
  find_package(Eigen3 QUIET NO_MODULE)
  if(TARGET Eigen3::Eigen)
    target_link_libraries(${name} PUBLIC Eigen3::Eigen)
  endif()
endfunction()

# NAME::c of the sources that end in .c.
function(arboc_add_c name include files)
  get_property(languages GLOBAL PROPERTY ENABLED_LANGUAGES)
  if(NOT "C" IN_LIST languages)
    message(FATAL_ERROR "arboc_add_model(${name} ... TARGETS c): the project has to enable C: "
                        "project(... LANGUAGES C CXX)")
  endif()
  list(FILTER files INCLUDE REGEX "\\.c$")
  add_library(${name}_c SHARED ${files})
  add_library(${name}::c ALIAS ${name}_c)
  set_target_properties(${name}_c PROPERTIES C_STANDARD 99)
  arboc_set_properties(${name}_c "${include}" ${name})
  target_link_libraries(${name}_c PUBLIC m)
endfunction()

# Checks the arguments of arboc_add_model, which are those of the caller.
macro(arboc_check_arguments)
  if(NOT name MATCHES "^[A-Za-z](_?[A-Za-z0-9])*$")
    message(FATAL_ERROR "arboc_add_model: '${name}' is no name for code: letters, digits and single "
                        "underscores, a letter first")
  endif()
  foreach(target IN LISTS arg_TARGETS)
    if(NOT target MATCHES "^(cpp|c)$")
      message(FATAL_ERROR "arboc_add_model(${name}): TARGETS are cpp and c, not ${target}")
    endif()
  endforeach()
  if(arg_UNPARSED_ARGUMENTS OR arg_KEYWORDS_MISSING_VALUES)
    message(FATAL_ERROR "arboc_add_model(${name}): wrong arguments: ${arg_UNPARSED_ARGUMENTS} "
                        "${arg_KEYWORDS_MISSING_VALUES}")
  endif()
  if(NOT arg_MODEL)
    message(FATAL_ERROR "arboc_add_model(${name}): MODEL file is missing")
  endif()
  get_filename_component(model "${arg_MODEL}" ABSOLUTE BASE_DIR "${CMAKE_CURRENT_SOURCE_DIR}")
endmacro()

function(arboc_add_model name)
  include("${CMAKE_CURRENT_FUNCTION_LIST_DIR}/arbocFiles.cmake")
  cmake_parse_arguments(PARSE_ARGV 1 arg "SELFTEST" "MODEL;BASE"
                        "FUNCTIONS;TARGETS;SCALARS;OPTIONS;DEPENDS")
  arboc_check_arguments()
  if(NOT arg_TARGETS)
    set(arg_TARGETS cpp)
  endif()
  set(include "${CMAKE_CURRENT_BINARY_DIR}/generated")
  set(folder "${include}/${name}")
  arboc_function_names("${arg_FUNCTIONS}" "${arg_OPTIONS}" functions)
  arboc_files(${name} "${functions}" "${arg_TARGETS}" files)
  if("cpp" IN_LIST arg_TARGETS)
    foreach(scalar IN LISTS arg_SCALARS)
      foreach(function IN LISTS functions)
        list(APPEND files ${name}_${function}_${scalar}.cpp)
      endforeach()
    endforeach()
  endif()
  list(REMOVE_DUPLICATES files)
  list(TRANSFORM files PREPEND "${folder}/")

  set(command compile "${model}" --name ${name} -o "${include}")
  if(arg_FUNCTIONS)
    list(JOIN arg_FUNCTIONS "," list)
    list(APPEND command --functions ${list})
  endif()
  if(arg_BASE)
    list(APPEND command --base ${arg_BASE})
  endif()
  if(NOT arg_TARGETS STREQUAL "cpp")
    list(JOIN arg_TARGETS "," list)
    list(APPEND command --target ${list})
  endif()
  if(arg_SCALARS)
    list(JOIN arg_SCALARS "," list)
    list(APPEND command --scalars ${list})
  endif()
  list(APPEND command ${arg_OPTIONS})
  # A file that changes with the command, for generators that do not look at it.
  set(options "${CMAKE_CURRENT_BINARY_DIR}/${name}.options")
  file(GENERATE OUTPUT "${options}" CONTENT "${command}\n")
  set(stamp "${CMAKE_CURRENT_BINARY_DIR}/${name}.stamp")
  add_custom_command(
    OUTPUT "${stamp}"
    BYPRODUCTS ${files}
    COMMAND arboc::arboc ${command} > "${CMAKE_CURRENT_BINARY_DIR}/${name}.summary"
    COMMAND "${CMAKE_COMMAND}" -E touch "${stamp}"
    DEPENDS "${model}" "${options}" "$<TARGET_FILE:arboc::arboc>" ${arg_DEPENDS}
    COMMENT "Compiling ${arg_MODEL} to ${name}"
    VERBATIM)
  add_custom_target(${name}_generate DEPENDS "${stamp}")

  if("c" IN_LIST arg_TARGETS)
    arboc_add_c(${name} "${include}" "${files}")
  endif()
  if(NOT "cpp" IN_LIST arg_TARGETS)
    return()
  endif()
  arboc_add_cpp(${name} "${include}" "${files}")
  if(arg_SELFTEST)
    add_executable(${name}_selftest "${folder}/${name}_selftest.cpp")
    target_link_libraries(${name}_selftest PRIVATE ${name}::${name})
    add_test(NAME ${name}_selftest COMMAND ${name}_selftest)
  endif()
endfunction()
