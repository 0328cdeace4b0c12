// NAME_batch.hpp: one type a function, with the sizes of its arguments and a call by arrays.
#include <fmt/format.h>

#include "emit/emit.h"
#include "emit/template.h"

namespace arboc {
namespace {

/// `static constexpr int WHAT_size[N] = {...};`
std::string sizes(const std::string& what, const std::vector<int>& values) {
  if (values.empty()) return fmt::format("  static constexpr int {}_size[1] = {{}};\n", what);
  return fmt::format("  static constexpr int {}_size[{}] = {{{}}};\n", what, values.size(),
                     fmt::join(values, ", "));
}

std::string function_type(const TargetFunction& f) {
  const Signature& s = f.signature;
  std::vector<int> inputs, outputs;
  std::string arguments;
  for (const Argument& a : s.inputs) {
    arguments += fmt::format("in[{}], ", inputs.size());
    inputs.push_back(a.rows * a.cols);
  }
  for (size_t k = 0; k < s.outputs.size(); ++k) {
    arguments += fmt::format("{}out[{}]", k ? ", " : "", k);
    outputs.push_back(f.entries(k));
  }
  std::string out = fmt::format("/// {}\nstruct {}_fn {{\n", s.meaning, s.name);
  out += fmt::format("  static constexpr const char* name = \"{}\";\n", s.name);
  out += fmt::format("  static constexpr int inputs = {}, outputs = {};\n", s.inputs.size(),
                     s.outputs.size());
  out += sizes("input", inputs) + sizes("output", outputs);
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
