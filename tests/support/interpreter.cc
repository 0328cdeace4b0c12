#include "support/interpreter.h"

#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>

namespace arboc::test {
namespace {

class Interpreter {
 public:
  Interpreter(const Program& program, const std::vector<std::vector<double>>& inputs)
      : program_(program), inputs_(inputs), slots_(static_cast<size_t>(program.slots)) {
    for (const Port& port : program.outputs) results_.emplace_back(static_cast<size_t>(port.size));
  }

  std::vector<std::vector<double>> run() {
    run(program_.prologue);
    for (size_t k = 0; k < program_.angles.size(); ++k) {
      const double angle = value(program_.angles[k]);
      slots_.at(k) = std::sin(angle);
      slots_.at(static_cast<size_t>(program_.angle_stride) + k) = std::cos(angle);
    }
    for (const Chunk& chunk : program_.chunks) {
      locals_.clear();
      run(chunk);
    }
    locals_.clear();
    for (const Store& s : program_.stores) store(s);
    std::vector<std::vector<double>> out;
    for (const auto& port : results_) {
      out.emplace_back();
      for (const auto& entry : port) out.back().push_back(entry ? *entry : fail("never stored"));
    }
    return out;
  }

 private:
  [[noreturn]] static double fail(const char* what) { throw std::logic_error(what); }

  double value(const Operand& x) const {
    const auto index = static_cast<size_t>(x.index);
    double v = x.value;
    if (x.place == Operand::Place::kInput) v = inputs_.at(static_cast<size_t>(x.port)).at(index);
    if (x.place == Operand::Place::kLocal) {
      if (!locals_.contains(x.index)) fail("local of another chunk");
      v = locals_.at(x.index);
    }
    if (x.place == Operand::Place::kSlot)
      v = slots_.at(index) ? *slots_[index] : fail("empty slot");
    return x.negative ? -v : v;
  }

  double value(const Statement& s) const {
    const ProgramTerm& first = s.terms.at(0);
    switch (s.op) {
      case Op::kAdd: return value(first.a) + value(first.b);
      case Op::kMul: return value(first.a) * value(first.b);
      case Op::kDiv: return value(first.a) / value(first.b);
      case Op::kSqrt: return std::sqrt(value(first.a));
      case Op::kSin: return std::sin(value(first.a));
      case Op::kCos: return std::cos(value(first.a));
      case Op::kSum: {
        double sum = 0;
        for (const ProgramTerm& t : s.terms)
          sum = t.product ? std::fma(value(t.a), value(t.b), sum) : sum + value(t.a);
        return sum;
      }
      case Op::kStumpff:
      case Op::kQuaternionLog:
      case Op::kLogCurvature: return special_value(s.op, s.index, value(first.a));
      case Op::kConstant:
      case Op::kInput: break;
    }
    fail("not a statement");
  }

  void store(const Store& s) {
    auto& entry = results_.at(static_cast<size_t>(s.port)).at(static_cast<size_t>(s.index));
    if (entry) fail("stored twice");
    entry = value(s.value);
  }

  void run(const Chunk& chunk) {
    for (const Statement& s : chunk.statements) {
      const double v = value(s);
      if (!locals_.emplace(s.local, v).second) fail("local defined twice");
      if (s.slot >= 0) slots_.at(static_cast<size_t>(s.slot)) = v;
      for (const Store& x : s.stores) store(x);
    }
  }

  const Program& program_;
  const std::vector<std::vector<double>>& inputs_;
  std::map<int, double> locals_;
  std::vector<std::optional<double>> slots_;
  std::vector<std::vector<std::optional<double>>> results_;
};

}  // namespace

std::vector<std::vector<double>> interpret(const Program& program,
                                           const std::vector<std::vector<double>>& inputs) {
  return Interpreter(program, inputs).run();
}

}  // namespace arboc::test
