// NAME_FUNCTION.js: a function as an ES module, for pages.
//
// Arguments are arrays of numbers or Float64Arrays, inputs before outputs, laid out as those of the
// raw C++ functions.
#include <fmt/format.h>

#include <stdexcept>

#include "emit/arrays.h"
#include "emit/chunk_text.h"
#include "emit/emit.h"
#include "emit/names.h"
#include "emit/template.h"

namespace arboc {
namespace {

class JsFunction {
 public:
  JsFunction(const TargetModel& model, const TargetFunction& function)
      : model_(model), function_(function), program_(function.program) {}

  std::string run() {
    if (program_.ops.special > 0 || !function_.signature.positive.empty())
      throw std::logic_error("no JavaScript for " + function_.signature.name);
    std::string calls = parts(), stores, work;
    for (const Store& store : program_.stores) stores += store_line(program_, store, kJs);
    if (program_.slots > 0)
      work = fmt::format("  const w = new Float64Array({});\n", program_.slots);
    return fill("js/NAME_FUNCTION.js", {{"banner", banner(model_)},
                                        {"contract", contract()},
                                        {"parts", parts_},
                                        {"function", function_.signature.name},
                                        {"parameters", all_arguments()},
                                        {"body", work + calls + stores}});
  }

 private:
  std::string contract() const {
    const Signature& s = function_.signature;
    std::string out = "// " + comment_text(s.meaning) + "\n";
    for (const Argument& a : s.inputs)
      out += fmt::format("// in  {}: {}; {}; {}\n", a.name, a.rows * a.cols, a.unit, a.meaning);
    for (size_t k = 0; k < s.outputs.size(); ++k)
      out += fmt::format("// out {}: {}; {}; {}\n", s.outputs[k].name, function_.entries(k),
                         s.outputs[k].unit, s.outputs[k].meaning);
    return out + fmt::format("// {} operations, {} sines with their cosines.", program_.ops.total(),
                             program_.ops.sincos);
  }

  /// Writes the chunks as functions; returns the calls.
  std::string parts() {
    std::string calls;
    int block = -1;
    if (!program_.angles.empty()) {
      std::string code = statements(program_.prologue, block);
      for (size_t k = 0; k < program_.angles.size(); ++k) {
        const std::string angle = text(program_, program_.angles[k], kJs);
        code += fmt::format("  w[{}] = Math.sin({});\n  w[{}] = Math.cos({});\n", k, angle,
                            k + static_cast<size_t>(program_.angle_stride), angle);
      }
      calls += add_part("angles", angle_arrays(program_), code);
    }
    block = -1;
    for (size_t c = 0; c < program_.chunks.size(); ++c) {
      Arrays arrays;
      arrays.chunk(program_.chunks[c]);
      const std::string code = statements(program_.chunks[c], block);
      if (!code.empty()) calls += add_part(fmt::format("part{}", c), arrays, code);
    }
    return calls;
  }

  std::string statements(const Chunk& chunk, int& block) const {
    return chunk_text(program_, chunk, kJs, "", block);
  }

  std::string add_part(const std::string& name, const Arrays& arrays, const std::string& code) {
    std::string list;
    const auto append = [&](const std::string& array) {
      list += (list.empty() ? "" : ", ") + array;
    };
    for (const int p : arrays.inputs) append(program_.inputs[static_cast<size_t>(p)].name);
    for (const int p : arrays.outputs) append(program_.outputs[static_cast<size_t>(p)].name);
    if (arrays.work) append("w");
    parts_ += fmt::format("function {}({}) {{\n{}}}\n\n", name, list, code);
    return fmt::format("  {}({});\n", name, list);
  }

  std::string all_arguments() const {
    std::string list;
    for (const auto* ports : {&program_.inputs, &program_.outputs})
      for (const Port& port : *ports) list += (list.empty() ? "" : ", ") + port.name;
    return list;
  }

  const TargetModel& model_;
  const TargetFunction& function_;
  const Program& program_;
  std::string parts_;
};

}  // namespace

std::string js_function(const TargetModel& model, const TargetFunction& function) {
  return JsFunction(model, function).run();
}

}  // namespace arboc
