// arboc::sincos as users compile it: with fused multiply-adds that the compiler may form at will,
// and without the instruction.
#pragma once

namespace arboc::test {

/// Compiled with -mfma -ffp-contract=fast where that exists.
void sincos_fused(double x, double& sine, double& cosine);
/// Compiled with the flags of the other tests.
void sincos_plain(double x, double& sine, double& cosine);

struct SincosBuild {
  const char* name;
  void (*sincos)(double, double&, double&);
  bool (*runs)();
};

inline bool machine_has_fma() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("fma");
#else
  return true;
#endif
}

inline constexpr SincosBuild kSincosBuilds[] = {
    {"Fused", sincos_fused, machine_has_fma},
    {"Plain", sincos_plain, [] { return true; }},
};

}  // namespace arboc::test
