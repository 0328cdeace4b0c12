// NAME_raw.hpp and NAME.hpp: declarations and constants, and the Eigen interface over them.
#include <fmt/format.h>

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

/// `inline constexpr TYPE NAME[N] = {items};`, wrapped.
std::string array(const std::string& type, const std::string& name,
                  const std::vector<std::string>& items) {
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
      if (f.patterns[i].row.empty()) continue;
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
  if (a.symmetric) return "Matrix";
  return fmt::format("Eigen::Matrix<double, {}, {}, Eigen::RowMajor>", a.rows, a.cols);
}

/// Value interface of a function with one output.
std::string eigen_function(const TargetModel& model, const TargetFunction& f) {
  const Signature& s = f.signature;
  const Argument& result = s.outputs.front();
  const bool checked = !s.positive.empty();
  std::string inputs, data;
  for (const Argument& a : s.inputs) {
    inputs +=
        fmt::format("{}const {}& {}", inputs.empty() ? "" : ", ", eigen_type(model, a), a.name);
    data += a.name + ".data(), ";
  }
  const std::string type = eigen_type(model, result);
  std::string out = fmt::format("/// {}\n", s.meaning);
  if (checked)
    out += fmt::format("/// `status`, if given, receives what raw::{} returns.\n", s.name);
  out += fmt::format("inline {} {}({}{}) {{\n", type, s.name, inputs,
                     checked ? ", int* status = nullptr" : "");
  const std::string call =
      fmt::format("{}raw::{}<double>({}", checked ? "const int failed = " : "", s.name, data);
  if (f.patterns.front().row.empty()) {
    out += fmt::format("  {} {};\n  {}{}.data());\n", type, result.name, call, result.name);
  } else {
    const std::string nnz = fmt::format("sparsity::{}_{}", s.name, result.name);
    out += fmt::format("  double entries[{0}_nnz];\n  {1}entries);\n", nnz, call);
    out += fmt::format("  {} {} = {}::Zero(nv, nv);\n", type, result.name, type);
    out += fmt::format(
        "  for (int k = 0; k < {0}_nnz; ++k) {{\n    {1}({0}_row[k], {0}_col[k]) = entries[k];\n",
        nnz, result.name);
    if (result.symmetric)
      out += fmt::format("    {1}({0}_col[k], {0}_row[k]) = entries[k];\n", nnz, result.name);
    out += "  }\n";
  }
  if (checked) out += "  if (status) *status = failed;\n";
  return out + fmt::format("  return {};\n}}\n\n", result.name);
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
  for (const TargetFunction& f : model.functions) functions += eigen_function(model, f);
  const char* alias = "using Vector = Tangent;  ///< where nq == nv\n";
  return fill("cpp/NAME.hpp", {{"banner", banner(model)},
                               {"name", model.name},
                               {"vector_alias", model.nq == model.nv ? alias : ""},
                               {"functions", functions}});
}

}  // namespace arboc
