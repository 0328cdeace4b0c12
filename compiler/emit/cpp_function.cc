// The header of one function: its chunks as noinline parts, and the function that calls them.
#include <fmt/format.h>

#include "base/number.h"
#include "emit/arrays.h"
#include "emit/emit.h"
#include "emit/names.h"
#include "emit/template.h"

namespace arboc {
namespace {

/// `const T* q, T* tau, T* w` or, without types, `q, tau, w`.
std::string list(const Program& program, const Arrays& arrays, bool types) {
  std::string out;
  const auto append = [&](const std::string& type, const std::string& name) {
    out += (out.empty() ? "" : ", ") + (types ? type : "") + name;
  };
  for (const int p : arrays.inputs)
    append("const T* ARBOC_RESTRICT ", program.inputs[static_cast<size_t>(p)].name);
  for (const int p : arrays.outputs)
    append("T* ARBOC_RESTRICT ", program.outputs[static_cast<size_t>(p)].name);
  if (arrays.work) append("T* ARBOC_RESTRICT ", "w");
  return out;
}

std::string statements(const Program& program, const Chunk& chunk, int& block) {
  std::string out;
  const auto line = [&](const std::string& text) { out += "  " + text + ";\n"; };
  for (const Statement& s : chunk.statements) {
    if (s.block != block)
      out += fmt::format("  // {}\n",
                         comment_text(program.blocks[static_cast<size_t>(block = s.block)]));
    line(fmt::format("const T x{} = {}", s.local, text(program, s)));
    if (s.slot >= 0) line(fmt::format("w[{}] = x{}", s.slot, s.local));
    for (const Store& store : s.stores)
      line(fmt::format("{}[{}] = {}", program.outputs[static_cast<size_t>(store.port)].name,
                       store.index, text(program, store.value)));
  }
  return out;
}

class Function {
 public:
  Function(const TargetModel& model, const TargetFunction& function)
      : model_(model), function_(function), program_(function.program) {}

  std::string run() {
    const bool angles = !program_.angles.empty();
    std::string parts, calls;
    if (angles) add_part(parts, calls, "angles", angle_arrays(), angle_body());
    int block = -1;
    for (size_t c = 0; c < program_.chunks.size(); ++c) {
      Arrays arrays;
      arrays.chunk(program_.chunks[c]);
      const std::string body = statements(program_, program_.chunks[c], block);
      if (!body.empty()) add_part(parts, calls, fmt::format("part{}", c), arrays, body);
    }
    return fill("cpp/NAME_FUNCTION.hpp",
                {{"banner", banner(model_)},
                 {"name", model_.name},
                 {"function", program_.name},
                 {"parts", parts},
                 {"documentation", documentation()},
                 {"result", result_type(function_, "T")},
                 {"parameters", parameters(function_, "T", " ARBOC_RESTRICT")},
                 {"body", body(calls)}});
  }

 private:
  void add_part(std::string& parts, std::string& calls, const std::string& name,
                const Arrays& arrays, const std::string& body) {
    used_.add(arrays);
    parts += fmt::format("template <class T>\nARBOC_NOINLINE void {}({}) noexcept {{\n{}}}\n\n",
                         name, list(program_, arrays, true), body);
    calls +=
        fmt::format("  {}_parts::{}<T>({});\n", program_.name, name, list(program_, arrays, false));
  }

  Arrays angle_arrays() const {
    Arrays arrays;
    arrays.chunk(program_.prologue);
    for (const Operand& angle : program_.angles) arrays.read(angle);
    arrays.work = true;
    return arrays;
  }

  std::string angle_body() const {
    int block = -1;
    std::string out = statements(program_, program_.prologue, block);
    const size_t n = program_.angles.size();
    if (n == 1)
      return out +
             fmt::format("  sincos(T({}), w[0], w[1]);\n", text(program_, program_.angles[0]));
    std::string groups;
    for (size_t k = 0; k < n; ++k)
      groups += (k % 4 ? ", " : k ? "},\n      {" : "{") + text(program_, program_.angles[k]);
    const size_t count = (n + 3) / 4;
    return out +
           fmt::format(
               "  const arboc::Angles<T> angle[{0}] = {{\n      {1}}}}};\n"
               "  for (int k = 0; k < {0}; ++k) angle[k].sincos_to(w + 4 * k, w + {2} + 4 * k);\n",
               count, groups, program_.angle_stride);
  }

  std::string body(const std::string& calls) {
    std::string out;
    const auto& outputs = program_.outputs;
    const bool checked = !function_.signature.positive.empty();
    if (program_.slots > 0 && used_.work) out += fmt::format("  T w[{}];\n", program_.slots);
    if (checked) out += fmt::format("  T {}[{}];\n", outputs.back().name, outputs.back().size);
    out += calls;
    for (const Store& store : program_.stores) {
      used_.store(store);
      out += fmt::format("  {}[{}] = {};\n", outputs[static_cast<size_t>(store.port)].name,
                         store.index, text(program_, store.value));
    }
    for (size_t p = 0; p < program_.inputs.size(); ++p)
      if (!used_.inputs.contains(static_cast<int>(p)))
        out += fmt::format("  static_cast<void>({});\n", program_.inputs[p].name);
    for (size_t p = 0; p < outputs.size(); ++p)
      if (!used_.outputs.contains(static_cast<int>(p)))
        out += fmt::format("  static_cast<void>({});\n", outputs[p].name);
    if (checked) {
      out += fmt::format("  const arboc::status_t<T> status = arboc::check_positive({}, {});\n",
                         outputs.back().name, outputs.back().size);
      for (size_t k = 0; k + 1 < outputs.size(); ++k)
        out +=
            fmt::format("  arboc::fill_nan(status, {}, {});\n", outputs[k].name, outputs[k].size);
      out += "  return status;\n";
    }
    return out;
  }

  std::string documentation() const {
    const Signature& s = function_.signature;
    std::string out = fmt::format("/// {}\n", s.meaning);
    const auto describe = [&](const Argument& a, const char* direction, const std::string& shape) {
      out += fmt::format("/// {} {}: {}; {}; {}\n", direction, a.code(), shape, a.unit, a.meaning);
    };
    const auto dense = [](const Argument& a) {
      return a.cols == 1 ? fmt::format("{} entr{}", a.rows, a.rows == 1 ? "y" : "ies")
                         : fmt::format("{} x {} by rows", a.rows, a.cols);
    };
    for (const Argument& a : s.inputs) describe(a, "in ", dense(a));
    for (size_t i = 0; i < s.outputs.size(); ++i) {
      const Argument& a = s.outputs[i];
      const std::string shape =
          a.sparse
              ? fmt::format("{} structural non-zeros of {} x {} by columns{}", function_.entries(i),
                            a.rows, a.cols, a.symmetric ? ", upper triangle" : "")
              : dense(a);
      describe(a, "out", shape);
    }
    if (!s.positive.empty())
      out += fmt::format(
          "/// Returns 0, or 1 + the index of the first {} that is not positive; then all is "
          "nan.\n",
          s.positive);
    const OpCount& n = program_.ops;
    out += fmt::format("/// {} mul, {} add, {} fma, {} div, {} sqrt, {} sincos", n.mul, n.add,
                       n.fma, n.div, n.sqrt, n.sincos);
    return out + (n.special > 0 ? fmt::format(", {} special.", n.special) : ".");
  }

  const TargetModel& model_;
  const TargetFunction& function_;
  const Program& program_;
  Arrays used_;
};

}  // namespace

std::string result_type(const TargetFunction& function, const std::string& scalar) {
  if (function.signature.positive.empty()) return "void";
  return fmt::format("arboc::status_t<{}>", scalar);
}

std::string parameters(const TargetFunction& function, const std::string& scalar,
                       const std::string& qualifier) {
  std::string out;
  for (const Argument& a : function.signature.inputs)
    out += fmt::format("{}const {}*{} {}", out.empty() ? "" : ", ", scalar, qualifier, a.code());
  for (const Argument& a : function.signature.outputs)
    out += fmt::format("{}{}*{} {}", out.empty() ? "" : ", ", scalar, qualifier, a.code());
  return out;
}

std::string function_header(const TargetModel& model, const TargetFunction& function) {
  return Function(model, function).run();
}

}  // namespace arboc
