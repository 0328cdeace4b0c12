// What `cmake --install` and `cpack` give, used as somebody else would: moved to another place,
// found by find_package, in a project that generates its models' code when it is built.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "functions/catalogue.h"
#include "support/run_program.h"

namespace arboc::test {
namespace {

namespace fs = std::filesystem;
using Command = std::vector<std::string>;

std::string model_file(const std::string& name) {
  return ARBOC_SOURCE_DIR "/models/" + name + "/" + name + ".urdf";
}

Outcome expect_success(const Command& command) {
  Outcome outcome = run_program(command);
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err.substr(0, 4000);
  return outcome;
}

/// Prints what a CMake script that knows arboc's lists says.
Outcome run_script(const std::string& text) {
  const TempDir folder;
  write_text(folder / "script.cmake",
             "cmake_minimum_required(VERSION 3.17)\n"
             "include(" ARBOC_SOURCE_DIR
             "/cmake/arbocFiles.cmake)\n"
             "include(" ARBOC_SOURCE_DIR "/cmake/arbocAddModel.cmake)\n" +
                 text);
  return run_program({ARBOC_CMAKE, "-P", folder / "script.cmake"});
}

std::set<std::string> lines_of(const std::string& text) {
  std::istringstream in(text);
  std::set<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.insert(line);
  return lines;
}

/// The names that CMake expects before arboc has run are those that it then writes.
TEST(PackageFiles, AreThoseThatArbocWrites) {
  const std::vector<std::string> cases[] = {
      {"--functions", "all", "--target", "cpp,c"},
      {},
      {"--functions", "com_jacobian,rnea_hessian", "--target", "c", "--jacobian",
       "com_jacobian.Jc:q"},
      {"--functions", "rnea,crba", "--jacobian", "rnea.tau:q,v", "--jacobian=aba.qdd", "--gradient",
       "rnea.tau^2", "--vjp", "fk.placements:q", "--hessian", "energy.V:q", "--hessian", "iterated",
       "--jacobian", "rnea.tau:q,v", "--frames", "lower_rod"}};
  for (const std::vector<std::string>& options : cases) {
    const TempDir folder;
    Command command{"compile", model_file("double_pendulum"), "-o", folder.path(), "--name", "m"};
    command.insert(command.end(), options.begin(), options.end());
    const Outcome written = run_arboc(command);
    ASSERT_EQ(written.status, 0) << written.err;
    std::set<std::string> expected{"manifest.json"};
    const auto manifest = nlohmann::json::parse(read_text(folder / "m/manifest.json"));
    for (const auto& [path, hash] : manifest["files"].items()) expected.insert(path);

    std::string functions, rest;
    for (size_t k = 0; k < options.size(); ++k) {
      const bool first = k < 2 && options[0] == "--functions";
      if (first && k == 0) continue;
      std::string& list = first ? functions : rest;
      list += (list.empty() ? "" : ";") + options[k];
    }
    for (char& c : functions) c = c == ',' ? ';' : c;
    std::string targets = "cpp";
    for (const std::string& option : options)
      if (option == "c" || option == "cpp,c") targets = option == "c" ? "c" : "cpp;c";
    const Outcome named =
        run_script("arboc_function_names(\"" + functions + "\" \"" + rest +
                   "\" names)\narboc_files(m \"${names}\" \"" + targets +
                   "\" files)\n"
                   "foreach(f IN LISTS files)\n  message(\"${f}\")\nendforeach()\n");
    EXPECT_EQ(named.status, 0) << named.err;
    EXPECT_EQ(lines_of(named.err), expected);
  }
}

TEST(PackageFiles, KnowAllFunctions) {
  const Outcome outcome = run_script("message(\"${ARBOC_FUNCTIONS}\")\n");
  std::string all;
  for (const std::string& name : function_names()) all += (all.empty() ? "" : ";") + name;
  EXPECT_EQ(outcome.err, all + "\n");
}

class Package : public testing::Test {
 protected:
  /// Installs to one place and moves to another.
  void install() const {
    expect_success({ARBOC_CMAKE, "--install", ARBOC_BINARY_DIR, "--prefix", folder_ / "stage"});
    fs::rename(folder_ / "stage", folder_ / "opt");
  }
  void copy_consumer() const {
    fs::copy(ARBOC_SOURCE_DIR "/tests/embed/consumer", user());
    fs::copy_file(model_file("ur5"), user() + "/arm.urdf");
    fs::copy_file(model_file("quadruped"), user() + "/walker.urdf");
  }
  std::string user() const { return folder_ / "user"; }
  std::string built() const { return folder_ / "user/build"; }

  /// What runs once is compiled without optimisation.
  void configure(const std::string& generator, const std::string& flags = "-O0") const {
    expect_success({ARBOC_CMAKE, "-S", user(), "-B", built(), "-G", generator,
                    "-DCMAKE_PREFIX_PATH=" + (folder_ / "opt"), "-DCMAKE_BUILD_TYPE=None",
                    "-DCMAKE_CXX_FLAGS=" + flags});
  }
  std::string build() const {
    return expect_success({ARBOC_CMAKE, "--build", built(), "--parallel", "2"}).out;
  }
  fs::file_time_type time_of(const std::string& file) const {
    return fs::last_write_time(built() + "/" + file);
  }

  void expect_numbers_of_eval(const std::string& argument, const std::string& model,
                              const Command& options, const std::vector<std::string>& inputs,
                              const std::vector<std::vector<double>>& values) const {
    std::string states;
    Command eval{"eval", model_file(model)};
    eval.insert(eval.end(), options.begin(), options.end());
    for (size_t k = 0; k < inputs.size(); ++k) {
      states += csv_text({values[k]});
      write_text(folder_ / inputs[k], csv_text({values[k]}));
      eval.insert(eval.end(), {"--" + inputs[k], folder_ / inputs[k]});
    }
    for (char& c : states) c = c == ',' ? ' ' : c;
    RunOptions how;
    how.input = folder_ / "states";
    write_text(how.input, states);
    Command command{built() + "/consumer"};
    if (!argument.empty()) command.push_back(argument);
    const Outcome consumer = run_program(command, how), expected = run_arboc(eval);
    EXPECT_EQ(consumer.status, 0) << consumer.err;
    EXPECT_EQ(expected.status, 0) << expected.err;
    EXPECT_EQ(consumer.out, expected.out);
    EXPECT_FALSE(consumer.out.empty());
  }

  TempDir folder_;
};

std::vector<double> ramp(size_t n, double from, double step) {
  std::vector<double> values;
  for (size_t k = 0; k < n; ++k) values.push_back(from + step * static_cast<double>(k));
  return values;
}

TEST_F(Package, MovedElsewhereGeneratesAndGivesTheBitsOfEval) {
  install();
  copy_consumer();
  configure("Ninja", "-O2 -march=native -fno-tree-vectorize");  // those of eval
  build();
  expect_numbers_of_eval("", "ur5", {"--function", "rnea"}, {"q", "v", "a"},
                         {ramp(6, -1, 0.4), ramp(6, 2, -0.7), ramp(6, 0.3, 0.9)});
  std::vector<double> q = ramp(19, -0.6, 0.1);
  q[3] = q[4] = q[5] = q[6] = 0.5;
  expect_numbers_of_eval("walker", "quadruped", {"--base", "floating", "--function", "aba"},
                         {"q", "v", "tau"}, {q, ramp(18, 1, -0.1), ramp(18, -9, 1)});
  EXPECT_EQ(expect_success({built() + "/runtime"}).out, "0.841470984808\n");
  EXPECT_NE(expect_success({built() + "/page"}).out.find("<title>a &lt; b</title>"),
            std::string::npos);
  RunOptions state;
  state.input = folder_ / "state";
  write_text(state.input, "0 1 2 3 4 5 6 5 4 3 2 1 1 -1 1 -1 1 -1");
  const auto by_c = numbers(run_program({built() + "/in_c"}, state).out);
  const auto by_cpp = numbers(run_program({built() + "/consumer"}, state).out);
  ASSERT_EQ(by_c.size(), 1u);
  for (size_t k = 0; k < 6; ++k) EXPECT_NEAR(by_c[0].at(k), by_cpp.at(0).at(k), 1e-9);
}

/// Generated again when and only when something changed, and compiled only what came out different.
TEST_F(Package, RebuildsWhatChanged) {
  install();
  copy_consumer();
  for (const std::string generator : {"Ninja", "Unix Makefiles"}) {
    if (generator != "Ninja" && run_program({"make", "--version"}).status != 0) continue;
    SCOPED_TRACE(generator);
    fs::remove_all(built());
    configure(generator);
    build();
    EXPECT_EQ(build().find("Compiling"), std::string::npos);

    // A comment: the bytes of the code stay, but for the model's hash in their heads.
    const auto arm = time_of("arm.stamp"), walker = time_of("walker.stamp");
    const auto runtime = time_of("generated/arm/arboc/scalar.hpp");
    const auto program = time_of("consumer");
    const std::string model = read_text(user() + "/arm.urdf");
    write_text(user() + "/arm.urdf", model + "<!-- more -->\n");
    EXPECT_NE(build().find("Compiling arm.urdf"), std::string::npos);
    EXPECT_GT(time_of("arm.stamp"), arm);
    EXPECT_EQ(time_of("walker.stamp"), walker);
    EXPECT_EQ(time_of("generated/arm/arboc/scalar.hpp"), runtime);
    EXPECT_GT(time_of("consumer"), program);
    EXPECT_EQ(build().find("Compiling"), std::string::npos);

    // A heavier upper arm reaches the program in one build.
    const std::string mass = "mass value=\"8.393\"";
    ASSERT_NE(model.find(mass), std::string::npos);
    std::string heavier = model;
    heavier.replace(heavier.find(mass), mass.size(), "mass value=\"9\"");
    RunOptions state;
    state.input = folder_ / "state";
    write_text(state.input, "0 1 2 3 4 5 0 0 0 0 0 0 0 0 0 0 0 0");
    const std::string before = run_program({built() + "/consumer"}, state).out;
    write_text(user() + "/arm.urdf", heavier);
    build();
    EXPECT_NE(run_program({built() + "/consumer"}, state).out, before);
    write_text(user() + "/arm.urdf", model);

    // Other options.
    const std::string lists = user() + "/CMakeLists.txt", text = read_text(lists);
    std::string other = text;
    other.replace(other.find("rnea crba"), 9, "rnea crba gravity OPTIONS --snap 0");
    write_text(lists, other);
    build();
    EXPECT_TRUE(fs::exists(built() + "/generated/arm/arm_gravity.hpp"));
    EXPECT_NE(read_text(built() + "/generated/arm/arm_rnea.hpp").find("--snap 0"),
              std::string::npos);
    write_text(lists, text);
  }
}

/// Another compiler, here one with another time stamp.
TEST_F(Package, RebuildsWhenArbocChanges) {
  install();
  copy_consumer();
  configure("Ninja");
  const Command generate{ARBOC_CMAKE, "--build", built(), "--target", "arm_generate"};
  expect_success(generate);
  EXPECT_EQ(expect_success(generate).out.find("Compiling"), std::string::npos);
  fs::last_write_time(folder_ / "opt/bin/arboc", fs::file_time_type::clock::now());
  EXPECT_NE(expect_success(generate).out.find("Compiling arm.urdf"), std::string::npos);
}

/// apps/ as somebody would copy it; one of them is built.
TEST_F(Package, ServesTheExamples) {
  install();
  fs::copy(ARBOC_SOURCE_DIR "/apps", folder_ / "apps");
  fs::create_directories(folder_ / "models/ur5");
  fs::copy_file(model_file("ur5"), folder_ / "models/ur5/ur5.urdf");
  expect_success({ARBOC_CMAKE, "-S", folder_ / "apps", "-B", built(), "-G", "Ninja",
                  "-DCMAKE_PREFIX_PATH=" + (folder_ / "opt"), "-DCMAKE_BUILD_TYPE=None"});
  expect_success({ARBOC_CMAKE, "--build", built(), "--target", "inverse_kinematics"});
  expect_success({built() + "/inverse_kinematics", "20"});
}

TEST_F(Package, SaysWhatIsWrong) {
  install();
  const auto complaint = [&](const std::string& call) {
    fs::create_directories(user());
    write_text(user() + "/CMakeLists.txt",
               "cmake_minimum_required(VERSION 3.16)\nproject(p LANGUAGES CXX)\n"
               "find_package(arboc REQUIRED)\narboc_add_model(" +
                   call + ")\n");
    const Outcome outcome = run_program({ARBOC_CMAKE, "-S", user(), "-B", built(), "-G", "Ninja",
                                         "-DCMAKE_PREFIX_PATH=" + (folder_ / "opt")});
    EXPECT_NE(outcome.status, 0);
    return outcome.err;
  };
  EXPECT_NE(complaint("arm").find("MODEL file is missing"), std::string::npos);
  EXPECT_NE(complaint("a__b MODEL a.urdf").find("is no name for code"), std::string::npos);
  EXPECT_NE(complaint("a MODEL a.urdf FUNCTION rnea").find("FUNCTION"), std::string::npos);
  EXPECT_NE(complaint("a MODEL a.urdf OPTIONS --jacobian rnea").find("FUNCTION.OUTPUT"),
            std::string::npos);
}

TEST_F(Package, IsADebianPackage) {
  if (run_program({"dpkg-shlibdeps", "--version"}).status != 0)
    GTEST_SKIP() << "dpkg-dev is not installed";
  expect_success({ARBOC_CPACK, "-G", "DEB", "--config", ARBOC_BINARY_DIR "/CPackConfig.cmake", "-B",
                  folder_.path()});
  std::string package;
  for (const auto& file : fs::directory_iterator(folder_.path()))
    if (file.path().extension() == ".deb") package = file.path();
  ASSERT_FALSE(package.empty());
  const std::string about = expect_success({"dpkg-deb", "-I", package}).out;
  for (const char* line : {"Package: arboc\n", "Section: devel\n", "libc6", "libstdc++6",
                           "libexpat1", "libfmt9", "liburdfdom-model", "libssl3", "Recommends: "})
    EXPECT_NE(about.find(line), std::string::npos) << line << "\n" << about;
  const std::string files = expect_success({"dpkg-deb", "-c", package}).out;
  for (const char* file :
       {"./usr/bin/arboc\n", "./usr/include/arboc/scalar.hpp\n", "arboc/arbocConfig.cmake\n",
        "arboc/arbocAddModel.cmake\n", "./usr/lib/python3/dist-packages/arboc/__init__.py\n",
        "./usr/share/doc/arboc/copyright\n"})
    EXPECT_NE(files.find(file), std::string::npos) << file << "\n" << files;
  EXPECT_EQ(files.find(ARBOC_SOURCE_DIR), std::string::npos);
}

}  // namespace
}  // namespace arboc::test
