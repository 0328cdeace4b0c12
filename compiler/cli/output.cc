#include "cli/output.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "base/diagnostic.h"
#include "cli/common.h"

namespace arboc::cli {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void fail(const std::string& what, const fs::path& path, int error) {
  throw OutputError(
      fmt::format("{}: error: {}: {}", printable(path.string()), what, std::strerror(error)));
}

/// Writes and syncs a new file.
void write_file(const fs::path& path, const std::string& bytes) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (file < 0) fail("cannot create", path, errno);
  size_t written = 0;
  while (written < bytes.size()) {
    const ssize_t n = write(file, bytes.data() + written, bytes.size() - written);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      const int error = errno;
      close(file);
      fail("cannot write", path, error);
    }
    written += static_cast<size_t>(n);
  }
  if (fsync(file) != 0 && errno != EINVAL) fail("cannot sync", path, errno);
  if (close(file) != 0) fail("cannot write", path, errno);
}

void make_folder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) fail("cannot create folder", path, error.value());
}

void move(const fs::path& from, const fs::path& to) {
  if (std::rename(from.c_str(), to.c_str()) != 0) fail("cannot replace", to, errno);
}

/// Whether the file is there with these bytes.
bool has_bytes(const fs::path& path, const std::string& bytes) {
  std::error_code error;
  if (!fs::is_regular_file(fs::symlink_status(path, error)) ||
      fs::file_size(path, error) != bytes.size())
    return false;
  std::ifstream in(path, std::ios::binary);
  return std::string{std::istreambuf_iterator<char>(in), {}} == bytes;
}

/// Paths that an earlier run wrote, as its manifest lists them; only plain relative ones.
std::vector<std::string> listed_files(const fs::path& manifest) {
  std::ifstream in(manifest, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const auto json = nlohmann::json::parse(text, nullptr, false);
  std::vector<std::string> files;
  if (!json.is_object() || !json.contains("files") || !json["files"].is_object()) return files;
  for (const auto& [path, hash] : json["files"].items()) {
    const fs::path p(path);
    if (!p.empty() && p.is_relative() && p.lexically_normal() == p && *p.begin() != "..")
      files.push_back(path);
  }
  return files;
}

class Staging {
 public:
  Staging(const fs::path& directory, const std::string& name)
      : path_(directory / fmt::format(".{}.{}.tmp", name, getpid())) {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
    make_folder(path_);
  }
  ~Staging() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  const fs::path& path() const { return path_; }

 private:
  CleanUp pending_;
  fs::path path_;
};

}  // namespace

void write_folder(const std::string& directory, const std::string& name, const Files& files) {
  const fs::path target = fs::path(directory) / name;
  make_folder(directory);
  const Staging staging(directory, name);
  for (const auto& [path, bytes] : files) {
    make_folder((staging.path() / path).parent_path());
    write_file(staging.path() / path, bytes);
  }
  if (!fs::exists(fs::symlink_status(target))) {
    move(staging.path(), target);
    return;
  }
  const auto old = listed_files(target / "manifest.json");
  for (const auto& [path, bytes] : files) {
    if (path == "manifest.json" || has_bytes(target / path, bytes)) continue;
    make_folder((target / path).parent_path());
    move(staging.path() / path, target / path);
  }
  for (const std::string& path : old) {
    std::error_code ignored;
    if (!files.contains(path)) fs::remove(target / path, ignored);
  }
  if (!has_bytes(target / "manifest.json", files.at("manifest.json")))
    move(staging.path() / "manifest.json", target / "manifest.json");
}

void write_one_file(const std::string& path, const std::string& bytes) {
  const fs::path fresh = path + fmt::format(".{}.tmp", getpid());
  std::error_code ignored;
  fs::remove(fresh, ignored);
  write_file(fresh, bytes);
  move(fresh, path);
}

void flush_stdout() {
  if (std::fflush(stdout) != 0 || std::ferror(stdout))
    throw OutputError(
        fmt::format("error: cannot write to standard output: {}", std::strerror(errno)));
}

TemporaryFolder::TemporaryFolder() {
  const char* base = std::getenv("TMPDIR");
  path_ = fmt::format("{}/arboc-XXXXXX", base && *base ? base : "/tmp");
  if (!mkdtemp(path_.data())) fail("cannot create temporary folder", path_, errno);
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace arboc::cli
