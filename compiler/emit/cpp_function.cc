// The header of one function: its parts and the function that calls them; where limbs go in lanes,
// both texts and the choice between them.
#include <fmt/format.h>

#include <map>

#include "emit/cpp_program.h"
#include "emit/emit.h"
#include "emit/names.h"
#include "emit/template.h"

namespace arboc {
namespace {

class Function {
 public:
  Function(const TargetModel& model, const TargetFunction& function)
      : model_(model), function_(function), program_(function.program) {}

  std::string run() {
    const std::string& name = program_.name;
    const ProgramText plain = program_text(program_, function_.signature, name + "_parts");
    std::map<std::string, std::string> values{
        {"banner", banner(model_)},
        {"name", model_.name},
        {"function", name},
        {"parts", plain.parts},
        {"documentation", documentation()},
        {"result", result_type(function_, "T")},
        {"parameters", parameters(function_, "T", " ARBOC_RESTRICT")},
        {"body", plain.body}};
    if (!function_.lanes) return fill("cpp/NAME_FUNCTION.hpp", values);
    const ProgramText lanes =
        program_text(function_.lanes->program, function_.signature, name + "_lanes");
    values.insert({{"lane_parts", lanes.parts},
                   {"lane_body", lanes.body},
                   {"limbs", comment_text(function_.lanes->limbs)},
                   {"arguments", arguments()}});
    return fill("cpp/NAME_FUNCTION_lanes.hpp", values);
  }

 private:
  std::string arguments() const {
    std::string out;
    for (const auto* list : {&function_.signature.inputs, &function_.signature.outputs})
      for (const Argument& a : *list) out += (out.empty() ? "" : ", ") + a.code();
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
    out += operations(program_.ops);
    if (!function_.lanes) return out;
    const OpCount& n = function_.lanes->program.ops;
    return out +
           fmt::format("\n/// In lanes:\n{}\n/// {} gathers, {} sums over lanes, {} lanes stored.",
                       operations(n), n.pack, n.hsum, n.lane);
  }

  static std::string operations(const OpCount& n) {
    const std::string out = fmt::format("/// {} mul, {} add, {} fma, {} div, {} sqrt, {} sincos",
                                        n.mul, n.add, n.fma, n.div, n.sqrt, n.sincos);
    return out + (n.special > 0 ? fmt::format(", {} special.", n.special) : ".");
  }

  const TargetModel& model_;
  const TargetFunction& function_;
  const Program& program_;
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
