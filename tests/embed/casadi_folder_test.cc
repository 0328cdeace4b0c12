// What is emitted in C, in other hands: in single precision, by its CMakeLists.txt, in CasADi
// itself.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>

#include "support/run_program.h"

namespace arboc::test {
namespace {

namespace fs = std::filesystem;
using Command = std::vector<std::string>;

bool installed(const std::string& compiler) {
  return run_program({compiler, "--version"}).status == 0;
}

/// Single precision is only that: no number of the model in double.
TEST(CInterfaceSingle, IsClean) {
  const TempDir folder;
  ASSERT_EQ(run_arboc({"compile", ARBOC_SOURCE_DIR "/models/ur5/ur5.urdf", "-o", folder.path(),
                       "--target", "c", "--functions", "rnea,aba,integrate"})
                .status,
            0);
  for (const auto& file : fs::directory_iterator(folder / "ur5")) {
    if (file.path().extension() != ".c") continue;
    for (const std::string compiler : {"gcc", "clang"}) {
      if (!installed(compiler)) continue;
      const Outcome outcome =
          run_program({compiler, "-std=c99", "-Dcasadi_real=float", "-Wall", "-Wextra",
                       "-Wpedantic", "-Wshadow", "-Wconversion", "-Wdouble-promotion", "-Werror",
                       "-fsyntax-only", file.path().string()});
      EXPECT_EQ(outcome.status, 0) << outcome.err.substr(0, 2000);
    }
  }
}

/// The header belongs to C++ programs as well; the folder's CMakeLists.txt makes the library.
TEST(CInterfaceFolder, BuildsByItsCMakeLists) {
  const TempDir folder;
  for (const char* targets : {"c", "cpp,c"}) {
    const std::string out = folder / std::to_string(std::strlen(targets));
    ASSERT_EQ(run_arboc({"compile", ARBOC_SOURCE_DIR "/models/ur5/ur5.urdf", "-o", out, "--target",
                         targets, "--functions", "gravity"})
                  .status,
              0);
    write_text(out + "/CMakeLists.txt",
               "cmake_minimum_required(VERSION 3.16)\nproject(user CXX)\nadd_subdirectory(ur5)\n"
               "add_executable(user main.cpp)\ntarget_link_libraries(user ur5::c)\n");
    write_text(out + "/main.cpp",
               "#include <ur5/ur5_casadi.h>\n#include <cstdio>\nint main() {\n"
               "  double q[ur5_nq] = {0, 1, 0, 0, 0, 0}, g[ur5_nv], w[ur5_gravity_SZ_W];\n"
               "  const double* arg[] = {q}; double* res[] = {g};\n"
               "  const int status = ur5_gravity(arg, res, nullptr, w, 0);\n"
               "  std::printf(\"%d %.6f\\n\", status, g[1]);\n}\n");
    for (const Command& command :
         {Command{ARBOC_CMAKE, "-S", out, "-B", out + "/build", "-G", ARBOC_GENERATOR},
          Command{ARBOC_CMAKE, "--build", out + "/build"}}) {
      const Outcome outcome = run_program(command);
      ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
    }
    const Outcome c = run_program({out + "/build/user"});
    write_text(folder / "q", "0,1,0,0,0,0\n");
    const auto g = numbers(run_arboc({"eval", ARBOC_SOURCE_DIR "/models/ur5/ur5.urdf", "--function",
                                      "gravity", "--q", folder / "q"})
                               .out);
    char text[64];
    std::snprintf(text, sizeof text, "0 %.6f\n", g.at(0).at(1));
    EXPECT_EQ(c.out, text);
  }
}

/// CasADi itself, where Python has it.
TEST(CInterfaceInCasadi, IsAnExternalFunctionWithJacobian) {
  if (run_program({"python3", "-c", "import casadi"}).status != 0)
    GTEST_SKIP() << "python3 has no casadi";
  const TempDir folder;
  ASSERT_EQ(run_arboc({"compile", ARBOC_SOURCE_DIR "/models/ur5/ur5.urdf", "-o", folder.path(),
                       "--target", "c", "--functions", "rnea,crba"})
                .status,
            0);
  ASSERT_EQ(run_program({"sh", "-c",
                         "cc -O1 -fPIC -shared -o '" + (folder / "ur5.so") + "' '" +
                             (folder / "ur5") + "'/*.c -lm"})
                .status,
            0);
  const Outcome outcome = run_program(
      {"python3", ARBOC_SOURCE_DIR "/tests/embed/casadi_external.py", folder / "ur5.so"});
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
}

}  // namespace
}  // namespace arboc::test
