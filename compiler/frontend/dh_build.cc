// Rows -> links and joints.
//
// A row's transformation is cut where its joint acts: a standard row Rz(theta) Tz(d) Tx(a)
// Rx(alpha) turns first and is constant behind, a modified one Rx(alpha) Tx(a) Rz(theta) Tz(d) has
// a constant in front as well.  The link that the joint moves is JOINT.link, and the row's frame
// is welded to it; rows that the same joint turns about the same axis share that link, others
// follow it (model.h, Mimic).  Rows with a joint of several axes become the chain of [Astronaut]
// section 2: dummy links, each with the axis of its joint for z.
#include <fmt/format.h>

#include <map>
#include <unordered_set>

#include "frontend/dh_placement.h"

namespace arboc {
namespace {

constexpr double kHalfTurn = 3.14159265358979323846;

class ModelBuild {
 public:
  explicit ModelBuild(const DhFile& file) : file_(file) {
    link_names_.insert(file.root.frame);
    for (const DhRow& row : file.rows) link_names_.insert(row.name);
    for (const DhSegment& segment : file.segments) link_names_.insert(segment.name);
    for (const DhPoint& point : file.points) link_names_.insert(point.name);
    for (const DhJoint& joint : file.joints) joint_names_.insert(joint.name);
  }

  Model run() {
    model_.name = file_.name;
    model_.gravity = file_.gravity;
    for (const DhLength& length : file_.lengths)
      model_.lengths.push_back({length.name, length.value});
    root();
    for (size_t k = 0; k < file_.rows.size(); ++k) row(file_.rows[k]);
    for (const DhSegment& segment : file_.segments) {
      const int link = weld(frame(segment.row), {}, segment.name, segment.where);
      model_.links[at(link)].inertial = inertial_of(segment.mass, model_.lengths);
    }
    for (const DhPosture& posture : file_.postures)
      model_.postures.push_back({posture.name, posture.q});
    for (const DhPoint& point : file_.points)
      weld(frame(point.row), placement(point.xyz, point.turn), point.name, point.where);
    return std::move(model_);
  }

 private:
  static size_t at(int k) { return static_cast<size_t>(k); }

  static std::string unused(std::string name, std::unordered_set<std::string>& names) {
    while (!names.insert(name).second) name += '_';
    return name;
  }
  std::string aux(const std::string& name) { return unused(name, link_names_); }

  int frame(int row) const {
    if (row >= kPrivateFrame) return private_.at(row - kPrivateFrame);
    return row < 0 ? base_ : frame_[at(row)];
  }

  static DhPlacement placement(const DhVector& xyz, const DhTurn& turn) {
    return {xyz[0], xyz[1], xyz[2], turn.rpy, turn.turn};
  }
  static Matrix3<double> unit() { return Matrix3<double>::identity(); }

  int add_link(const std::string& name, Location where) {
    model_.links.push_back({name, std::nullopt, where});
    return static_cast<int>(model_.links.size()) - 1;
  }

  /// A new link fixed to `parent`.
  int weld(int parent, const DhPlacement& p, const std::string& name, Location where) {
    Joint joint;
    joint.name = unused(name + ".fixed", joint_names_);
    joint.parent = parent;
    joint.child = add_link(name, where);
    joint.origin = pose_of(p, model_.lengths);
    joint.location = where;
    model_.joints.push_back(joint);
    return joint.child;
  }

  /// A new link that a joint about or along `sign` z moves.
  int move(int parent, const DhPlacement& p, const DhDrive& drive, const std::string& joint_name,
           bool slides, const Vector3<double>& axis, const std::string& link, Location where) {
    Joint joint;
    joint.name = joint_name;
    joint.type = slides ? JointType::kPrismatic : JointType::kRevolute;
    joint.parent = parent;
    joint.child = add_link(link, where);
    joint.origin = pose_of(p, model_.lengths);
    joint.axis = axis;
    joint.limits = drive.limits;
    joint.damping = drive.damping;
    joint.friction = drive.friction;
    joint.stiffness = drive.stiffness;
    joint.neutral = drive.neutral;
    joint.rotor_inertia = drive.rotor;
    joint.location = where;
    model_.joints.push_back(joint);
    return joint.child;
  }

  void root() {
    const DhRoot& root = file_.root;
    const DhPlacement placed = placement(root.xyz, root.turn);
    if (!root.is_free) {
      base_ = placed.is_identity()
                  ? add_link(root.frame, root.where)
                  : weld(add_link(aux("world"), root.where), placed, root.frame, root.where);
    } else {
      int link = add_link(aux("world"), root.where);
      link = root.quaternion ? floating(link, placed) : free_axes(link, placed);
      base_ = placed.is_identity() ? link : weld(link, placed, root.frame, root.where);
    }
    if (root.mass) model_.links[at(base_)].inertial = inertial_of(*root.mass, model_.lengths);
  }

  std::string moved_root(const DhPlacement& placed) {
    return placed.is_identity() ? file_.root.frame : aux(file_.root.frame + ".link");
  }

  int floating(int world, const DhPlacement& placed) {
    Joint joint;
    joint.name = "root_joint";
    joint.type = JointType::kFloating;
    joint.parent = world;
    joint.child = add_link(moved_root(placed), file_.root.where);
    joint.location = file_.root.where;
    joint.free_root = true;
    model_.joints.push_back(joint);
    return joint.child;
  }

  int free_axes(int link, const DhPlacement& placed) {
    const std::string axes = file_.root.translations + file_.root.rotations;
    for (size_t k = 0; k < axes.size(); ++k) {
      Vector3<double> axis{};
      axis[axes[k] - 'X'] = 1;
      const std::string& name = file_.root.names[k];
      link =
          move(link, {}, {}, unused(name, joint_names_), k < file_.root.translations.size(), axis,
               k + 1 == axes.size() ? moved_root(placed) : aux(file_.root.frame + "." + name),
               file_.root.where);
      model_.joints.back().free_root = true;
    }
    return link;
  }

  void row(const DhRow& row) {
    const int parent = frame(row.parent);
    int link = -1;
    if (row.joint >= 0)
      link = axes_row(row, parent);
    else if (row.theta.joint >= 0 || row.d.joint >= 0)
      link = driven_row(row, parent);
    else
      link = constant_row(row, parent);
    frame_.push_back(link);
    model_.links[at(link)].reported = true;
    if (row.mass) model_.links[at(link)].inertial = inertial_of(*row.mass, model_.lengths);
  }

  /// The placement of a row without a joint, or of the joint with axes of it, in the frame of
  /// `parent`, which becomes an auxiliary link where angles and lengths of two kinds would mix.
  DhPlacement constant(const DhRow& row, int& parent) {
    if (row.is_placed) return placement(row.xyz, row.turn);
    const double theta = row.theta.value.constant, alpha = row.alpha.constant;
    const DhLinear &d = row.d.value, &a = row.a;
    const bool mixes =
        file_.modified ? alpha != 0 && (theta != 0 || !d.is_zero()) : theta != 0 && !a.is_zero();
    if (!mixes) return {a, {}, d, {alpha, 0, theta}, unit()};
    const DhPlacement first = file_.modified ? DhPlacement{a, {}, {}, {alpha, 0, 0}, unit()}
                                             : DhPlacement{{}, {}, {}, {0, 0, theta}, unit()};
    parent = weld(parent, first, aux(row.name + ".row"), row.where);
    return file_.modified ? DhPlacement{{}, {}, d, {0, 0, theta}, unit()}
                          : DhPlacement{a, {}, d, {alpha, 0, 0}, unit()};
  }

  int constant_row(const DhRow& row, int parent) {
    const DhPlacement p = constant(row, parent);
    return weld(parent, p, row.name, row.where);
  }

  /// Where a joint of a row acts, and what is behind it.
  struct Cut {
    DhPlacement before{}, behind{};
  };

  Cut cut(const DhRow& row, bool slides) const {
    const double theta = row.theta.value.constant, alpha = row.alpha.constant;
    const DhLinear& d = row.d.value;
    Cut c;
    if (file_.modified) {
      c.before = {row.a, {}, {}, {alpha, 0, 0}, unit()};
      c.behind = {{}, {}, d, {0, 0, theta}, unit()};
    } else {
      c.before = {{}, {}, slides ? d : DhLinear{}, {0, 0, theta}, unit()};
      c.behind = {row.a, {}, slides ? DhLinear{} : d, {alpha, 0, 0}, unit()};
    }
    return c;
  }

  /// A link that a joint moves, for rows that share it.
  struct Shared {
    int parent = -1, link = -1;
    double factor = 0, theta = 0;
    DhLinear a{}, d{};
    double alpha = 0;
  };

  bool fits(const Shared& s, const DhRow& row, int parent, double factor, bool slides) const {
    if (s.parent != parent || s.factor != factor) return false;
    if (file_.modified) return s.alpha == row.alpha.constant && s.a == row.a;
    return !slides || (s.theta == row.theta.value.constant && s.d == row.d.value);
  }

  int driven_row(const DhRow& row, int parent) {
    const bool slides = row.d.joint >= 0;
    const DhCell& cell = slides ? row.d : row.theta;
    const DhJoint& joint = file_.joints[at(cell.joint)];
    Cut c = cut(row, slides);
    std::vector<Shared>& all = shared_[cell.joint];
    for (const Shared& s : all) {
      if (!fits(s, row, parent, cell.factor, slides)) continue;
      double apart = file_.modified || slides ? 0 : row.theta.value.constant - s.theta;
      if (apart == -kHalfTurn) apart = kHalfTurn;
      return behind(row, s.link, apart, c);
    }
    const bool leads = all.empty();
    std::string link_name = leads ? joint.name + ".link" : row.name + ".link";
    const bool is_frame = c.behind.is_identity();
    link_name = is_frame ? row.name : aux(link_name);
    const double sign = leads && cell.factor < 0 ? -1 : 1;
    const int link = move(parent, c.before, joint.drives[0],
                          leads ? joint.name : unused(joint.name + "." + row.name, joint_names_),
                          slides, {0, 0, sign}, link_name, row.where);
    Joint& moved = model_.joints.back();
    if (leads) {
      leader_[cell.joint] = static_cast<int>(model_.joints.size()) - 1;
      moved.location = joint.where;
    } else {
      moved.mimic = Mimic{leader_[cell.joint], cell.factor, 0, row.where};
      moved.limits = {};
      moved.damping = moved.friction = moved.stiffness = moved.rotor_inertia = 0;
    }
    all.push_back({parent, link, cell.factor, row.theta.value.constant, row.a, row.d.value,
                   row.alpha.constant});
    return is_frame ? link : weld(link, c.behind, row.name, row.where);
  }

  /// The frame of a row on a link that a joint moves for another row, turned by `apart` from there.
  int behind(const DhRow& row, int link, double apart, Cut c) {
    if (apart != 0 && (c.behind.x.is_zero())) {
      c.behind.rpy.z = apart;
    } else if (apart != 0) {
      link = weld(link, {{}, {}, {}, {0, 0, apart}, unit()}, aux(row.name + ".row"), row.where);
    }
    return weld(link, c.behind, row.name, row.where);
  }

  int axes_row(const DhRow& row, int parent) {
    const DhJoint& joint = file_.joints[at(row.joint)];
    const std::vector<Matrix3<double>> local = local_frames(joint.axes);
    DhPlacement p = constant(row, parent);
    // A placement leads to the private frame, cells to the first local one.
    if (row.is_placed) p.turn = p.turn * local[0];
    int link = parent;
    for (size_t k = 0; k < local.size(); ++k) {
      if (k > 0) p = {{}, {}, {}, {}, transpose(local[k - 1]) * local[k]};
      const bool last = k + 1 == local.size();
      const char axis = static_cast<char>(joint.axes[k] - 'X' + 'x');
      link =
          move(link, p, joint.drives[k],
               joint.axes.size() > 1 ? unused(joint.names[k], joint_names_) : joint.names[k], false,
               {0, 0, 1}, last ? row.name : aux(fmt::format("{}.{}", row.name, axis)), joint.where);
    }
    private_[static_cast<int>(frame_.size())] = weld(
        link, {{}, {}, {}, {}, transpose(local.back())}, aux(row.name + ".private"), row.where);
    return link;
  }

  const DhFile& file_;
  Model model_;
  std::unordered_set<std::string> link_names_, joint_names_;
  int base_ = -1;
  std::vector<int> frame_;                     // link of each row
  std::map<int, std::vector<Shared>> shared_;  // by joint
  std::map<int, int> private_;                 // link of the private frame, by row
  std::map<int, int> leader_;                  // joint of the model, by joint of the file
};

}  // namespace

Model build_model(const DhFile& file) { return ModelBuild(file).run(); }

}  // namespace arboc
