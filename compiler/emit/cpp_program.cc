#include "emit/cpp_program.h"

#include <fmt/format.h>

#include <vector>

#include "emit/arrays.h"
#include "emit/chunk_text.h"
#include "emit/cpp_stores.h"
#include "program/limb_text.h"

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
      append((program.by_limb ? "T" : fmt::format("arboc::lanes_t<T, {}>", width)) +
                 "* ARBOC_RESTRICT ",
             fmt::format("w{}", width));
  return out;
}

std::string statements(const Program& program, const Chunk& chunk, int& block) {
  std::string out;
  const auto line = [&](const std::string& text) { out += "  " + text + ";\n"; };
  const auto stores = store_lines(program, chunk);
  for (const Statement& s : chunk.statements) {
    out += block_comment(program, s, block);
    const std::vector<std::string> apart = lanes_apart(program, s);
    for (const std::string& lane : apart) line(lane);
    if (!apart.empty()) continue;
    const std::string type = s.width == 1 ? "T" : fmt::format("V{}", s.width);
    line(fmt::format("const {} x{} = {}", type, s.local, text(program, s)));
    if (s.slot >= 0) line(fmt::format("{} = x{}", slot_text(s), s.local));
    for (const std::string& store : stores[static_cast<size_t>(&s - chunk.statements.data())])
      line(store);
  }
  return out;
}

/// Those of one limb, whose number is `limb`; tables go to `definitions`.
std::string limb_statements(const Program& program, size_t c, int& block,
                            std::string& definitions) {
  const Chunk& chunk = program.chunks[c];
  LimbText limb(program, chunk);
  std::string body, out;
  for (const Statement& s : chunk.statements) {
    body += block_comment(program, s, block);
    body += fmt::format("  const T x{} = {};\n", s.local, limb.value(s));
    for (const std::string& store : limb.stores(s)) body += "  " + store + ";\n";
  }
  const LimbText::Tables tables = limb.tables(fmt::format("part{}", c));
  for (const std::string& table : tables.definitions) definitions += table + ";\n";
  for (const std::string& row : tables.rows) out += "  " + row + ";\n";
  return out + body;
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
    if (!program_.angles.empty()) add_part({"angles"}, angle_arrays(program_), angle_body());
    int block = -1;
    for (size_t c = 0; c < program_.chunks.size(); ++c) {
      const Chunk& chunk = program_.chunks[c];
      if (chunk.statements.empty()) continue;
      Arrays arrays;
      arrays.chunk(chunk);
      const Part part{fmt::format("part{}", c), chunk.limbs};
      add_part(part, arrays,
               chunk.limbs > 0 ? limb_statements(program_, c, block, parts_)
                               : statements(program_, chunk, block));
    }
    std::string whole = body();
    return {std::move(parts_), std::move(whole)};
  }

 private:
  struct Part {
    std::string name;
    int limbs = 0;  ///< that it is called for
  };

  void add_part(const Part& part, const Arrays& arrays, const std::string& body) {
    used_.add(arrays);
    const bool each = part.limbs > 0;
    parts_ +=
        fmt::format("template <class T>\nARBOC_NOINLINE void {}({}{}) noexcept {{\n{}{}}}\n\n",
                    part.name, list(program_, arrays, true), each ? ", int limb" : "",
                    program_.by_limb ? "" : lane_types(body), body);
    if (each) calls_ += fmt::format("  for (int limb = 0; limb < {}; ++limb)\n  ", part.limbs);
    calls_ += fmt::format("  {}::{}<T>({}{});\n", space_, part.name, list(program_, arrays, false),
                          each ? ", limb" : "");
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
        vectors += program_.by_limb
                       ? fmt::format("  T w{0}[{0} * {1}];\n", width, program_.lane_slots[width])
                       : fmt::format("  arboc::lanes_t<T, {0}> w{0}[{1}];\n", width,
                                     program_.lane_slots[width]);
    if (program_.slots == 0 || !used_.work) return vectors;
    return fmt::format("  {}T w[{}];\n", in_lanes_ ? "alignas(32) " : "", program_.slots) + vectors;
  }

  std::string body() {
    std::string out;
    const auto& outputs = program_.outputs;
    const bool checked = !signature_.positive.empty();
    out += work_arrays();
    if (checked) out += fmt::format("  T {}[{}];\n", outputs.back().name, outputs.back().size);
    out += calls_;
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
  std::string parts_, calls_;
  Arrays used_;
};

}  // namespace

ProgramText program_text(const Program& program, const Signature& signature,
                         const std::string& space) {
  return Writer(program, signature, space).run();
}

}  // namespace arboc
