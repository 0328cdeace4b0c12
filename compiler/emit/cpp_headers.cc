// NAME_raw.hpp and NAME.hpp: declarations and constants, and the Eigen interface over them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/number.h"
#include "emit/emit.h"
#include "emit/names.h"
#include "emit/template.h"

namespace arboc {
namespace {

std::string number(double x) {
  if (std::isfinite(x)) return literal(x);
  return fmt::format("{}std::numeric_limits<double>::infinity()", x < 0 ? "-" : "");
}

/// `inline constexpr TYPE NAME[N] = {items};`, wrapped; of no items `NAME[1] = {}`.
std::string array(const std::string& type, const std::string& name,
                  const std::vector<std::string>& items) {
  if (items.empty()) return fmt::format("inline constexpr {} {}[1] = {{}};\n", type, name);
  std::string out = fmt::format("inline constexpr {} {}[{}] = {{", type, name, items.size());
  size_t column = 100;
  for (const std::string& item : items) {
    if (column + item.size() > 94) {
      out += "\n    ";
      column = 4;
    } else {
      out += ' ';
    }
    out += item + (&item == &items.back() ? "" : ",");
    column += item.size() + 2;
  }
  return out + "};\n";
}

std::vector<std::string> literals(const std::vector<std::string>& texts) {
  std::vector<std::string> out;
  for (const std::string& text : texts) out.push_back(string_literal(text));
  return out;
}

std::vector<std::string> integers(const std::vector<int>& values) {
  std::vector<std::string> out;
  for (const int value : values) out.push_back(fmt::format("{}", value));
  return out;
}

std::string names(const std::string& what, const std::string& array_name,
                  const std::vector<std::string>& texts) {
  if (texts.empty()) return "";
  return fmt::format("/// {}\n", what) + array("const char*", array_name, literals(texts));
}

std::string limits(const TargetModel& model) {
  std::string out;
  for (const Table& table : model.limits) {
    std::vector<std::string> items;
    for (const double x : table.values) items.push_back(number(x));
    out += array("double", table.name, items);
  }
  return out;
}

/// Indices of the frames of fk by name.
std::string frames(const TargetModel& model) {
  if (model.frame_names.empty()) return "";
  std::string out = "\n/// Rows of fk's output.\nnamespace frame {\n";
  std::set<std::string> taken;
  for (size_t i = 0; i < model.frame_names.size(); ++i) {
    std::string name = identifier(model.frame_names[i]);
    for (int n = 2; !taken.insert(name).second; ++n)
      name = fmt::format("{}_{}", identifier(model.frame_names[i]), n);
    out += fmt::format("inline constexpr int {} = {};\n", name, i);
  }
  return out + "}  // namespace frame\n";
}

std::string sparsity(const TargetModel& model) {
  std::string out;
  for (const TargetFunction& f : model.functions) {
    for (size_t i = 0; i < f.patterns.size(); ++i) {
      if (!f.signature.outputs[i].sparse) continue;
      const std::string name = f.signature.name + "_" + f.signature.outputs[i].name;
      out += fmt::format("inline constexpr int {}_nnz = {};\n", name, f.patterns[i].row.size());
      out += array("int", name + "_row", integers(f.patterns[i].row));
      out += array("int", name + "_col", integers(f.patterns[i].col));
    }
  }
  if (out.empty()) return out;
  return "\n/// Where the structural non-zeros of matrices stand, in the order in which raw "
         "functions write\n"
         "/// them: by columns, of symmetric matrices the upper triangle.\nnamespace sparsity {\n" +
         out + "}  // namespace sparsity\n";
}

/// The type of an argument in the Eigen interface.
std::string eigen_type(const TargetModel& model, const Argument& a) {
  if (a.name == "q") return "Config";
  if (a.cols == 1 && a.rows == model.nv) return "Tangent";
  if (a.sparse && a.rows == model.nv && a.cols == model.nv) return "Matrix";
  return fmt::format("Eigen::Matrix<double, {}, {}, Eigen::RowMajor>", a.rows, a.cols);
}

/// `const Config& q, const Tangent& v`.
std::string eigen_inputs(const TargetModel& model, const Signature& s) {
  std::string out;
  for (const Argument& a : s.inputs)
    out += fmt::format("{}const {}& {}", out.empty() ? "" : ", ", eigen_type(model, a), a.name);
  return out;
}

/// Statements that scatter `entries` of an output into the dense matrix `into`.
std::string scatter(const std::string& function, const Argument& a, const std::string& entries,
                    const std::string& into, const std::string& indent) {
  const std::string at = fmt::format("sparsity::{}_{}", function, a.name);
  std::string out = fmt::format("{0}for (int k = 0; k < {1}_nnz; ++k) {{\n", indent, at);
  out += fmt::format("{0}  {1}({2}_row[k], {2}_col[k]) = {3}[k];\n", indent, into, at, entries);
  if (a.symmetric)
    out += fmt::format("{0}  {1}({2}_col[k], {2}_row[k]) = {3}[k];\n", indent, into, at, entries);
  return out + indent + "}\n";
}

/// Value interface of a function with one output.
std::string eigen_function(const TargetModel& model, const TargetFunction& f) {
  const Signature& s = f.signature;
  const Argument& result = s.outputs.front();
  const bool checked = !s.positive.empty();
  std::string call = fmt::format("raw::{}<double>(", s.name);
  for (const Argument& a : s.inputs) call += a.name + ".data(), ";
  const std::string type = eigen_type(model, result);
  std::string out = fmt::format("/// {}\n", s.meaning);
  if (checked)
    out += fmt::format("/// `status`, if given, receives what raw::{} returns.\n", s.name);
  out += fmt::format("inline {} {}({}{}) {{\n", type, s.name, eigen_inputs(model, s),
                     checked ? ", int* status = nullptr" : "");
  const std::string store = checked ? "const int failed = " : "";
  if (result.sparse) {
    out += fmt::format("  double entries[{}];\n  {}{}entries);\n", std::max(1, f.entries(0)), store,
                       call);
    out += fmt::format("  {0} {1} = {0}::Zero({2}, {3});\n", type, result.name, result.rows,
                       result.cols);
    out += scatter(s.name, result, "entries", result.name, "  ");
  } else {
    out +=
        fmt::format("  {} {};\n  {}{}{}.data());\n", type, result.name, store, call, result.name);
  }
  if (checked) out += "  if (status) *status = failed;\n";
  return out + fmt::format("  return {};\n}}\n\n", result.name);
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

/// The same with several outputs: a struct of pointers, of which those given are filled in.
std::string eigen_function_of_many(const TargetModel& model, const TargetFunction& f) {
  const Signature& s = f.signature;
  const std::string type = camel_case(s.name);
  std::string out = fmt::format(
      "/// Outputs of {}; those left null are not wanted.\nstruct {} {{\n", s.name, type);
  for (const Argument& a : s.outputs)
    out += fmt::format("  {}* {} = nullptr;\n", eigen_type(model, a), a.name);
  out += fmt::format("}};\n/// {}\ninline void {}({}, const {}& out) {{\n", s.meaning, s.name,
                     eigen_inputs(model, s), type);
  std::string arguments, results;
  for (const Argument& a : s.inputs) arguments += a.name + ".data(), ";
  for (size_t k = 0; k < s.outputs.size(); ++k) {
    const Argument& a = s.outputs[k];
    out += fmt::format("  double {}[{}];\n", a.name, std::max(1, f.entries(k)));
    arguments += a.name + (k + 1 < s.outputs.size() ? ", " : "");
    results += fmt::format("  if (out.{}) {{\n", a.name);
    if (a.sparse) {
      results += fmt::format("    out.{}->setZero({}, {});\n", a.name, a.rows, a.cols);
      results += scatter(s.name, a, a.name, fmt::format("(*out.{})", a.name), "    ");
    } else {
      results +=
          fmt::format("    *out.{0} = Eigen::Map<const {1}>({0});\n", a.name, eigen_type(model, a));
    }
    results += "  }\n";
  }
  return out + fmt::format("  raw::{}<double>({});\n{}}}\n\n", s.name, arguments, results);
}

}  // namespace

std::string raw_header(const TargetModel& model) {
  std::string constants =
      names("Moving joints in the order of their coordinates.", "joint_names", model.joint_names) +
      names("One name an entry of v, a and tau.", "velocity_names", model.velocity_names) +
      "/// Limits as the model states them (rad, m, rad/s, m/s, N m, N); infinite where it has "
      "none.\n" +
      limits(model) + frames(model) + sparsity(model);
  std::string declarations;
  for (const TargetFunction& f : model.functions) {
    const char* result = f.signature.positive.empty() ? "void" : "int";
    declarations += fmt::format("/// {}\ntemplate <class T>\n{} {}({}) noexcept;\n",
                                f.signature.meaning, result, f.signature.name, parameters(f, "T"));
    declarations += fmt::format("extern template {} {}<double>({}) noexcept;\n\n", result,
                                f.signature.name, parameters(f, "double"));
  }
  return fill("cpp/NAME_raw.hpp", {{"banner", banner(model)},
                                   {"name", model.name},
                                   {"nq", fmt::format("{}", model.nq)},
                                   {"nv", fmt::format("{}", model.nv)},
                                   {"constants", constants},
                                   {"declarations", declarations}});
}

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
