#include "program.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "task_file.h"

namespace study {
namespace {

constexpr const char* kPart = ".part";

}  // namespace

void write_files(const std::string& folder, const Files& files) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw WriteError("error: " + folder + ": " + error.message());
  const auto path = [&](const std::string& name) { return std::filesystem::path(folder) / name; };
  const auto remove_parts = [&] {
    for (const auto& file : files) std::filesystem::remove(path(file.first + kPart), error);
  };
  for (const auto& [name, text] : files) {
    std::ofstream out(path(name + kPart), std::ios::binary);
    out << text;
    out.close();
    if (out) continue;
    remove_parts();
    throw WriteError("error: " + path(name).string() + " cannot be written");
  }
  for (const auto& file : files) {
    std::filesystem::rename(path(file.first + kPart), path(file.first), error);
    if (!error) continue;
    const std::string why = error.message();
    remove_parts();
    throw WriteError("error: " + path(file.first).string() + ": " + why);
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
  } catch (const std::domain_error& e) {
    fmt::print(stderr, "error: {}\n", e.what());
    return 5;
  } catch (const std::exception& e) {
    fmt::print(stderr, "internal error: {}\n", e.what());
    return 4;
  }
}

}  // namespace study
