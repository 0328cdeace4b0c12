# What arboc knows and writes, for builds that must name files before they exist.  A test compares
# these lists with the program (tests/embed).

set(ARBOC_RUNTIME_HEADERS angles.hpp batch.hpp lanes.hpp math.hpp pack.hpp pack_math.hpp rows.hpp
    scalar.hpp team.hpp)
set(ARBOC_C_RUNTIME_HEADERS casadi.h scalar.h)

# `--functions dynamics`, which is the default, and `--functions all`.
set(ARBOC_DYNAMICS fk rnea gravity nle crba minv aba rnea_derivatives aba_derivatives)
set(ARBOC_FUNCTIONS fk rnea gravity statics nle crba minv aba rnea_derivatives aba_derivatives rnea_hessian
  frame_velocity frame_acceleration frame_jacobian frame_jacobian_dot frame_velocity_derivatives
  frame_acceleration_derivatives joint_jacobians transforms com com_jacobian centroidal energy regressor
  integrate difference integrate_derivatives difference_derivatives)

# `--jacobian rnea.tau:q,v` makes rnea_tau_jacobian_q_v.
function(arboc_derivative_name kind request result)
  string(REPLACE "^2" "2" name "${request}")
  if(NOT name MATCHES "^([^.:]+)\\.([^:]+)(:(.+))?$")
    message(FATAL_ERROR "arboc_add_model: --${kind} ${request}: not of the form FUNCTION.OUTPUT[:INPUT,...]")
  endif()
  set(name "${CMAKE_MATCH_1}_${CMAKE_MATCH_2}_${kind}")
  if(CMAKE_MATCH_4)
    string(REPLACE "," "_" inputs "${CMAKE_MATCH_4}")
    string(APPEND name "_${inputs}")
  endif()
  set(${result} "${name}" PARENT_SCOPE)
endfunction()

# The functions that `arboc compile --functions LIST OPTIONS...` writes; of no list the default.
function(arboc_function_names functions options result)
  set(names)
  foreach(function IN LISTS functions)
    if(function STREQUAL "all")
      list(APPEND names ${ARBOC_FUNCTIONS})
    elseif(function STREQUAL "dynamics")
      list(APPEND names ${ARBOC_DYNAMICS})
    else()
      list(APPEND names ${function})
    endif()
  endforeach()
  set(kind)
  foreach(option IN LISTS options)
    if(option MATCHES "^--(jacobian|gradient|vjp|hessian)(=(.*))?$")
      set(kind ${CMAKE_MATCH_1})
      if(NOT CMAKE_MATCH_2)
        continue()
      endif()
      set(option "${CMAKE_MATCH_3}")
    endif()
    if(kind AND NOT (kind STREQUAL "hessian" AND option MATCHES "^(iterated|symmetric)$"))
      arboc_derivative_name(${kind} "${option}" name)
      list(APPEND names ${name})
    endif()
    set(kind)
  endforeach()
  if(NOT names)
    set(names ${ARBOC_DYNAMICS})
  endif()
  list(REMOVE_DUPLICATES names)
  set(${result} "${names}" PARENT_SCOPE)
endfunction()
