@banner@
#include "@name@_casadi.h"
#include "arboc/scalar.h"

// A constant of the model, in the precision of the build.
#define K(x) ((casadi_real)(x))

@parts@int @symbol@(const casadi_real** arg, casadi_real** res, casadi_int* iw, casadi_real* w, int mem) {
@body@}

@patterns@
casadi_int @symbol@_n_in(void) { return @n_in@; }
casadi_int @symbol@_n_out(void) { return @n_out@; }
casadi_real @symbol@_default_in(casadi_int i) {
  (void)i;
  return 0;
}
const char* @symbol@_name_in(casadi_int i) {
  static const char* const names[] = {@names_in@};
  return i < 0 || i >= @n_in@ ? 0 : names[i];
}
const char* @symbol@_name_out(casadi_int i) {
  static const char* const names[] = {@names_out@};
  return i < 0 || i >= @n_out@ ? 0 : names[i];
}
const casadi_int* @symbol@_sparsity_in(casadi_int i) {
  static const casadi_int* const patterns[] = {@patterns_in@};
  return i < 0 || i >= @n_in@ ? 0 : patterns[i];
}
const casadi_int* @symbol@_sparsity_out(casadi_int i) {
  static const casadi_int* const patterns[] = {@patterns_out@};
  return i < 0 || i >= @n_out@ ? 0 : patterns[i];
}
int @symbol@_work(casadi_int* sz_arg, casadi_int* sz_res, casadi_int* sz_iw, casadi_int* sz_w) {
  if (sz_arg) *sz_arg = @symbol@_SZ_ARG;
  if (sz_res) *sz_res = @symbol@_SZ_RES;
  if (sz_iw) *sz_iw = @symbol@_SZ_IW;
  if (sz_w) *sz_w = @symbol@_SZ_W;
  return 0;
}
int @symbol@_alloc_mem(void) { return 0; }
int @symbol@_init_mem(int mem) {
  (void)mem;
  return 0;
}
void @symbol@_free_mem(int mem) { (void)mem; }
int @symbol@_checkout(void) { return 0; }
void @symbol@_release(int mem) { (void)mem; }
void @symbol@_incref(void) {}
void @symbol@_decref(void) {}
