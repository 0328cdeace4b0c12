#include "program.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "task_file.h"

namespace study {

void write_files(const std::string& folder, const Files& files) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw WriteError("error: " + folder + ": " + error.message());
  for (const auto& [name, text] : files) {
    const std::filesystem::path path = std::filesystem::path(folder) / name;
    std::ofstream out(path, std::ios::binary);
    out << text;
    out.close();
    if (!out) throw WriteError("error: " + path.string() + " cannot be written");
  }
}

int exit_status(const std::function<int()>& program) {
  try {
    return program();
  } catch (const TaskError& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 2;
  } catch (const WriteError& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 3;
  } catch (const std::invalid_argument& e) {
    fmt::print(stderr, "error: {}\n", e.what());
    return 2;
  } catch (const std::exception& e) {
    fmt::print(stderr, "internal error: {}\n", e.what());
    return 4;
  }
}

}  // namespace study
