// Translation units of other scalars: callers need the declarations only.
#include <gtest/gtest.h>

#include "support/run_program.h"
#include "support/temp_dir.h"

namespace arboc::test {
namespace {

/// Compares float and a pack with double; ends with 1 if they differ.
constexpr const char* kCaller = R"(
#include <ur5/ur5_raw.hpp>
#include <ur5/arboc/pack.hpp>
#include <cmath>
#include <cstdio>
using Pack = arboc::Pack<double, 4>;
int main() {
  double worst_float = 0, worst_pack = 0;
  Pack in[3][6], out[6];
  double x[3][6], tau[4][6];
  for (int lane = 0; lane < 4; ++lane) {
    float narrow[3][6], narrow_tau[6];
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 6; ++i) {
        x[k][i] = std::sin(1 + lane + 5 * k + 17 * i);
        narrow[k][i] = static_cast<float>(x[k][i]);
        in[k][i].set(lane, x[k][i]);
      }
    ur5::raw::rnea<double>(x[0], x[1], x[2], tau[lane]);
    ur5::raw::rnea<float>(narrow[0], narrow[1], narrow[2], narrow_tau);
    for (int i = 0; i < 6; ++i)
      worst_float = std::fmax(worst_float, std::fabs(narrow_tau[i] - tau[lane][i]));
  }
  ur5::raw::rnea<Pack>(in[0], in[1], in[2], out);
  for (int lane = 0; lane < 4; ++lane)
    for (int i = 0; i < 6; ++i)
      worst_pack = std::fmax(worst_pack, std::fabs(out[i][lane] - tau[lane][i]));
  std::printf("%g %g\n", worst_float, worst_pack);
  return !(worst_float < 1e-3 && worst_float > 0 && worst_pack < 1e-11);
}
)";

TEST(EmittedScalars, HaveTranslationUnitsOfTheirOwn) {
  const TempDir folder;
  const Outcome emitted =
      run_arboc({"compile", ARBOC_SOURCE_DIR "/models/ur5/ur5.urdf", "-o", folder.path(),
                 "--functions", "rnea", "--scalars", "float,double4"});
  ASSERT_EQ(emitted.status, 0) << emitted.err;
  EXPECT_NE(read_text(folder / "ur5/ur5_raw.hpp").find("// Option: --scalars float,double4"),
            std::string::npos);
  write_text(folder / "caller.cpp", kCaller);
  RunOptions options;
  options.folder = folder.path();
  const Outcome outcome = run_program(
      {"sh", "-c",
       "c++ -std=c++17 -Wall -Wextra -Werror -Wno-psabi -O1 -I. caller.cpp ur5/ur5_rnea_*.cpp -o "
       "caller && ./caller"},
      options);
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err.substr(0, 4000);
}

TEST(EmittedScalars, OthersAreRefused) {
  const Outcome outcome = run_arboc({"compile", ARBOC_SOURCE_DIR "/models/ur5/ur5.urdf", "-o",
                                     "/dev/null/out", "--scalars", "double3"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("with 2, 4, 8 or 16 behind it of packs, not double3"),
            std::string::npos)
      << outcome.err;
}

TEST(EmittedScalars, FunctionsKeepToTheLargestSizeAskedFor) {
  const auto parts = [](const std::string& size) {
    const std::string out =
        run_arboc({"compile", ARBOC_SOURCE_DIR "/models/ur5/ur5.urdf", "--functions",
                   "rnea_derivatives", "--print=program", "--max-function-size", size})
            .out;
    size_t count = 0;
    for (size_t at = 0; (at = out.find("\nchunk ", at)) != std::string::npos; ++at) ++count;
    return count;
  };
  EXPECT_EQ(parts("100000"), 1u);
  EXPECT_GT(parts("100"), parts("250"));
  EXPECT_GT(parts("250"), 1u);
}

}  // namespace
}  // namespace arboc::test
