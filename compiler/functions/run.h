// Runs an algorithm of the catalogue on any scalar; shared by tracing and by the generic engine.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "functions/call.h"
#include "functions/catalogue.h"

namespace arboc {

/// Values of arguments by their names.
template <class T>
using Arguments = std::map<std::string, std::vector<T>>;

/// Dense outputs in the order of the signature (of symmetric ones the upper triangle), then pivots.
template <class Tree, class T>
std::vector<std::vector<T>> run(const Signature& s, const Tree& tree, const Setup& setup,
                                const Arguments<T>& inputs) {
  const auto input = [&](const char* name) {
    const auto it = inputs.find(name);
    return it == inputs.end() ? nullptr : it->second.data();
  };
  const typename Engine<Tree, T>::Inputs in{input("q"),   input("v"),  input("a"),
                                            input("tau"), input("q1"), input("f_ext")};
  std::vector<std::vector<T>> results;
  for (const Argument& a : s.outputs)
    results.emplace_back(static_cast<size_t>(a.rows) * static_cast<size_t>(a.cols), T(0));
  if (!s.positive.empty()) results.emplace_back(static_cast<size_t>(tree.nv), T(0));
  std::vector<T*> out;
  for (auto& result : results) out.push_back(result.data());
  Engine<Tree, T> engine(tree, engine_frames(setup));
  (engine.*engine_method<Tree, T>(s.name))(in, out.data());
  return results;
}

/// The values of the parameters, in their order.
template <class T>
std::vector<std::vector<T>> parameter_values(const Setup& setup, const Arguments<T>& inputs) {
  std::vector<std::vector<T>> values;
  for (const Parameter& p : setup.parameters) values.push_back(inputs.at(p.name));
  return values;
}

}  // namespace arboc
