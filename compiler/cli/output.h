// Files on disk, whole or not at all.
#pragma once
#include <string>

#include "cli/common.h"
#include "emit/target.h"

namespace arboc::cli {

/// Writes `files` to the folder `directory`/`name`.  A new folder appears by one rename.  In an
/// existing one each file whose bytes change is replaced by a rename, manifest.json last, and files
/// that an older manifest lists and the new one does not are removed; other files are left alone.
/// Throws OutputError.
void write_folder(const std::string& directory, const std::string& name, const Files& files);

/// Writes the file at `path`, in place of one that is there, whole or not at all.  Throws
/// OutputError.
void write_one_file(const std::string& path, const std::string& bytes);

/// Flushes stdout; throws OutputError if any of it was lost.
void flush_stdout();

/// A private temporary folder, removed with everything in it.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::string& path() const { return path_; }

 private:
  CleanUp pending_;
  std::string path_;
};

}  // namespace arboc::cli
