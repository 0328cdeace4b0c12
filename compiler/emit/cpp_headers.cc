// NAME_raw.hpp: declarations, constants, sparsity.
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

/// `inline constexpr int NAME = INDEX;` of each text, under names that differ from one another and
/// from those in `taken`.
std::string indices(const std::vector<std::string>& texts, std::set<std::string> taken = {}) {
  std::string out;
  for (size_t i = 0; i < texts.size(); ++i) {
    const std::string wanted = identifier(texts[i]);
    std::string name = wanted;
    for (int n = 2; !taken.insert(name).second; ++n) name = fmt::format("{}_{}", wanted, n);
    out += fmt::format("inline constexpr int {} = {};\n", name, i);
  }
  return out;
}

std::string in_namespace(const std::string& name, const std::string& text) {
  return fmt::format("namespace {0} {{\n{1}}}  // namespace {0}\n", name, text);
}

/// The same, with their number and the texts themselves.
std::string named_indices(const std::vector<std::string>& texts) {
  return fmt::format("inline constexpr int count = {};\n", texts.size()) +
         array("const char*", "names", literals(texts)) + indices(texts, {"count", "names"});
}

std::string frames(const TargetModel& model) {
  std::string out;
  if (!model.frame_names.empty())
    out +=
        "\n/// Frames in the order of fk and of the frame functions: row k of what has one row a "
        "frame.\n" +
        in_namespace("frame", named_indices(model.frame_names));
  if (!model.load_names.empty())
    out +=
        "\n/// Loaded links in the order of f_ext: the wrench on link k begins at f_ext[6 * k].\n" +
        in_namespace("load", named_indices(model.load_names));
  return out;
}

/// Per group of parameters the labels and nominal values of its entries, and their indices.
std::string parameter_tables(const TargetModel& model) {
  std::string groups;
  for (const ParameterTable& p : model.parameters) {
    std::vector<std::string> values;
    for (const double x : p.nominal) values.push_back(number(x));
    groups +=
        fmt::format("/// {}; {}\n", p.unit, p.meaning) +
        in_namespace(p.name, fmt::format("inline constexpr int count = {};\n", values.size()) +
                                 array("const char*", "names", literals(p.labels)) +
                                 array("double", "nominal", values) +
                                 indices(p.labels, {"count", "names", "nominal"}));
  }
  if (groups.empty()) return "";
  return "\n/// Numbers of the model that are inputs: an entry a name, as the model has them, and "
         "indices.\n" +
         in_namespace("parameter", groups);
}

template <class Visit>
void for_each_sparse(const TargetModel& model, const Visit& visit) {
  for (const TargetFunction& f : model.functions)
    for (size_t k = 0; k < f.signature.outputs.size(); ++k)
      if (f.signature.outputs[k].sparse)
        visit(f.signature.name + "_" + f.signature.outputs[k].name, f.signature.outputs[k],
              f.patterns[k]);
}

std::string sparsity(const TargetModel& model) {
  std::string out;
  for_each_sparse(model, [&](const std::string& name, const Argument& a, const Pattern& pattern) {
    out += fmt::format("inline constexpr int {}_nnz = {};\n", name, pattern.row.size());
    out += array("int", name + "_row", integers(pattern.row));
    out += array("int", name + "_col", integers(pattern.col));
    out += array("int", name + "_colptr", integers(pattern.colptr(a.cols)));
  });
  if (out.empty()) return out;
  return "\n/// Where the structural non-zeros of matrices stand, in the order in which raw "
         "functions write\n"
         "/// them: by columns, of symmetric matrices the upper triangle.  Column j has those "
         "from\n"
         "/// colptr[j] to before colptr[j + 1], so that row and colptr are compressed column "
         "storage.\n" +
         in_namespace("sparsity", out);
}

constexpr const char* kScatter = R"(
namespace detail {

/// Zeros `size` entries of `dense`, then puts each non-zero where it stands, of a symmetric matrix
/// also into the lower triangle; entry (i, j) is dense[i * row_step + j * col_step].
template <class T>
void scatter(const T* entries, int nnz, const int* row, const int* col, bool symmetric, T* dense,
             int size, int row_step, int col_step) {
  for (int k = 0; k < size; ++k) dense[k] = T(0);
  for (int k = 0; k < nnz; ++k) {
    dense[row[k] * row_step + col[k] * col_step] = entries[k];
    if (symmetric) dense[col[k] * row_step + row[k] * col_step] = entries[k];
  }
}

}  // namespace detail
)";

/// Functions that make dense matrices of what raw functions write.
std::string scatters(const TargetModel& model) {
  std::string out;
  for_each_sparse(model, [&](const std::string& name, const Argument& a, const Pattern&) {
    out += fmt::format(
        "template <class T>\n"
        "void scatter_{0}(const T* entries, T* dense, int row_step = {1}, int col_step = 1) {{\n"
        "  detail::scatter(entries, sparsity::{0}_nnz, sparsity::{0}_row, sparsity::{0}_col, {2}, "
        "dense, {3},\n                  row_step, col_step);\n}}\n",
        name, a.cols, a.symmetric, a.rows * a.cols);
  });
  if (out.empty()) return out;
  return "// scatter_FUNCTION_OUTPUT: what a raw function writes as a dense matrix, by rows unless "
         "other\n// steps are given.\n" +
         out + "\n";
}

}  // namespace

std::string raw_header(const TargetModel& model) {
  std::string constants =
      names("Moving joints in the order of their coordinates.", "joint_names", model.joint_names) +
      names("One name an entry of v, a and tau.", "velocity_names", model.velocity_names) +
      "/// Limits as the model states them (rad, m, rad/s, m/s, N m, N); infinite where it has "
      "none.\n" +
      limits(model) + frames(model) + parameter_tables(model) + sparsity(model);
  const std::string dense = scatters(model);
  if (!dense.empty()) constants += kScatter;
  std::string declarations;
  for (const TargetFunction& f : model.functions) {
    declarations +=
        fmt::format("/// {}\ntemplate <class T>\n{} {}({}) noexcept;\n", f.signature.meaning,
                    result_type(f, "T"), f.signature.name, parameters(f, "T"));
    declarations +=
        fmt::format("extern template {} {}<double>({}) noexcept;\n\n", result_type(f, "double"),
                    f.signature.name, parameters(f, "double"));
  }
  return fill("cpp/NAME_raw.hpp", {{"banner", banner(model)},
                                   {"name", model.name},
                                   {"nq", fmt::format("{}", model.nq)},
                                   {"nv", fmt::format("{}", model.nv)},
                                   {"constants", constants},
                                   {"declarations", declarations + dense}});
}

}  // namespace arboc
