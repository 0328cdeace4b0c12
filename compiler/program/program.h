// A Program: the statements of one function in order, cut into chunks, with a place for each value.
//
// Straight-line single assignments.  The order is that of the trace, which follows the recursion
// body by body and is already local.  Every ~250 operations a new chunk begins: a function of its
// own, so that compilers take linear time and keep their registers; a value that a later chunk
// reads goes through a slot of the work array w.  Sines and cosines of angles known from the start
// come first, four at a time: w[k] and w[angle_stride + k] are those of angle k.
//
// Values in lanes (graph.h) stand beside scalars: statements have a width, and slots of width n are
// those of an array w<n> of vectors.  Sines of an angle in lanes lie side by side in w.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "graph/graph.h"

namespace arboc {

/// Floating-point instructions of one evaluation; a fused multiply-add counts once.
struct OpCount {
  int mul = 0, add = 0, fma = 0, div = 0, sqrt = 0, sincos = 0;
  int special = 0;  ///< stumpff, quaternion_log, log_curvature
  int pack = 0;     ///< vectors gathered from scalars
  int lane = 0;     ///< scalars taken out of vectors
  int hsum = 0;     ///< sums over the lanes of a vector
  /// All but the sines and cosines, the special functions and the crossings between lanes and
  /// scalars.  What is done to all lanes at once counts once.
  int total() const { return mul + add + fma + div + sqrt; }
  /// With the crossings, each by the instructions that it takes.
  int cost() const { return total() + 2 * pack + lane + 3 * hsum; }
};

/// Where an operand of a statement is found.
struct Operand {
  enum class Place { kConstant, kInput, kLocal, kSlot };
  Place place = Place::kConstant;
  bool negative = false;
  Lanes value{};      ///< constant
  int port = 0;       ///< input
  int index = 0;      ///< input: entry; local: its number; slot: its number
  int width = 1;      ///< lanes of what stands there
  int lane = -1;      ///< which of them is meant; -1: the value itself
  bool sine = false;  ///< slot: in lanes a part of the array w of scalars
};

struct ProgramTerm {
  Operand a, b;
  bool product = false;
};

/// Stores an operand in entry `index` of output `port`.
struct Store {
  int port = 0;
  int index = 0;
  Operand value;
};

struct Statement {
  Op op = Op::kSum;
  int index = 0;  ///< stumpff: its k
  int width = 1;  ///< lanes
  int local = 0;  ///< number of the value it defines
  int block = 0;  ///< index into Program::blocks
  std::vector<ProgramTerm>
      terms;      ///< sum, pack: the terms; others: one term that holds the operands a, b
  int slot = -1;  ///< also kept there for later chunks
  std::vector<Store> stores;  ///< also stored there
};

struct Chunk {
  std::vector<Statement> statements;
  int limbs =
      0;  ///< of a program limb by limb: computed once for each of so many lanes; 0: scalars
};

struct Program {
  std::string name;
  std::vector<Port> inputs, outputs;
  std::vector<std::string> blocks;
  Chunk prologue;  ///< what the angles need, from inputs only
  std::vector<Operand>
      angles;            ///< scalars; sine and cosine of each go to w[k], w[angle_stride + k]
  int angle_stride = 0;  ///< as many as there are angles; if several, a multiple of four
  std::vector<Chunk> chunks;
  std::vector<Store> stores;            ///< outputs that are inputs, constants or sines themselves
  int slots = 0;                        ///< size of w
  int lane_slots[kMostLanes + 1] = {};  ///< by width: size of w2, w4
  /// Lanes are not those of vectors: a chunk is of scalars or of one group of limbs, and runs once
  /// for each limb.  Then w<n> holds scalars, the slots of each lane one lane after the other.
  bool by_limb = false;
  OpCount ops;
};

struct ScheduleOptions {
  int chunk_ops = 250;   ///< operations a chunk; 200 to 500 differ by less than 5 % in run time
  bool by_limb = false;  ///< limbs one after the other instead of in the lanes of vectors
};

/// Graph (passed through the passes) -> Program.
Program schedule(const Graph& graph, const ScheduleOptions& options = {});

/// Operations of one evaluation.
OpCount count_ops(const Program& program);
/// Of the statements as listed, those of limbs once.
OpCount count_listed(const Program& program);
/// Of one evaluation by block; sines and cosines of the angles that come first belong to none.
std::vector<OpCount> count_ops_by_block(const Program& program);

/// How a language writes what is not an operator: formats of a number, of a function by its name
/// and argument, and of one with an index, name, index and argument.
struct Spelling {
  const char* constant;
  const char* call;
  const char* special;
  const char* indexed;
};
inline constexpr Spelling kCpp{"T({})", "{}({})", "arboc::{}({})", "arboc::{}<{}>({})"};
inline constexpr Spelling kC{"K({})", "arboc_{}({})", "arboc_{}({})", "arboc_{}({}, {})"};
/// Of functions without special functions.
inline constexpr Spelling kJs{"{}", "Math.{}({})", "{}({})", "{}({}, {})"};

/// An operand, with its sign or without; a right-hand side.
std::string text(const Program& program, const Operand& operand, const Spelling& spelling = kCpp);
std::string unsigned_text(const Program& program, const Operand& operand,
                          const Spelling& spelling = kCpp);
std::string text(const Program& program, const Statement& statement,
                 const Spelling& spelling = kCpp);
/// The same with other names for the operands, which have no sign.
using Naming = std::function<std::string(const Operand&)>;
std::string text(const Statement& statement, const Naming& name, const Spelling& spelling = kCpp);
/// Where a statement's value is kept for later chunks.
std::string slot_text(const Statement& statement);
/// Of a pack among the scalars of a program limb by limb: each lane to its slot; of others nothing.
std::vector<std::string> lanes_apart(const Program& program, const Statement& statement);

/// The printed form (`--print=program`): the statements as they will stand in the product.
std::string print(const Program& program);

}  // namespace arboc
