#include "cli/peer_library.h"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <functional>
#include <sstream>

#include "base/words.h"
#include "emit/emit.h"
#include "emit/template.h"

namespace arboc::cli {
namespace fs = std::filesystem;
namespace {

const std::vector<PeerKind>& kinds() {
  static const std::vector<PeerKind> kKinds = {
      {"KDL", "kdl", "kdl", "-lorocos-kdl", {}, 1e-9},
      {"MuJoCo", "mujoco", "mujoco", "-lmujoco", {}, 1e-5},  // it diagonalises inertias
      {"DART", "dart", "dart", "-ldart", {}, 1e-9},
      {"RBDL", "rbdl", "rbdl", "", {"rbdl"}, 1e-9},
      {"Pinocchio", "pinocchio", "pinocchio", "", {"pinocchio"}, 1e-9},
      {"Pinocchio+CppADCodeGen",
       "codegen",
       "pinocchio_codegen",
       "",
       {"pinocchio", "cppadcodegen", "cppad"},
       1e-9},
  };
  return kKinds;
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// What the builds of checkouts would write, for those that were never built; found last.
const Files& configured() {
  static const Files kFiles = {
      {"configured/pinocchio/config.hpp",
       "#define PINOCCHIO_DLLAPI\n#define PINOCCHIO_PARSERS_DLLAPI\n"
       "#define PINOCCHIO_MAJOR_VERSION 3\n#define PINOCCHIO_MINOR_VERSION 0\n"
       "#define PINOCCHIO_PATCH_VERSION 0\n#define PINOCCHIO_VERSION \"checkout\"\n"},
      {"configured/pinocchio/deprecated.hpp",
       "#define PINOCCHIO_DEPRECATED\n#define PINOCCHIO_DEPRECATED_MESSAGE(message)\n"
       "#define PINOCCHIO_PRAGMA_WARNING(x)\n#define PINOCCHIO_PRAGMA_DEPRECATED(x)\n"
       "#define PINOCCHIO_PRAGMA_DEPRECATED_HEADER(from, to)\n"},
      {"configured/pinocchio/warning.hpp", ""},
      {"configured/rbdl/rbdl_config.h", "#define RBDL_DLLAPI\n#define RBDL_LOCAL\n"},
      {"configured/cppad/cg/configure.hpp", "#define CPPAD_CG_VERSION \"checkout\"\n"},
      {"configured/cppad/cg/model/threadpool/pthread_pool_c.hpp",
       "static const char CPPADCG_PTHREAD_POOL_C_FILE[] = \"\";\n"},
      {"configured/cppad/cg/model/threadpool/pthread_pool_h.hpp",
       "static const char CPPADCG_PTHREAD_POOL_H_FILE[] = \"\";\n"},
      {"configured/cppad/cg/model/threadpool/openmp_c.hpp",
       "static const char CPPADCG_OPENMP_C_FILE[] = \"\";\n"},
      {"configured/cppad/cg/model/threadpool/openmp_h.hpp",
       "static const char CPPADCG_OPENMP_H_FILE[] = \"\";\n"},
  };
  return kFiles;
}

/// The library's own sources, where it is not made of headers alone.
std::string sources_of(const PeerKind& kind, const PeerOptions& options) {
  if (std::string(kind.file) != "rbdl") return "";
  std::string out;
  for (const char* file : {"Dynamics", "Joint", "Kinematics", "Logging", "Model", "rbdl_errors",
                           "rbdl_mathutils", "rbdl_utils"})
    out += fmt::format("#include \"{}/src/{}.cc\"\n", options.folders.at("rbdl"), file);
  return out;
}

/// Debian builds its packages for any x86-64, and Eigen's types must agree with that.
std::string flags_of(const PeerKind& kind, const PeerOptions& options) {
  std::string flags =
      kind.folders.empty() ? std::string("-std=c++17 -O2 -DNDEBUG") : options.cxxflags;
  flags += fmt::format(" -w -DPEER={} -isystem {}", kind.maker, ARBOC_EIGEN);
  for (const char* folder : kind.folders)
    flags += fmt::format(" -isystem {}/include", options.folders.at(folder));
  return flags;
}

void check_folders(const PeerKind& kind, const PeerOptions& options) {
  for (const char* name : kind.folders) {
    const auto folder = options.folders.find(name);
    if (folder == options.folders.end() || folder->second.empty())
      throw std::runtime_error(fmt::format("name a checkout with --{} DIR", name));
    if (!fs::is_directory(fs::path(folder->second) / "include"))
      throw std::runtime_error(
          fmt::format("--{} {}: there is no folder include", name, printable(folder->second)));
  }
}

std::string find_clang() {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (fs::exists(folder + "/clang++")) return folder + "/clang++";
  return "";
}

/// The compiler of peers that are made of sources; clang makes Pinocchio up to twice as fast.
std::string compiler_of(const Common& common, const PeerOptions& options) {
  if (!options.cxx.empty()) return options.cxx;
  const std::string clang = find_clang();
  return clang.empty() ? compiler_command(common)[0] : clang;
}

std::string build(const Common& common, const PeerOptions& options, const PeerKind& kind,
                  const std::string& temporary) {
  check_folders(kind, options);
  Common own = common;
  if (!kind.folders.empty()) own.cxx = compiler_of(common, options);
  Files files = configured();
  for (const std::string& name :
       {std::string("body.hpp"), std::string("driver.cpp"), std::string("peer.cpp"),
        std::string("peer.hpp"), std::string("pinocchio_model.hpp"),
        kind.file + std::string(".cpp")})
    files[name] = embedded("peers/" + name);
  files["sources.cpp"] = sources_of(kind, options);
  own.cxxflags = flags_of(kind, options);
  std::string kept, folder = temporary;
  if (!options.keep.empty()) {
    std::string all = fmt::format("{}", fmt::join(compiler_command(own), " "));
    for (const auto& [name, text] : files) all += name + text;
    kept = fmt::format("{}/{}-{:016x}", options.keep, kind.file, std::hash<std::string>()(all));
    if (fs::exists(kept + "/lib.so")) return kept + "/lib.so";
    folder = fmt::format("{}.part-{}", kept, ::getpid());
  }
  own.cxxflags += fmt::format(" -idirafter {}/configured", folder);
  std::vector<std::string> sources{fmt::format("{}.cpp", kind.file), "peer.cpp", "driver.cpp"};
  if (!files["sources.cpp"].empty()) sources.emplace_back("sources.cpp");
  if (kept.empty()) return build_library(own, folder, files, sources, {kind.libraries});
  // Whole or not at all: somebody may interrupt this, or build the same.
  try {
    build_library(own, folder, files, sources, {kind.libraries});
    std::error_code error;
    fs::rename(folder, kept, error);
    if (error && !fs::exists(kept + "/lib.so"))
      throw fs::filesystem_error("rename", folder, kept, error);
  } catch (...) {
    fs::remove_all(folder);
    throw;
  }
  fs::remove_all(folder);
  return kept + "/lib.so";
}

}  // namespace

std::vector<PeerKind> peer_kinds(const PeerOptions& options) {
  if (options.list.empty()) return kinds();
  std::vector<std::string> names;
  for (const PeerKind& kind : kinds()) names.push_back(lower(kind.name));
  const std::vector<std::string_view> known(names.begin(), names.end());
  std::vector<PeerKind> list;
  for (const std::string& word : split(options.list)) {
    const auto at = std::find(known.begin(), known.end(), lower(word));
    if (at == known.end()) throw UsageError(unknown("--peers", "there is no peer", word, known));
    list.push_back(kinds()[static_cast<size_t>(at - known.begin())]);
  }
  return list;
}

void add_peer_options(CLI::App& app, PeerOptions& options) {
  const auto add = [&](const std::string& name, std::string& value, const char* type,
                       const std::string& text) {
    return app.add_option(name, value, text)->type_name(type)->group("Peers");
  };
  std::vector<std::string> names;
  for (const PeerKind& kind : kinds()) names.push_back(lower(kind.name));
  add("--peers", options.list, "[LIST]",
      fmt::format("time these libraries too (default: all that can be had): {}",
                  fmt::join(names, ", ")))
      ->expected(0, 1)
      ->default_str("");
  for (const char* name : {"pinocchio", "cppadcodegen", "cppad", "rbdl"})
    add(fmt::format("--{}", name), options.folders[name], "DIR",
        "a checkout or where it is installed: DIR/include");
  add("--keep", options.keep, "DIR",
      "keep compiled peers there for the next time (not for other checkouts in the "
      "same folders)");
  add("--peer-cxx", options.cxx, "COMMAND", "compiles what is no package (default: clang++)");
  add("--peer-cxxflags", options.cxxflags, "FLAGS", "its flags")->capture_default_str();
}

PeerLibrary::PeerLibrary(const Common& common, const PeerOptions& options, const PeerKind& kind,
                         PeerTask task)
    : kind_(kind), library_(build(common, options, kind, folder_.path())) {
  const std::string compiler = compiler_of(common, options);
  task.body.toolchain = {folder_.path().c_str(), compiler.c_str(), "-O3 -march=native"};
  using Open = int (*)(const peers::Body*, int, const double* const*);
  if (symbol<Open>("arboc_peer_open")(&task.body, task.states, task.x.data()) != 0) fail();
}

void PeerLibrary::fail() const {
  throw std::runtime_error(symbol<const char* (*)()>("arboc_peer_error")());
}

bool PeerLibrary::times(peers::Function f) const {
  return symbol<int (*)(int)>("arboc_peer_times")(static_cast<int>(f)) != 0;
}

std::vector<double> PeerLibrary::result(peers::Function f, int state, size_t size) const {
  std::vector<double> out(size);
  using Result = int (*)(int, int, double*);
  if (symbol<Result>("arboc_peer_result")(static_cast<int>(f), state, out.data()) != 0) fail();
  return out;
}

Pass PeerLibrary::pass(peers::Function f) const {
  const auto call = symbol<void (*)(int)>("arboc_peer_pass");
  return [call, f] { call(static_cast<int>(f)); };
}

}  // namespace arboc::cli
