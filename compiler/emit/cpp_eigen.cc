// NAME.hpp: the Eigen interface over the raw functions.
//
// Matrices are column-major, Eigen's default, but for those that hold one row a frame; what has
// more than 64 x 64 entries is on the heap.
#include <fmt/format.h>

#include <algorithm>

#include "emit/emit.h"
#include "emit/template.h"

namespace arboc {
namespace {

constexpr int kLargest = 64 * 64;  // entries on the stack

bool on_heap(const Argument& a) { return a.rows * a.cols > kLargest; }

/// The type of an argument.
std::string eigen_type(const TargetModel& model, const Argument& a) {
  if (a.scalar) return "double";
  if (a.cols == 1 && !a.sparse) {
    if (a.name == "q" || a.name == "q1" || a.name == "q_next") return "Config";
    if (a.rows == model.nv) return "Tangent";
    return on_heap(a) ? "Eigen::VectorXd" : fmt::format("Eigen::Matrix<double, {}, 1>", a.rows);
  }
  if (a.sparse && a.rows == model.nv && a.cols == model.nv) return "Matrix";
  if (a.sparse && on_heap(a)) return "Eigen::MatrixXd";
  const std::string size =
      on_heap(a) ? "Eigen::Dynamic, Eigen::Dynamic" : fmt::format("{}, {}", a.rows, a.cols);
  return fmt::format("Eigen::Matrix<double, {}{}>", size, a.sparse ? "" : ", Eigen::RowMajor");
}

/// `(rows, cols)` where a variable of the type needs to be told.
std::string extent(const Argument& a) {
  if (!on_heap(a)) return "";
  return a.cols == 1 && !a.sparse ? fmt::format("({})", a.rows)
                                  : fmt::format("({}, {})", a.rows, a.cols);
}

/// `const Config& q, const Tangent& v`.
std::string eigen_inputs(const TargetModel& model, const Signature& s) {
  std::string out;
  for (const Argument& a : s.inputs)
    out += fmt::format("{}const {}& {}", out.empty() ? "" : ", ", eigen_type(model, a), a.code());
  return out;
}

/// `q.data(), v.data(), ` for the raw function.
std::string input_pointers(const Signature& s) {
  std::string out;
  for (const Argument& a : s.inputs) out += a.code() + ".data(), ";
  return out;
}

/// Room for `n` numbers, and below how a raw function is given it.
std::string buffer(const std::string& name, int n) {
  return n > kLargest ? fmt::format("  Eigen::VectorXd {}({});\n", name, n)
                      : fmt::format("  double {}[{}];\n", name, std::max(1, n));
}
std::string pointer(const std::string& name, int n) {
  return n > kLargest ? name + ".data()" : name;
}

/// The statement that makes a matrix of the structural non-zeros.
std::string scatter(const std::string& function, const Argument& a, const std::string& entries,
                    const std::string& into) {
  return fmt::format("raw::scatter_{}_{}({}, {}data(), 1, {});\n", function, a.name, entries, into,
                     a.rows);
}

/// Value interface of a function with one output.
std::string eigen_function(const TargetModel& model, const TargetFunction& f) {
  const Signature& s = f.signature;
  const Argument& result = s.outputs.front();
  const bool checked = !s.positive.empty();
  const std::string type = eigen_type(model, result), name = result.code();
  std::string out = fmt::format("/// {}\n", s.meaning);
  if (checked)
    out += fmt::format("/// `status`, if given, receives what raw::{} returns.\n", s.name);
  out += fmt::format("inline {} {}({}{}) {{\n", type, s.name, eigen_inputs(model, s),
                     checked ? ", int* status = nullptr" : "");
  const std::string call = fmt::format(
      "  {}raw::{}<double>({}", checked ? "const int failed = " : "", s.name, input_pointers(s));
  if (result.sparse) out += buffer("entries", f.entries(0));
  out += fmt::format("  {} {}{};\n", type, name, extent(result));
  if (result.sparse)
    out += fmt::format("{}{});\n  {}", call, pointer("entries", f.entries(0)),
                       scatter(s.name, result, pointer("entries", f.entries(0)), name + "."));
  else
    out += fmt::format("{}{});\n", call, result.scalar ? "&" + name : name + ".data()");
  if (checked) out += "  if (status) *status = failed;\n";
  return out + fmt::format("  return {};\n}}\n\n", name);
}

/// rnea_derivatives -> RneaDerivatives.
std::string camel_case(const std::string& name) {
  std::string out;
  bool capital = true;
  for (const char c : name) {
    if (c != '_') out += capital && c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    capital = c == '_';
  }
  return out;
}

/// Hands one of several outputs over, if it is wanted.
std::string deliver(const TargetModel& model, const TargetFunction& f, size_t k) {
  const Argument& a = f.signature.outputs[k];
  const std::string name = a.code(), from = pointer(name, f.entries(k));
  std::string out = fmt::format("  if (out.{}) {{\n", name);
  if (a.sparse) {
    if (on_heap(a)) out += fmt::format("    out.{}->resize{};\n", name, extent(a));
    out += "    " + scatter(f.signature.name, a, from, "out." + name + "->");
  } else if (a.scalar) {
    out += fmt::format("    *out.{0} = {0}[0];\n", name);
  } else {
    out +=
        fmt::format("    *out.{0} = Eigen::Map<const {1}>({2}{3});\n", name, eigen_type(model, a),
                    from, on_heap(a) ? ", " + extent(a).substr(1, extent(a).size() - 2) : "");
  }
  return out + "  }\n";
}

/// The same with several outputs: a struct of pointers, of which those given are filled in.
std::string eigen_function_of_many(const TargetModel& model, const TargetFunction& f) {
  const Signature& s = f.signature;
  const bool checked = !s.positive.empty();
  const std::string type = camel_case(s.name);
  std::string out = fmt::format(
      "/// Outputs of {}; those left null are not wanted.\nstruct {} {{\n", s.name, type);
  for (const Argument& a : s.outputs)
    out += fmt::format("  {}* {} = nullptr;  ///< {}; {}\n", eigen_type(model, a), a.code(), a.unit,
                       a.meaning);
  out += fmt::format("}};\n/// {}\n", s.meaning);
  if (checked) out += fmt::format("/// Returns what raw::{} returns.\n", s.name);
  out += fmt::format("inline {} {}({}, const {}& out) {{\n", checked ? "int" : "void", s.name,
                     eigen_inputs(model, s), type);
  std::string arguments = input_pointers(s), results;
  for (size_t k = 0; k < s.outputs.size(); ++k) {
    const std::string name = s.outputs[k].code();
    out += buffer(name, f.entries(k));
    arguments += pointer(name, f.entries(k)) + (k + 1 < s.outputs.size() ? ", " : "");
    results += deliver(model, f, k);
  }
  return out + fmt::format("  {}raw::{}<double>({});\n{}{}}}\n\n",
                           checked ? "const int failed = " : "", s.name, arguments, results,
                           checked ? "  return failed;\n" : "");
}

}  // namespace

std::string eigen_header(const TargetModel& model) {
  std::string functions;
  for (const TargetFunction& f : model.functions)
    functions += f.signature.outputs.size() == 1 ? eigen_function(model, f)
                                                 : eigen_function_of_many(model, f);
  const char* alias = "using Vector = Tangent;  ///< where nq == nv\n";
  return fill("cpp/NAME.hpp", {{"banner", banner(model)},
                               {"name", model.name},
                               {"vector_alias", model.nq == model.nv ? alias : ""},
                               {"functions", functions}});
}

}  // namespace arboc
