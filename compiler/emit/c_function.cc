// NAME_FUNCTION.c and jac_NAME_FUNCTION.c: a function in C99 under CasADi's convention.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "emit/arrays.h"
#include "emit/chunk_text.h"
#include "emit/emit.h"
#include "emit/names.h"
#include "emit/template.h"

namespace arboc {
namespace {

/// A dense column.
Pattern column(int rows) {
  Pattern pattern;
  for (int i = 0; i < rows; ++i) {
    pattern.row.push_back(i);
    pattern.col.push_back(0);
  }
  return pattern;
}

class CFunction {
 public:
  CFunction(const TargetModel& model, const ExternalFunction& function)
      : model_(model), function_(function), program_(function.program), s_(function.signature) {}

  std::string run() {
    const std::string calls = parts();
    const std::string symbol = external_symbol(model_, function_);
    const std::string in = list_patterns(true), out = list_patterns(false);
    return fill("c/NAME_FUNCTION.c", {{"banner", banner(model_)},
                                      {"name", model_.name},
                                      {"symbol", symbol},
                                      {"parts", parts_},
                                      {"body", body(calls)},
                                      {"patterns", patterns_},
                                      {"n_in", fmt::format("{}", s_.inputs.size())},
                                      {"n_out", fmt::format("{}", s_.outputs.size())},
                                      {"names_in", names(s_.inputs)},
                                      {"names_out", names(s_.outputs)},
                                      {"patterns_in", in},
                                      {"patterns_out", out}});
  }

 private:
  /// Writes the chunks as functions; returns the calls.
  std::string parts() {
    std::string calls;
    if (!program_.angles.empty()) {
      int block = -1;
      std::string code = statements(program_.prologue, block);
      for (size_t k = 0; k < program_.angles.size(); ++k)
        code += fmt::format("  arboc_sincos({}, &w[{}], &w[{}]);\n",
                            text(program_, program_.angles[k], kC), k,
                            k + static_cast<size_t>(program_.angle_stride));
      calls += add_part("angles", angle_arrays(program_), code);
    }
    int block = -1;
    for (size_t c = 0; c < program_.chunks.size(); ++c) {
      Arrays arrays;
      arrays.chunk(program_.chunks[c]);
      const std::string code = statements(program_.chunks[c], block);
      if (!code.empty()) calls += add_part(fmt::format("part{}", c), arrays, code);
    }
    return calls;
  }

  std::string statements(const Chunk& chunk, int& block) const {
    return chunk_text(program_, chunk, kC, "casadi_real ", block);
  }

  std::string add_part(const std::string& name, const Arrays& arrays, const std::string& code) {
    used_.add(arrays);
    std::string types, values;
    const auto append = [&](const std::string& type, const std::string& array) {
      types +=
          fmt::format("{}{}casadi_real* ARBOC_RESTRICT {}", types.empty() ? "" : ", ", type, array);
      values += (values.empty() ? "" : ", ") + array;
    };
    for (const int p : arrays.inputs)
      append("const ", program_.inputs[static_cast<size_t>(p)].name);
    for (const int p : arrays.outputs) append("", program_.outputs[static_cast<size_t>(p)].name);
    if (arrays.work) append("", "w");
    parts_ += fmt::format("static ARBOC_NOINLINE void {}({}) {{\n{}}}\n\n", name, types, code);
    return fmt::format("  {}({});\n", name, values);
  }

  /// Null inputs are zeros; outputs that are not wanted go behind the work array.
  std::string body(const std::string& calls) {
    std::string stores;
    for (const Store& store : program_.stores) {
      used_.store(store);
      stores += store_line(program_, store, kC);
    }
    int largest = 0, scratch = program_.slots;
    std::string pointers;
    for (const int p : used_.inputs) {
      const Port& port = program_.inputs[static_cast<size_t>(p)];
      largest = std::max(largest, port.size);
      pointers +=
          fmt::format("  const casadi_real* {0} = arg[{1}] ? arg[{1}] : zeros;\n", port.name, p);
    }
    const size_t results = s_.outputs.size();
    for (size_t p = 0; p < program_.outputs.size(); ++p) {
      const Port& port = program_.outputs[p];
      const bool needed = used_.outputs.contains(static_cast<int>(p));
      if (needed && p < results)
        pointers += fmt::format("  casadi_real* {0} = res[{1}] ? res[{1}] : w + {2};\n", port.name,
                                p, scratch);
      else if (needed)
        pointers += fmt::format("  casadi_real* {} = w + {};\n", port.name, scratch);
      if (needed) scratch += port.size;
    }
    const std::string zeros =
        largest > 0 ? fmt::format("  static const casadi_real zeros[{}] = {{0}};\n", largest) : "";
    return zeros + pointers + unused(scratch) + calls + stores + end();
  }

  std::string unused(int scratch) const {
    std::string out = "  (void)iw;\n  (void)mem;\n";
    if (used_.inputs.empty()) out += "  (void)arg;\n";
    if (used_.outputs.empty()) out += "  (void)res;\n";
    return scratch == 0 ? out + "  (void)w;\n" : out;
  }

  std::string end() const {
    if (s_.positive.empty()) return "  return 0;\n";
    const Port& checked = program_.outputs.back();
    std::string out = fmt::format("  const int status = arboc_check_positive({}, {});\n",
                                  checked.name, checked.size);
    out += "  if (status != 0) {\n";
    for (const int p : used_.outputs) {
      const Port& port = program_.outputs[static_cast<size_t>(p)];
      if (&port != &checked)
        out += fmt::format("    arboc_fill_nan({}, {});\n", port.name, port.size);
    }
    return out + "  }\n  return status;\n";
  }

  static std::string names(const std::vector<Argument>& arguments) {
    std::vector<std::string> list;
    for (const Argument& a : arguments) list.push_back(string_literal(a.name));
    return fmt::format("{}", fmt::join(list, ", "));
  }

  /// `s0, s1, s0`, the arrays of the inputs or outputs, each pattern once.
  std::string list_patterns(bool in) {
    std::vector<std::string> list;
    if (in) {
      for (size_t i = 0; i < s_.inputs.size(); ++i) {
        const Argument& a = s_.inputs[i];
        const bool looked_at = i < program_.inputs.size();
        list.push_back(looked_at ? pattern(a.rows * a.cols, 1, column(a.rows * a.cols))
                                 : pattern(a.rows, a.cols, {}));
      }
    } else {
      for (size_t k = 0; k < s_.outputs.size(); ++k)
        list.push_back(pattern(s_.outputs[k].rows, s_.outputs[k].cols, function_.patterns[k]));
    }
    return fmt::format("{}", fmt::join(list, ", "));
  }

  /// rows, columns, where each column begins, and the rows of the entries.
  std::string pattern(int rows, int cols, const Pattern& p) {
    const std::string values =
        fmt::format("{}, {}, {}{}{}", rows, cols, fmt::join(p.colptr(cols), ", "),
                    p.row.empty() ? "" : ", ", fmt::join(p.row, ", "));
    const auto [known, added] = known_.emplace(values, fmt::format("s{}", known_.size()));
    if (added)
      patterns_ +=
          wrapped(fmt::format("static const casadi_int {}[] = {{{}}};", known->second, values));
    return known->second;
  }

  static std::string wrapped(const std::string& line) {
    std::string out;
    size_t column = 0, at = 0;
    while (at < line.size()) {
      const size_t space = std::min(line.find(' ', at), line.size());
      if (column > 0 && column + 1 + space - at > 98) {
        out += "\n   ";
        column = 4;
      }
      out += (column > 0 ? " " : "") + line.substr(at, space - at);
      column += 1 + space - at;
      at = space + 1;
    }
    return out + "\n";
  }

  const TargetModel& model_;
  const ExternalFunction& function_;
  const Program& program_;
  const Signature& s_;
  Arrays used_;
  std::string parts_, patterns_;
  std::map<std::string, std::string> known_;
};

/// The room that is needed: as CFunction::body gives it out.
int work_size(const ExternalFunction& f) {
  Arrays used;
  for (const Chunk& chunk : f.program.chunks) used.chunk(chunk);
  for (const Store& store : f.program.stores) used.store(store);
  int size = f.program.slots;
  for (const int p : used.outputs) size += f.program.outputs[static_cast<size_t>(p)].size;
  return size;
}

std::string shape(int rows, int cols, size_t entries) {
  const size_t all = static_cast<size_t>(rows) * static_cast<size_t>(cols);
  const std::string size = cols == 1 ? fmt::format("{}", rows) : fmt::format("{} x {}", rows, cols);
  return entries == all ? size : fmt::format("{}, {} non-zeros", size, entries);
}

std::string declaration(const TargetModel& model, const ExternalFunction& f) {
  const Signature& s = f.signature;
  const std::string symbol = external_symbol(model, f);
  std::string out = fmt::format("// {}\n", comment_text(s.meaning));
  for (size_t i = 0; i < f.program.inputs.size(); ++i) {
    const Argument& a = s.inputs[i];
    out += fmt::format("// in  {}: {}; {}; {}\n", a.name,
                       shape(a.rows * a.cols, 1, static_cast<size_t>(a.rows * a.cols)), a.unit,
                       a.meaning);
  }
  for (size_t k = 0; k < s.outputs.size(); ++k) {
    const Argument& a = s.outputs[k];
    out += fmt::format("// out {}: {}; {}; {}\n", a.name,
                       shape(a.rows, a.cols, f.patterns[k].row.size()), a.unit, a.meaning);
  }
  if (!s.positive.empty())
    out += fmt::format(
        "// Returns 0, or 1 + the index of the first {} that is not positive; then all is nan.\n",
        s.positive);
  return out + fmt::format(
                   "#define {0}_SZ_ARG {1}\n#define {0}_SZ_RES {2}\n#define {0}_SZ_IW 0\n"
                   "#define {0}_SZ_W {3}\nARBOC_EXTERNAL({0});\n\n",
                   symbol, s.inputs.size(), s.outputs.size(), work_size(f));
}

}  // namespace

std::string external_symbol(const TargetModel& model, const ExternalFunction& f) {
  return fmt::format("{}{}_{}", f.jacobian ? "jac_" : "", model.name, f.name);
}

std::string c_function(const TargetModel& model, const ExternalFunction& function) {
  return CFunction(model, function).run();
}

std::string casadi_header(const TargetModel& model) {
  std::string declarations;
  for (const ExternalFunction& f : model.externals) declarations += declaration(model, f);
  return fill("c/NAME_casadi.h", {{"banner", banner(model)},
                                  {"name", model.name},
                                  {"NAME", upper_case(model.name)},
                                  {"nq", fmt::format("{}", model.nq)},
                                  {"nv", fmt::format("{}", model.nv)},
                                  {"declarations", declarations}});
}

}  // namespace arboc
