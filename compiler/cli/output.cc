#include "cli/output.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

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

/// What was renamed in or into the folder survives a crash of the machine.
void sync_folder(const fs::path& path) {
  const int folder = open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return;  // not readable: nothing to be done
  const int status = fsync(folder);
  const int error = errno;
  close(folder);
  if (status != 0 && error != EINVAL) fail("cannot sync", path, error);
}

/// One writer at a time, others wait; given back by the system when a process ends, however it
/// does.
class FolderLock {
 public:
  explicit FolderLock(const fs::path& path)
      : fd_(open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    while (fd_ >= 0 && flock(fd_, LOCK_EX) != 0 && errno == EINTR) check_interrupt();
  }
  ~FolderLock() {
    if (fd_ >= 0) close(fd_);
  }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int fd_;
};

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

/// The process that staged in a folder `.NAME.PID.tmp`, or 0.
pid_t stager(const std::string& entry, const std::string& name) {
  const std::string head = fmt::format(".{}.", name), tail = ".tmp";
  if (!entry.starts_with(head) || !entry.ends_with(tail)) return 0;
  pid_t pid = 0;
  const char* end = entry.data() + entry.size() - tail.size();
  const auto [stop, error] = std::from_chars(entry.data() + head.size(), end, pid);
  return error == std::errc() && stop == end ? pid : 0;
}

class Staging {
 public:
  Staging(const fs::path& directory, const std::string& name)
      : path_(directory / fmt::format(".{}.{}.tmp", name, getpid())) {
    std::error_code ignored;
    std::vector<fs::path> left;  // by processes that were killed
    for (const auto& entry : fs::directory_iterator(directory, ignored))
      if (const pid_t pid = stager(entry.path().filename().string(), name);
          pid > 0 && kill(pid, 0) != 0 && errno == ESRCH)
        left.push_back(entry.path());
    for (const fs::path& path : left) fs::remove_all(path, ignored);
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

/// Moves the staged files into a folder that is there.  The new manifest goes first, under another
/// name: should the run end here, the next one knows which files it may have left.
void replace_files(const fs::path& staged, const fs::path& target, const Files& files) {
  const fs::path manifest = target / "manifest.json", coming = target / "manifest.json.new";
  std::vector<std::string> old = listed_files(manifest);
  for (const std::string& path : listed_files(coming)) old.push_back(path);
  const bool same = has_bytes(manifest, files.at("manifest.json"));
  if (!same) move(staged / "manifest.json", coming);
  for (const auto& [path, bytes] : files) {
    if (path == "manifest.json" || has_bytes(target / path, bytes)) continue;
    make_folder((target / path).parent_path());
    move(staged / path, target / path);
  }
  std::error_code ignored;
  for (const std::string& path : old)
    if (!files.contains(path)) fs::remove(target / path, ignored);
  if (same)
    fs::remove(coming, ignored);
  else
    move(coming, manifest);
}

}  // namespace

void write_folder(const std::string& directory, const std::string& name, const Files& files) {
  const fs::path target = fs::path(directory) / name;
  make_folder(directory);
  const FolderLock lock(directory);
  const Staging staging(directory, name);
  std::set<fs::path> folders{target};
  for (const auto& [path, bytes] : files) {
    make_folder((staging.path() / path).parent_path());
    write_file(staging.path() / path, bytes);
    folders.insert((target / path).parent_path());
    check_interrupt();
  }
  if (!fs::exists(fs::symlink_status(target))) {
    for (const fs::path& folder : folders)
      sync_folder(staging.path() / folder.lexically_relative(target));
    move(staging.path(), target);
    sync_folder(directory);
    return;
  }
  replace_files(staging.path(), target, files);
  for (const fs::path& folder : folders) sync_folder(folder);
}

void write_one_file(const std::string& path, const std::string& bytes) {
  const fs::path fresh = path + fmt::format(".{}.tmp", getpid());
  std::error_code ignored;
  fs::remove(fresh, ignored);
  write_file(fresh, bytes);
  move(fresh, path);
}

void hold_standard_streams() {
  for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(fd, F_GETFD) >= 0) continue;
    // open() takes the lowest number that is free, which is this one.
    constexpr int kModes[] = {O_WRONLY, O_RDONLY, O_WRONLY};  // messages are lost in silence
    if (open("/dev/null", kModes[fd]) != fd) std::abort();
  }
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
