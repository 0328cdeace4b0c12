#include "support/golden.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

namespace arboc::test {

bool updating() {
  const char* value = std::getenv("ARBOC_UPDATE");
  return value != nullptr && std::string(value) == "1";
}

std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_file(const std::string& path, const std::string& bytes) {
  std::filesystem::create_directories(std::filesystem::path(path).parent_path());
  std::ofstream(path, std::ios::binary) << bytes;
}

void expect_golden(const std::string& path, const std::string& actual) {
  if (updating()) return write_file(path, actual);
  const std::string expected = read_file(path);
  if (expected == actual) return;
  std::istringstream want(expected), have(actual);
  std::string wanted, got;
  for (int number = 1;; ++number) {
    const bool more = static_cast<bool>(std::getline(want, wanted));
    if (!std::getline(have, got)) got = "(end)";
    if (!more) wanted = "(end)";
    if (wanted == got && more) continue;
    ADD_FAILURE() << path << ":" << number << ":\n  committed: " << wanted
                  << "\n  now:       " << got
                  << "\nIf the change is meant, run the test again with ARBOC_UPDATE=1.";
    return;
  }
}

}  // namespace arboc::test
