// What the C interface of generated code declares: the convention of CasADi's external functions.
//
// C99 and C++.  -Dcasadi_real=float makes everything single precision.
#ifndef ARBOC_CASADI_H
#define ARBOC_CASADI_H

#ifndef casadi_real
#define casadi_real double
#endif
#ifndef casadi_int
#define casadi_int long long int
#endif

#if defined(_WIN32)
#define ARBOC_EXPORT __declspec(dllexport)
#elif defined(__GNUC__)
#define ARBOC_EXPORT __attribute__((visibility("default")))
#else
#define ARBOC_EXPORT
#endif

// Declares f and what tells about it.
#define ARBOC_EXTERNAL(f)                                                                    \
  ARBOC_EXPORT int f(const casadi_real** arg, casadi_real** res, casadi_int* iw,             \
                     casadi_real* w, int mem);                                               \
  ARBOC_EXPORT casadi_int f##_n_in(void);                                                    \
  ARBOC_EXPORT casadi_int f##_n_out(void);                                                   \
  ARBOC_EXPORT casadi_real f##_default_in(casadi_int i);                                     \
  ARBOC_EXPORT const char* f##_name_in(casadi_int i);                                        \
  ARBOC_EXPORT const char* f##_name_out(casadi_int i);                                       \
  ARBOC_EXPORT const casadi_int* f##_sparsity_in(casadi_int i);                              \
  ARBOC_EXPORT const casadi_int* f##_sparsity_out(casadi_int i);                             \
  ARBOC_EXPORT int f##_work(casadi_int* sz_arg, casadi_int* sz_res, casadi_int* sz_iw,       \
                            casadi_int* sz_w);                                               \
  ARBOC_EXPORT int f##_alloc_mem(void);                                                      \
  ARBOC_EXPORT int f##_init_mem(int mem);                                                    \
  ARBOC_EXPORT void f##_free_mem(int mem);                                                   \
  ARBOC_EXPORT int f##_checkout(void);                                                       \
  ARBOC_EXPORT void f##_release(int mem);                                                    \
  ARBOC_EXPORT void f##_incref(void);                                                        \
  ARBOC_EXPORT void f##_decref(void)

#endif
