# arboc_add_model(NAME MODEL file.urdf [FUNCTIONS f...] [BASE fixed|floating] [OPTIONS o...]
#                 [DEPENDS file...] [SELFTEST])
#
# Compiles a model when the project is built, and gives the target NAME::NAME: link it and include
# <NAME/NAME.hpp>.
#
#   FUNCTIONS  as --functions takes them, separated by blanks: rnea crba ..., dynamics (the default)
#              or all
#   BASE       how the root link is attached to the world: --base
#   OPTIONS    any other options of `arboc compile`: --frames flange --jacobian rnea.tau:q
#   DEPENDS    further files on which the result depends
#   SELFTEST   builds the self-test as well and adds it to CTest
#
# The code is generated anew when the model, what is asked for, or arboc itself has changed; files
# whose bytes stay the same are left alone, so that only what changed is compiled.
include_guard(GLOBAL)
include("${CMAKE_CURRENT_LIST_DIR}/arbocFiles.cmake")

# Everything that is written to the folder, relative to it.
function(arboc_files name functions result)
  set(files ${name}.hpp ${name}_raw.hpp ${name}_batch.hpp ${name}_selftest.cpp CMakeLists.txt
      manifest.json)
  foreach(function IN LISTS functions)
    list(APPEND files ${name}_${function}.hpp ${name}_${function}_double.cpp)
  endforeach()
  list(TRANSFORM ARBOC_RUNTIME_HEADERS PREPEND arboc/ OUTPUT_VARIABLE headers)
  set(${result} ${files} ${headers} PARENT_SCOPE)
endfunction()

# Checks the arguments of arboc_add_model, which are those of the caller.
macro(arboc_check_arguments)
  if(NOT name MATCHES "^[A-Za-z](_?[A-Za-z0-9])*$")
    message(FATAL_ERROR "arboc_add_model: '${name}' is no name for code: letters, digits and single "
                        "underscores, a letter first")
  endif()
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
  cmake_parse_arguments(PARSE_ARGV 1 arg "SELFTEST" "MODEL;BASE" "FUNCTIONS;OPTIONS;DEPENDS")
  arboc_check_arguments()
  set(include "${CMAKE_CURRENT_BINARY_DIR}/generated")
  set(folder "${include}/${name}")
  arboc_function_names("${arg_FUNCTIONS}" "${arg_OPTIONS}" functions)
  arboc_files(${name} "${functions}" files)
  list(TRANSFORM files PREPEND "${folder}/")
  list(JOIN functions "," list)

  set(command compile "${model}" --name ${name} -o "${include}")
  if(arg_FUNCTIONS)
    list(JOIN arg_FUNCTIONS "," list)
    list(APPEND command --functions ${list})
  endif()
  if(arg_BASE)
    list(APPEND command --base ${arg_BASE})
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

  set(sources ${functions})
  list(TRANSFORM sources REPLACE "(.+)" "${folder}/${name}_\\1_double.cpp")
  add_library(${name} STATIC ${sources} "${stamp}")
  add_library(${name}::${name} ALIAS ${name})
  target_compile_features(${name} PUBLIC cxx_std_17)
  target_include_directories(${name} PUBLIC "${include}" "${folder}")
  set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  # Straight-line code: vectorising it across statements only costs time.
  target_compile_options(${name} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fno-tree-vectorize>)
  find_package(Eigen3 QUIET NO_MODULE)
  if(TARGET Eigen3::Eigen)
    target_link_libraries(${name} PUBLIC Eigen3::Eigen)
  endif()
  if(arg_SELFTEST)
    add_executable(${name}_selftest "${folder}/${name}_selftest.cpp")
    target_link_libraries(${name}_selftest PRIVATE ${name}::${name})
    add_test(NAME ${name}_selftest COMMAND ${name}_selftest)
  endif()
endfunction()
