#include "frontend/input_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

namespace arboc {
namespace {

/// A file descriptor, closed at the end unless it is standard input.
struct Descriptor {
  int fd = -1;
  ~Descriptor() {
    if (fd > STDIN_FILENO) ::close(fd);
  }
};

std::string reason(int error) { return std::generic_category().message(error); }

/// Appends what one read() gives; false at the end of the file.  Throws the errno.
bool read_some(int fd, std::string& bytes) {
  constexpr size_t kChunk = size_t{1} << 20;
  const size_t size = bytes.size();
  bytes.resize(size + std::min(kChunk, kMaxFileBytes + 1 - size));
  ssize_t count = 0;
  do {
    count = ::read(fd, bytes.data() + size, bytes.size() - size);
  } while (count < 0 && errno == EINTR);
  const int error = errno;
  bytes.resize(size + (count > 0 ? static_cast<size_t>(count) : 0));
  if (count < 0) throw error;
  return count > 0;
}

}  // namespace

std::string shown_path(const std::string& path) { return path == "-" ? "<stdin>" : path; }

std::string base_name(const std::string& path) {
  return path == "-" ? "stdin" : path.substr(path.find_last_of('/') + 1);
}

std::optional<std::string> read_input(const std::string& path, Findings& findings) {
  const auto refuse = [&](std::string message, std::string hint = "") {
    findings.error({{}, "", std::move(message), std::move(hint)});
    return std::nullopt;
  };
  if (path.find('\0') != std::string::npos) return refuse("cannot be opened: NUL in the path");
  Descriptor file;
  file.fd = path == "-" ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY);
  if (file.fd < 0) return refuse(fmt::format("cannot be opened: {}", reason(errno)));

  struct stat status {};
  if (::fstat(file.fd, &status) != 0)
    return refuse(fmt::format("cannot be read: {}", reason(errno)));
  if (S_ISDIR(status.st_mode)) return refuse("is a directory", "give a file");

  const auto too_large = [&] {
    return refuse(fmt::format("is too large: the limit is {} MiB", kMaxFileBytes >> 20));
  };
  if (S_ISREG(status.st_mode) && static_cast<size_t>(status.st_size) > kMaxFileBytes)
    return too_large();
  std::string bytes;
  try {
    while (bytes.size() <= kMaxFileBytes && read_some(file.fd, bytes)) {
    }
  } catch (int error) {
    return refuse(fmt::format("cannot be read: {}", reason(error)));
  }
  if (bytes.size() > kMaxFileBytes) return too_large();
  return bytes;
}

}  // namespace arboc
