// Statements that limbs compute one after the other (Chunk::limbs), as text: scalars; numbers,
// entries and slots that differ between limbs are looked up in the row of the limb.
#pragma once
#include <array>
#include <map>
#include <string>
#include <vector>

#include "program/program.h"

namespace arboc {

class LimbText {
 public:
  LimbText(const Program& program, const Chunk& chunk) : program_(program), chunk_(chunk) {}

  /// The right-hand side of a statement of the chunk.
  std::string value(const Statement& s);
  /// Where its value goes: assignments without semicolons.
  std::vector<std::string> stores(const Statement& s);
  /// What the statements written so far look up.
  struct Tables {
    /// At namespace scope with internal linkage: those in a function template would be one object
    /// in all libraries of a process that have a function of that name.
    std::vector<std::string> definitions;
    std::vector<std::string> rows;  ///< in the function, where the number of the limb is `limb`
  };
  /// `part`: what their names begin with.
  Tables tables(const std::string& part) const;

 private:
  using Row = std::array<double, kMostLanes>;

  std::string name(const Operand& x);
  std::string number(const Lanes& value);
  std::string entry(const Row& entries);
  std::string own(int width, int slot);
  struct Named {
    std::string type, name;  ///< of an entry; of the row
  };
  void add_table(const std::map<Row, int>& entries, const Named& named, const std::string& part,
                 Tables& tables) const;

  const Program& program_;
  const Chunk& chunk_;
  std::map<Row, int> numbers_, entries_;  ///< what each limb has there -> column of the table
  int own_width_ = 0;                     ///< of slots that are used
};

}  // namespace arboc
