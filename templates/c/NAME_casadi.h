@banner@
//
// The functions of @name@ in C99, called as CasADi calls external functions:
//
//   int f(const casadi_real** arg, casadi_real** res, casadi_int* iw, casadi_real* w, int mem);
//
// arg[i] is input i, or null for zeros; res[k] receives output k, or is null if it is not wanted; w
// is room for f_SZ_W numbers.  Matrices are whole and by columns: the non-zeros that
// f_sparsity_out(k) lists.  Inputs, outputs and w must not overlap.  No state, no allocation; any
// thread.  Returns 0, or what the function says of a value that must be positive and is not.
//
// jac_f, the Jacobian, has the inputs of f and its outputs, which it does not look at; output
// i + k * f_n_in() is the derivative of output k by input i, entry by entry.
#ifndef @NAME@_CASADI_H
#define @NAME@_CASADI_H

#include "arboc/casadi.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { @name@_nq = @nq@, @name@_nv = @nv@ };

@declarations@#ifdef __cplusplus
}
#endif

#endif
