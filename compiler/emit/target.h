// What the emitter needs to know of a model and its functions, free of links and joints.
//
// `compile` fills this in from the model; emit() turns it into files.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "program/program.h"

namespace arboc {

/// Agreement of second derivatives that the reference engine takes as differences of differences,
/// which leave noise also in blocks of zeros: relative to the largest entry of all outputs.
inline constexpr double kDifferencedTwice = 1e-6;

/// An argument of a generated function.
struct Argument {
  std::string name;
  int rows = 0;
  int cols = 1;
  std::string unit;
  std::string meaning;     ///< one line, with the frame
  bool sparse = false;     ///< a matrix of which the structural non-zeros are written, by columns
  bool symmetric = false;  ///< of these the ones in the upper triangle
  bool scalar = false;     ///< a number, not a vector that happens to have one entry
  /// Agreement with the reference engine, relative to the largest entry: rounding of some hundred
  /// operations, or what the engine's own differences are good for.
  double tolerance = 1e-12;

  /// Its name in generated code, where T is the scalar.
  std::string code() const { return name == "T" ? "T_" : name; }
};

/// Structural non-zeros of a matrix output in the order in which they are written: by columns, in
/// each by rows.
struct Pattern {
  std::vector<int> row;
  std::vector<int> col;

  /// Where each of `cols` columns begins, and the end: with `row` compressed column storage.
  std::vector<int> colptr(int cols) const;
};

struct Signature {
  std::string name;
  std::string meaning;
  std::vector<Argument> inputs;
  std::vector<Argument> outputs;
  /// Non-empty: the last output of the program, not of the interface, holds values that must be
  /// positive; the function returns 0 or 1 + the index of the first that is not.
  std::string positive;
};

/// The same function of one state with isomorphic limbs in the lanes of vectors.
struct LaneProgram {
  std::string limbs;  ///< which, in one line
  Program program;
};

struct TargetFunction {
  std::string request;  ///< as on the command line: `rnea`, `--jacobian rnea.tau:q`
  Signature signature;
  std::vector<Pattern> patterns;  ///< per output; of dense ones, written row by row, empty
  Program program;
  std::optional<LaneProgram> lanes{};  ///< where that needs fewer operations

  /// Entries that are written for an output.
  int entries(size_t output) const {
    const Argument& a = signature.outputs[output];
    return a.sparse ? static_cast<int>(patterns[output].row.size()) : a.rows * a.cols;
  }
};

/// A function of the C interface: what CasADi calls an external function.
struct ExternalFunction {
  std::string name;       ///< in the model's name space: rnea
  bool jacobian = false;  ///< it is the Jacobian of that function
  /// Inputs are dense; those behind the program's, the function's outputs in a Jacobian, are not
  /// looked at.
  Signature signature;
  std::vector<Pattern> patterns;  ///< per output, dense ones too: what is written, by columns
  Program program;
};

/// Files of a folder: relative path -> bytes.
using Files = std::map<std::string, std::string>;

/// Arguments and results of one state, dense, by name ("q", "rnea.tau"), and the configurations
/// before and after it on its motion ("q-", "q+", a step of `step` s away).
struct Recording {
  std::map<std::string, std::vector<double>> values;
  /// Of results that are too large l^T Y r for some weights l and r of rows and columns, the same
  /// as in NAME_selftest.cpp.
  std::map<std::string, std::vector<double>> projections;
};

struct Table {
  std::string name;
  std::vector<double> values;
};

/// An input that stands for numbers of the model.
struct ParameterTable {
  std::string name, unit, meaning;
  std::vector<std::string> labels;  ///< one an entry
  std::vector<double> nominal;      ///< as the model has them
};

/// What T is in a translation unit of its own.
struct Scalar {
  std::string name = "double";  ///< in file names and options: double, float, double8, float16 ...
  std::string base = "double";
  int lanes = 1;
  std::string type() const;  ///< double, arboc::Pack<float, 16> ...
};

struct TargetModel {
  std::string name;         ///< identifier: namespace, file prefix
  std::string source_file;  ///< base name
  std::string source_sha256;
  std::vector<std::string> options;  ///< those that differ from their defaults, sorted
  int nq = 0, nv = 0;
  std::vector<std::string> joint_names;     ///< moving joints in the order of their coordinates
  std::vector<std::string> velocity_names;  ///< one an entry of v
  std::vector<std::string> frame_names;     ///< rows of fk and of frame functions
  std::vector<std::string> load_names;      ///< rows of f_ext
  std::string axes;                         ///< of frames and loads: local, world or aligned
  std::vector<std::string> joint_forces;    ///< what joints add by themselves: damping ...
  double friction_velocity = 0;             ///< rad/s, m/s; below it friction is smooth
  std::vector<ParameterTable> parameters;   ///< numbers of the model that are inputs
  std::vector<Table> limits;                ///< q_lower, q_upper (nq), v_limit, tau_limit (nv)
  std::vector<TargetFunction> functions;
  bool cpp = true;                          ///< emit the functions in C++
  std::vector<ExternalFunction> externals;  ///< what is emitted in C
  std::vector<Scalar> scalars{Scalar{}};    ///< for which functions are compiled
  std::vector<Recording> recordings;        ///< for the selftest
  double step = 1e-4;                       ///< s, of the recordings
  std::string manifest_extra;               ///< JSON text of the members that only the front knows
};

}  // namespace arboc
