// URDF elements, one after the other -> Model.
//
// The reader (schema_reader.h) has checked each element by itself; here is what elements mean
// together: the rules of joint types, what a joint must have, names resolved to indices.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "frontend/element.h"

namespace arboc {

constexpr size_t kMaxLinks = 20000;
constexpr size_t kMaxNameBytes = 1024;

class ModelBuilder {
 public:
  explicit ModelBuilder(Findings& findings) : findings_(findings) {}

  void start(const Element& element);
  void end(Tag tag, Location where);

  /// A second <parent> or <child> of the joint at hand: its place in the tree is not known.
  void forget_ends() { joints_.back().has_ends = false; }

  /// Whether the type of the joint at hand gives its part `tag` a meaning.
  bool uses(Tag tag) const;

  /// The type of the joint at hand.
  const char* joint_type() const { return arboc::name(joints_.back().joint.type); }

  /// Something like "<visual>" or "<limit> of fixed joints" that was read over.
  void ignore(const std::string& what);

  bool stopped() const { return stopped_; }

  /// The model, names resolved; unresolved ones are reported and -1.  `complete`: the document was
  /// read to its end.
  Model finish(bool complete);

 private:
  struct PendingJoint {
    Joint joint;
    std::string parent, child, leader;
    bool has_parent = false, has_child = false, has_axis = false, has_limit = false;
    bool has_ends = true;  // <parent> and <child> are there once, or missing
  };
  struct PendingInertial {
    Inertial inertial;
    bool has_mass = false, has_inertia = false, complete = true;
  };

  std::string checked_name(const Element& element);
  void start_joint(const Element& element);
  void read_origin(const Element& element);
  void read_axis(const Element& element);
  void read_limit(const Element& element);
  void read_dynamics(const Element& element);
  void read_mimic(const Element& element);
  void read_inertia(const Element& element);
  void end_inertial();
  void end_joint();
  void resolve(Model& model);
  void report_ignored();
  Joint& joint() { return joints_.back().joint; }

  Findings& findings_;
  std::string name_;
  std::vector<Link> links_;
  std::vector<PendingJoint> joints_;
  PendingInertial inertial_;
  std::map<std::string, int> ignored_;
  bool stopped_ = false;
};

}  // namespace arboc
