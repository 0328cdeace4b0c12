// TargetModel -> the files of its folder.
#pragma once
#include "emit/target.h"

namespace arboc {

/// The folder: in C++ NAME_raw.hpp, NAME_<function>.hpp and _<scalar>.cpp, NAME.hpp,
/// NAME_batch.hpp, NAME_selftest.cpp; in C NAME_casadi.h, NAME_<function>.c and
/// jac_NAME_<function>.c; beside them CMakeLists.txt, arboc/*, manifest.json.  The same bytes for
/// the same model, options and version.
Files emit(const TargetModel& model);

/// manifest.json: version, model, options, conventions, functions with shapes, units, sparsity and
/// operations, and the SHA-256 of each of `files`.
std::string manifest(const TargetModel& model, const Files& files);

/// The version of the compiler.
const char* version();

// The parts of emit.
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
std::string casadi_header(const TargetModel& model);
std::string c_function(const TargetModel& model, const ExternalFunction& function);
/// A function as an ES module, of those without special functions and checks.
std::string js_function(const TargetModel& model, const TargetFunction& function);
/// ur5_rnea, jac_ur5_rnea
std::string external_symbol(const TargetModel& model, const ExternalFunction& function);

}  // namespace arboc
