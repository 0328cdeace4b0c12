#include "emit/cpp_program.h"

#include <fmt/format.h>

#include <vector>

#include "emit/arrays.h"
#include "emit/cpp_stores.h"
#include "emit/names.h"

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
  for (int width = 2; width <= kMostLanes; ++width)
    if (arrays.lane_work[width])
      append(fmt::format("arboc::lanes_t<T, {}>* ARBOC_RESTRICT ", width),
             fmt::format("w{}", width));
  return out;
}

std::string statements(const Program& program, const Chunk& chunk, int& block) {
  std::string out;
  const auto line = [&](const std::string& text) { out += "  " + text + ";\n"; };
  const auto stores = store_lines(program, chunk);
  for (const Statement& s : chunk.statements) {
    if (s.block != block)
      out += fmt::format("  // {}\n",
                         comment_text(program.blocks[static_cast<size_t>(block = s.block)]));
    const std::string type = s.width == 1 ? "T" : fmt::format("V{}", s.width);
    line(fmt::format("const {} x{} = {}", type, s.local, text(program, s)));
    if (s.slot >= 0) line(fmt::format("{} = x{}", slot_text(s), s.local));
    for (const std::string& store : stores[static_cast<size_t>(&s - chunk.statements.data())])
      line(store);
  }
  return out;
}

/// Names of the vector types that a piece of code uses.
std::string lane_types(const std::string& body) {
  std::string out;
  for (int width = 2; width <= kMostLanes; ++width)
    if (body.find(fmt::format("V{}", width)) != std::string::npos)
      out += fmt::format("  using V{0} = arboc::lanes_t<T, {0}>;\n", width);
  return out;
}

class Writer {
 public:
  Writer(const Program& program, const Signature& signature, std::string space)
      : program_(program), signature_(signature), space_(std::move(space)) {
    in_lanes_ = program.ops.pack + program.ops.hsum + program.ops.lane > 0;
  }

  ProgramText run() {
    std::string parts, calls;
    if (!program_.angles.empty()) add_part(parts, calls, "angles", angle_arrays(), angle_body());
    int block = -1;
    for (size_t c = 0; c < program_.chunks.size(); ++c) {
      Arrays arrays;
      arrays.chunk(program_.chunks[c]);
      const std::string body = statements(program_, program_.chunks[c], block);
      if (!body.empty()) add_part(parts, calls, fmt::format("part{}", c), arrays, body);
    }
    std::string whole = body(calls);
    return {std::move(parts), std::move(whole)};
  }

 private:
  void add_part(std::string& parts, std::string& calls, const std::string& name,
                const Arrays& arrays, const std::string& body) {
    used_.add(arrays);
    parts += fmt::format("template <class T>\nARBOC_NOINLINE void {}({}) noexcept {{\n{}{}}}\n\n",
                         name, list(program_, arrays, true), lane_types(body), body);
    calls += fmt::format("  {}::{}<T>({});\n", space_, name, list(program_, arrays, false));
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

  /// Vectors are read from w where sines stand side by side.
  std::string work_arrays() const {
    std::string vectors;
    for (int width = 2; width <= kMostLanes; ++width)
      if (used_.lane_work[width])
        vectors +=
            fmt::format("  arboc::lanes_t<T, {0}> w{0}[{1}];\n", width, program_.lane_slots[width]);
    if (program_.slots == 0 || !used_.work) return vectors;
    return fmt::format("  {}T w[{}];\n", in_lanes_ ? "alignas(32) " : "", program_.slots) + vectors;
  }

  std::string body(const std::string& calls) {
    std::string out;
    const auto& outputs = program_.outputs;
    const bool checked = !signature_.positive.empty();
    out += work_arrays();
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

  const Program& program_;
  const Signature& signature_;
  std::string space_;
  bool in_lanes_ = false;
  Arrays used_;
};

}  // namespace

ProgramText program_text(const Program& program, const Signature& signature,
                         const std::string& space) {
  return Writer(program, signature, space).run();
}

}  // namespace arboc
