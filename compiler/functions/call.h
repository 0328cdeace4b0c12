// Engine's methods by the names of the catalogue.
#pragma once
#include <stdexcept>
#include <string>

#include "functions/engine.h"

namespace arboc {

/// A null pointer where the function is not one of Engine's.
template <class Tree, class T>
auto engine_method(const std::string& function) {
  using E = Engine<Tree, T>;
  using Method = void (E::*)(const typename E::Inputs&, typename E::Outputs);
  struct Named {
    const char* name;
    Method method;
  };
  static const Named methods[] = {
#define ARBOC_METHOD(name) {#name, &E::name},
      ARBOC_ENGINE_METHODS(ARBOC_METHOD)
#undef ARBOC_METHOD
  };
  for (const Named& m : methods)
    if (function == m.name) return m.method;
  throw std::logic_error("no algorithm for " + function);
}

}  // namespace arboc
