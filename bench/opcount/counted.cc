#include "counted.h"

#include "compile.h"
#include "functions/run.h"
#include "state_source.h"

namespace arboc::test {
namespace {

int operations = 0;

struct Counted {
  double value = 0;
  Counted() = default;
  Counted(double x) : value(x) {}  // NOLINT: as the numbers of a tree become T

  Counted operator-() const { return {-value}; }
  Counted& operator+=(const Counted& y) { return *this = *this + y; }
  Counted& operator-=(const Counted& y) { return *this = *this - y; }
  Counted& operator*=(const Counted& y) { return *this = *this * y; }

  friend Counted operator+(const Counted& x, const Counted& y) { return of(x.value + y.value); }
  friend Counted operator-(const Counted& x, const Counted& y) { return of(x.value - y.value); }
  friend Counted operator*(const Counted& x, const Counted& y) { return of(x.value * y.value); }
  friend Counted operator/(const Counted& x, const Counted& y) { return of(x.value / y.value); }
  friend bool operator<(const Counted& x, const Counted& y) { return x.value < y.value; }
  friend bool operator>(const Counted& x, const Counted& y) { return x.value > y.value; }
  friend bool coincide(const Counted& x, const Counted& y) { return x.value == y.value; }
  friend Counted sqrt(const Counted& x) { return of(std::sqrt(x.value)); }
  friend Counted acos(const Counted& x) { return {std::acos(x.value)}; }
  friend Counted sin(const Counted& x) { return {std::sin(x.value)}; }
  friend Counted cos(const Counted& x) { return {std::cos(x.value)}; }

 private:
  static Counted of(double value) {
    ++operations;
    return {value};
  }
};

}  // namespace

int generic_operations(const Model& model, const std::string& function) {
  const Setup setup = resolve(model);
  const CompiledFunction compiled = compile_function({function}, setup);
  if (defined_as(compiled.request).derivative != Derivative::kNone) return 0;
  Arguments<Counted> inputs;
  for (const auto& [name, values] : StateSource(1).inputs(setup))
    inputs[name].assign(values.begin(), values.end());
  const DynamicTree tree = lower(setup, compiled.lowering);
  operations = 0;
  run<DynamicTree, Counted>(compiled.signature, tree, setup, inputs);
  return operations;
}

}  // namespace arboc::test
