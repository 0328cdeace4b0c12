// Which arrays a piece of a program needs, for the parameters of the function made of it.
#pragma once
#include <set>

#include "program/program.h"

namespace arboc {

/// Arrays that a piece of code reads or writes, in the order of the function's parameters.
struct Arrays {
  std::set<int> inputs, outputs;
  bool work = false;
  bool lane_work[kMostLanes + 1] = {};  ///< by width

  void add(const Arrays& other) {
    inputs.insert(other.inputs.begin(), other.inputs.end());
    outputs.insert(other.outputs.begin(), other.outputs.end());
    work = work || other.work;
    for (int k = 0; k <= kMostLanes; ++k) lane_work[k] = lane_work[k] || other.lane_work[k];
  }
  void read(const Operand& x) {
    if (x.place == Operand::Place::kInput) inputs.insert(x.port);
    if (x.place == Operand::Place::kSlot) slot(x.sine ? 1 : x.width);
  }
  void slot(int width) { (width == 1 ? work : lane_work[width]) = true; }
  void store(const Store& s) {
    outputs.insert(s.port);
    read(s.value);
  }
  void chunk(const Chunk& chunk) {
    for (const Statement& s : chunk.statements) {
      for (const ProgramTerm& t : s.terms) {
        read(t.a);
        if (t.product) read(t.b);
      }
      for (const Store& x : s.stores) store(x);
      if (s.slot >= 0) slot(s.width);
    }
  }
};

/// Of the sines and cosines that come first.
inline Arrays angle_arrays(const Program& program) {
  Arrays arrays;
  arrays.chunk(program.prologue);
  for (const Operand& angle : program.angles) arrays.read(angle);
  arrays.work = true;
  return arrays;
}

}  // namespace arboc
