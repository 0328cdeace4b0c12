// arboc check --folder DIR/NAME: is what lies there what one run of compile wrote?
//
// A run that was killed while it replaced the files of an older one leaves some of each;
// manifest.json is written last and holds the hash of every other file, so the mixture shows.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/sha256.h"
#include "cli/common.h"
#include "cli/output.h"
#include "frontend/input_file.h"

namespace arboc::cli {
namespace fs = std::filesystem;
namespace {

std::optional<std::string> bytes_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in || !fs::is_regular_file(path)) return std::nullopt;
  return std::string{std::istreambuf_iterator<char>(in), {}};
}

struct Manifest {
  std::map<std::string, std::string> files;  ///< hash by path
  std::string source, sha256;
};

Manifest read_manifest(const std::string& folder) {
  const std::string path = (fs::path(folder) / "manifest.json").string();
  const auto fail = [&](const char* what) {
    throw InputError(
        fmt::format("{}: error: {} (compile writes it; run it again)", printable(path), what));
  };
  const auto bytes = bytes_of(path);
  if (!bytes) fail("cannot be read");
  const auto json = nlohmann::json::parse(*bytes, nullptr, false);
  Manifest manifest;
  try {
    json.at("files").get_to(manifest.files);
    json.at("source").at("file").get_to(manifest.source);
    json.at("source").at("sha256").get_to(manifest.sha256);
  } catch (const nlohmann::json::exception&) {
    fail("is not a manifest of arboc");
  }
  if (manifest.files.empty()) fail("lists no files");
  return manifest;
}

}  // namespace

int run_check_folder(const Common& common, const std::string& folder) {
  const Manifest manifest = read_manifest(folder);
  int wrong = 0;
  for (const auto& [path, hash] : manifest.files) {
    check_interrupt();
    const auto bytes = bytes_of(fs::path(folder) / path);
    if (bytes && sha256(*bytes) == hash) continue;
    ++wrong;
    fmt::print("{}: {}\n", printable(path), bytes ? "differs from the manifest" : "is missing");
  }
  if (!common.path.empty()) {
    Diagnostics diagnostics;
    Findings findings(shown_path(common.path));
    const auto text = read_input(common.path, findings);
    findings.deliver(diagnostics);
    if (sha256(text.value()) != manifest.sha256) {
      ++wrong;
      fmt::print("the folder was made from another {}\n", printable(manifest.source));
    }
  }
  if (wrong == 0) fmt::print("{} files as the manifest lists them\n", manifest.files.size());
  flush_stdout();
  if (wrong > 0) fmt::print(stderr, "error: compile the model again\n");
  return wrong > 0 ? kNo : kOk;
}

}  // namespace arboc::cli
