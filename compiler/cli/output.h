// Files on disk, whole or not at all.
#pragma once
#include <string>

#include "cli/common.h"
#include "emit/target.h"

namespace arboc::cli {

/// Writes `files` to the folder `directory`/`name`.  Everything is first written and synced beside
/// it.  A new folder then appears by one rename; in an existing one each file whose bytes change
/// is replaced by a rename, manifest.json last, and files that an older manifest lists and the new one does not are
/// removed; other files are left alone.  Runs that write to one `directory` take turns, and clean
/// up behind those that were killed.  Throws OutputError.
void write_folder(const std::string& directory, const std::string& name, const Files& files);

/// Writes the file at `path`, in place of one that is there, whole or not at all.  Throws
/// OutputError.
void write_one_file(const std::string& path, const std::string& bytes);

/// Where standard input, output or error is closed, a file that is opened later would take its
/// number and receive what is printed; from now on such an input cannot be read, such an output
/// not be written, and messages are lost.
void hold_standard_streams();

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
