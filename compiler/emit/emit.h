// TargetModel -> the files of its folder, in C++.
#pragma once
#include "emit/target.h"

namespace arboc {

/// The folder: NAME_raw.hpp, NAME_<function>.hpp and _double.cpp, NAME.hpp,
/// NAME_batch.hpp, NAME_selftest.cpp, CMakeLists.txt, arboc/*.hpp, manifest.json.  The same bytes
/// for the same model, options and version.
Files emit_cpp(const TargetModel& model);

/// manifest.json: version, model, options, conventions, functions with shapes, units, sparsity and
/// operations, and the SHA-256 of each of `files`.
std::string manifest(const TargetModel& model, const Files& files);

/// The version of the compiler.
const char* version();

// The parts of emit_cpp.
std::string banner(const TargetModel& model);
std::string parameters(const TargetFunction& function, const std::string& scalar,
                       const std::string& qualifier = "");
/// `void`, or of a checked function its status.
std::string result_type(const TargetFunction& function, const std::string& scalar);
std::string function_header(const TargetModel& model, const TargetFunction& function);
std::string raw_header(const TargetModel& model);
std::string eigen_header(const TargetModel& model);
std::string batch_header(const TargetModel& model);
std::string selftest(const TargetModel& model);

}  // namespace arboc
