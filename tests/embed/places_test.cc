// Generated code on another scalar and in other places: an automatic-differentiation type, without
// exceptions, run-time types or an operating system, and for a microcontroller of single precision.
#include <gtest/gtest.h>

#include <sstream>

#include "support/run_program.h"

namespace arboc::test {
namespace {

using Command = std::vector<std::string>;

bool installed(const std::string& program) {
  return run_program({program, "--version"}).status == 0;
}

/// The arm in both languages.
void emit(const TempDir& folder) {
  const Outcome outcome = run_arboc({"compile", ARBOC_SOURCE_DIR "/models/ur5/ur5.urdf", "-o",
                                     folder.path(), "--target", "cpp,c", "--functions",
                                     "rnea,rnea_derivatives,aba,crba,integrate"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
}

void expect_success(const std::string& script, const TempDir& folder) {
  RunOptions options;
  options.folder = folder.path();
  const Outcome outcome = run_program({"sh", "-c", script}, options);
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err.substr(0, 4000);
}

/// Undefined symbols of the objects, sorted, but those of the objects themselves.
std::string needs(const std::string& nm, const TempDir& folder, const std::string& objects) {
  RunOptions options;
  options.folder = folder.path();
  const Outcome outcome = run_program(
      {"sh", "-c",
       nm + " --defined-only -P " + objects + " | cut -d' ' -f1 | sort -u > defined; " + nm +
           " --undefined-only -P " + objects +
           " | grep ' U' | cut -d' ' -f1 | sort -u | comm -23 - defined"},
      options);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  std::istringstream lines(outcome.out);
  std::string all;
  for (std::string symbol; lines >> symbol;) all += (all.empty() ? "" : " ") + symbol;
  return all;
}

/// Instantiations for a scalar of everything that was emitted.
std::string instances(const std::string& scalar) {
  const std::string s = scalar, in = "const " + s + "*", out = s + "*";
  return "#include <ur5/ur5_aba.hpp>\n#include <ur5/ur5_crba.hpp>\n#include <ur5/ur5_rnea.hpp>\n"
         "#include <ur5/ur5_rnea_derivatives.hpp>\n"
         "template void ur5::raw::rnea<" + s + ">(" + in + ", " + in + ", " + in + ", " + out +
         ") noexcept;\ntemplate void ur5::raw::crba<" + s + ">(" + in + ", " + out +
         ") noexcept;\ntemplate int ur5::raw::aba<" + s + ">(" + in + ", " + in + ", " + in + ", " +
         out + ") noexcept;\ntemplate void ur5::raw::rnea_derivatives<" + s + ">(" + in + ", " + in +
         ", " + in + ", " + out + ", " + out + ", " + out + ") noexcept;\n";
}

TEST(Scalars, MayBeEigensAutoDiff) {
  const TempDir folder;
  ASSERT_NO_FATAL_FAILURE(emit(folder));
  for (const std::string compiler : {"g++", "clang++"}) {
    if (!installed(compiler)) continue;
    expect_success(compiler +
                       " -std=c++17 -O0 -Wall -Wextra -Werror -I. -isystem '" ARBOC_EIGEN
                       "' '" ARBOC_SOURCE_DIR
                       "/tests/embed/scalars_autodiff.cpp' ur5/ur5_rnea_double.cpp "
                       "ur5/ur5_rnea_derivatives_double.cpp -o autodiff && ./autodiff",
                   folder);
  }
}

/// Nothing of the C++ library at run time, and of the C library sines and memory copies.
TEST(Places, NeedNoRuntimeOfCpp) {
  const TempDir folder;
  ASSERT_NO_FATAL_FAILURE(emit(folder));
  write_text(folder / "core.cpp", instances("double"));
  for (const std::string compiler : {"g++", "clang++"}) {
    if (!installed(compiler)) continue;
    expect_success(compiler +
                       " -std=c++17 -O2 -ffreestanding -fno-exceptions -fno-rtti -Wall -Wextra "
                       "-Werror -I. -c core.cpp -o core.o",
                   folder);
    std::istringstream symbols(needs("nm", folder, "core.o"));
    for (std::string symbol; symbols >> symbol;) {
      const bool known = symbol == "sin" || symbol == "cos" || symbol == "sincos" || symbol == "fabs" ||
                         symbol == "memcpy" || symbol == "memset" || symbol == "__stack_chk_fail" ||
                         symbol == "_GLOBAL_OFFSET_TABLE_";
      EXPECT_TRUE(known) << compiler << ": " << symbol;
    }
  }
}

/// A Cortex-M4, which has single precision in hardware: both languages compile, and nothing is left
/// that would compute in double by software (__aeabi_d...).
TEST(Places, AreMicrocontrollersToo) {
  if (!installed("arm-none-eabi-g++")) GTEST_SKIP() << "arm-none-eabi-g++ is not installed";
  const TempDir folder;
  ASSERT_NO_FATAL_FAILURE(emit(folder));
  write_text(folder / "core.cpp", instances("float"));
  const std::string machine = " -mcpu=cortex-m4 -mthumb -mfpu=fpv4-sp-d16 -mfloat-abi=hard -O2 ";
  expect_success("arm-none-eabi-g++" + machine +
                     "-std=c++17 -fno-exceptions -fno-rtti -Wall -Wextra -Wdouble-promotion -Werror "
                     "-I. -c core.cpp -o core.o",
                 folder);
  expect_success("arm-none-eabi-gcc" + machine +
                     "-std=c99 -ffp-contract=fast -Dcasadi_real=float -Wall -Wextra "
                     "-Wdouble-promotion -Werror -c ur5/*.c",
                 folder);
  for (const std::string objects : {"core.o", "*ur5_*.o"}) {
    std::istringstream symbols(needs("arm-none-eabi-nm", folder, objects));
    for (std::string symbol; symbols >> symbol;) {
      const bool known = symbol == "sinf" || symbol == "cosf" || symbol == "sincosf" ||
                         symbol == "sqrtf" || symbol == "memcpy" || symbol == "memset" ||
                         symbol == "__aeabi_memset" || symbol == "__aeabi_memcpy";
      EXPECT_TRUE(known) << objects << ": " << symbol;
    }
  }
  RunOptions there;
  there.folder = folder.path();
  RecordProperty("size", run_program({"arm-none-eabi-size", "core.o", "ur5_rnea.o"}, there).out);
}

}  // namespace
}  // namespace arboc::test
