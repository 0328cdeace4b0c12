#include "support/interpreter.h"

#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>

namespace arboc::test {
namespace {

/// A value in every lane; scalars are the same in all.
struct Value {
  double x[kMostLanes] = {};
  int width = 1;
  double operator[](int lane) const { return x[width == 1 ? 0 : lane]; }
};

class Interpreter {
 public:
  Interpreter(const Program& program, const std::vector<std::vector<double>>& inputs)
      : program_(program), inputs_(inputs), slots_(static_cast<size_t>(program.slots)) {
    for (int width = 2; width <= kMostLanes; ++width)
      lane_slots_[width].resize(static_cast<size_t>(program.lane_slots[width]));
    for (const Port& port : program.outputs) results_.emplace_back(static_cast<size_t>(port.size));
  }

  std::vector<std::vector<double>> run() {
    run(program_.prologue);
    for (size_t k = 0; k < program_.angles.size(); ++k) {
      const double angle = scalar(program_.angles[k]);
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
      for (const auto& entry : port) entry ? out.back().push_back(*entry) : fail("never stored");
    }
    return out;
  }

 private:
  [[noreturn]] static void fail(const char* what) { throw std::logic_error(what); }

  double slot(size_t index) const {
    if (!slots_.at(index)) fail("empty slot");
    return *slots_[index];
  }

  Value whole(const Operand& x) const {
    const auto index = static_cast<size_t>(x.index);
    Value v;
    v.width = x.width;
    switch (x.place) {
      case Operand::Place::kConstant:
        for (int k = 0; k < x.width; ++k) v.x[k] = x.value[k];
        return v;
      case Operand::Place::kInput:
        v.x[0] = inputs_.at(static_cast<size_t>(x.port)).at(index);
        return v;
      case Operand::Place::kLocal:
        if (!locals_.contains(x.index)) fail("local of another chunk");
        return locals_.at(x.index);
      case Operand::Place::kSlot: break;
    }
    if (x.width > 1 && !x.sine) {
      const auto& kept = lane_slots_[x.width].at(index);
      if (!kept) fail("empty slot");
      return *kept;
    }
    for (int k = 0; k < x.width; ++k) v.x[k] = slot(index + static_cast<size_t>(k));
    return v;
  }

  Value value(const Operand& x) const {
    Value v = whole(x);
    if (v.width != x.width) fail("another width");
    if (x.lane >= v.width) fail("no such lane");
    if (x.lane >= 0) v = {{v.x[x.lane]}, 1};
    for (double& entry : v.x) entry = x.negative ? -entry : entry;
    return v;
  }
  double scalar(const Operand& x) const {
    const Value v = value(x);
    if (v.width != 1) fail("a scalar in lanes");
    return v.x[0];
  }

  Value value(const Statement& s) const {
    Value v;
    v.width = s.width;
    for (int lane = 0; lane < s.width; ++lane) v.x[lane] = value(s, lane);
    return v;
  }

  double value(const Statement& s, int lane) const {
    const ProgramTerm& first = s.terms.at(0);
    const auto at = [&](const Operand& x) { return value(x)[lane]; };
    switch (s.op) {
      case Op::kAdd: return at(first.a) + at(first.b);
      case Op::kMul: return at(first.a) * at(first.b);
      case Op::kDiv: return at(first.a) / at(first.b);
      case Op::kSqrt: return std::sqrt(at(first.a));
      case Op::kSin: return std::sin(at(first.a));
      case Op::kCos: return std::cos(at(first.a));
      case Op::kSum: {
        double sum = 0;
        for (const ProgramTerm& t : s.terms)
          sum = t.product ? std::fma(at(t.a), at(t.b), sum) : sum + at(t.a);
        return sum;
      }
      case Op::kStumpff:
      case Op::kQuaternionLog:
      case Op::kLogCurvature: return special_value(s.op, s.index, at(first.a));
      case Op::kPack: return scalar(s.terms.at(static_cast<size_t>(lane)).a);
      case Op::kHsum: return horizontal_sum(value(first.a), s.index);
      case Op::kLane:
      case Op::kConstant:
      case Op::kInput: break;
    }
    fail("not a statement");
  }

  static double horizontal_sum(const Value& v, int n) {
    if (n == 4) return (v.x[0] + v.x[2]) + (v.x[1] + v.x[3]);
    return n == 2 ? v.x[0] + v.x[1] : (v.x[0] + v.x[1]) + v.x[2];
  }

  void store(const Store& s) {
    auto& entry = results_.at(static_cast<size_t>(s.port)).at(static_cast<size_t>(s.index));
    if (entry) fail("stored twice");
    entry = scalar(s.value);
  }

  void keep(const Statement& s, const Value& v) {
    const auto slot = static_cast<size_t>(s.slot);
    if (s.width == 1)
      slots_.at(slot) = v.x[0];
    else
      lane_slots_[s.width].at(slot) = v;
  }

  void run(const Chunk& chunk) {
    for (const Statement& s : chunk.statements) {
      const Value v = value(s);
      if (!locals_.emplace(s.local, v).second) fail("local defined twice");
      if (s.slot >= 0) keep(s, v);
      for (const Store& x : s.stores) store(x);
    }
  }

  const Program& program_;
  const std::vector<std::vector<double>>& inputs_;
  std::map<int, Value> locals_;
  std::vector<std::optional<double>> slots_;
  std::vector<std::optional<Value>> lane_slots_[kMostLanes + 1];
  std::vector<std::vector<std::optional<double>>> results_;
};

}  // namespace

std::vector<std::vector<double>> interpret(const Program& program,
                                           const std::vector<std::vector<double>>& inputs) {
  return Interpreter(program, inputs).run();
}

}  // namespace arboc::test
