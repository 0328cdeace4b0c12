// NAME_batch.hpp: one type a function, with what is known of its arguments and a call by arrays.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "emit/emit.h"
#include "emit/names.h"
#include "emit/template.h"

namespace arboc {
namespace {

/// `  static constexpr TYPE NAME[N] = {...};`
std::string member(const std::string& type, const std::string& name,
                   const std::vector<std::string>& values) {
  return fmt::format("  static constexpr {} {}[{}] = {{{}}};\n", type, name,
                     std::max<size_t>(values.size(), 1), fmt::join(values, ", "));
}

/// Sizes and names of the inputs.
std::string inputs(const Signature& s) {
  std::vector<std::string> sizes, names;
  for (const Argument& a : s.inputs) {
    sizes.push_back(fmt::format("{}", a.rows * a.cols));
    names.push_back(string_literal(a.name));
  }
  return member("int", "input_size", sizes) + member("const char*", "input_name", names);
}

/// The same of the outputs, and where their entries stand.
std::string outputs(const TargetFunction& f) {
  std::vector<std::string> sizes, names, rows, cols, row, col, symmetric;
  for (size_t k = 0; k < f.signature.outputs.size(); ++k) {
    const Argument& a = f.signature.outputs[k];
    const std::string where = fmt::format("sparsity::{}_{}", f.signature.name, a.name);
    sizes.push_back(fmt::format("{}", f.entries(k)));
    names.push_back(string_literal(a.name));
    rows.push_back(fmt::format("{}", a.rows));
    cols.push_back(fmt::format("{}", a.cols));
    row.push_back(a.sparse ? where + "_row" : "nullptr");
    col.push_back(a.sparse ? where + "_col" : "nullptr");
    symmetric.push_back(a.symmetric ? "true" : "false");
  }
  return member("int", "output_size", sizes) + member("const char*", "output_name", names) +
         member("int", "output_rows", rows) + member("int", "output_cols", cols) +
         member("const int*", "output_row", row) + member("const int*", "output_col", col) +
         member("bool", "output_symmetric", symmetric);
}

std::string function_type(const TargetFunction& f) {
  const Signature& s = f.signature;
  std::string arguments;
  for (size_t k = 0; k < s.inputs.size(); ++k) arguments += fmt::format("in[{}], ", k);
  for (size_t k = 0; k < s.outputs.size(); ++k)
    arguments += fmt::format("{}out[{}]", k ? ", " : "", k);
  std::string out = fmt::format("/// {}\nstruct {}_fn {{\n", s.meaning, s.name);
  out += fmt::format("  static constexpr const char* name = \"{}\";\n", s.name);
  out += fmt::format("  static constexpr int inputs = {}, outputs = {};\n", s.inputs.size(),
                     s.outputs.size());
  out += inputs(s) + outputs(f);
  out +=
      "  template <class T>\n"
      "  static arboc::status_t<T> call(const T* const* in, T* const* out) noexcept {\n";
  if (s.inputs.empty()) out += "    static_cast<void>(in);\n";
  out += s.positive.empty()
             ? fmt::format("    raw::{}<T>({});\n    return {{}};\n", s.name, arguments)
             : fmt::format("    return raw::{}<T>({});\n", s.name, arguments);
  return out + "  }\n};\n\n";
}

}  // namespace

std::string batch_header(const TargetModel& model) {
  std::string functions;
  for (const TargetFunction& f : model.functions) functions += function_type(f);
  return fill("cpp/NAME_batch.hpp",
              {{"banner", banner(model)}, {"name", model.name}, {"functions", functions}});
}

}  // namespace arboc
