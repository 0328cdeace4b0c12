// What a DH file says, checked cell by cell, before it becomes a Model.
//
// docs/dh.md describes the file.  Lengths are in m, masses in kg, angles in rad from here on;
// names are resolved to indices.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "frontend/dh_table.h"
#include "model/model.h"

namespace arboc {

using DhVector = std::array<DhLinear, 3>;

struct DhLength {
  std::string name;
  double value = 0;  ///< m
  Location where{};
  std::string file{};  ///< that declares it; empty: the model's
  bool used = false;
};

/// Frames are numbered by their rows, the root's is -1, and the private frame that moves with row k
/// ([Astronaut] section 2; the row has a joint with axes) is kPrivateFrame + k.
constexpr int kPrivateFrame = 1 << 20;

/// What the file says of one axis of a joint; angles and lengths in rad and m.
struct DhDrive {
  Limits limits{};
  double stiffness = 0, neutral = 0, damping = 0, friction = 0, rotor = 0;
};

struct DhJoint {
  std::string name;
  Location where{};
  std::string axes{};                ///< "XYZ" of a joint with several; empty: one, by its cell
  std::vector<std::string> names{};  ///< of the joints that its axes become
  bool slides = false;               ///< stands in a cell `d`
  int uses = 0;                      ///< rows that it drives
  std::vector<DhDrive> drives{};     ///< one an axis
};

/// theta or d: constant, or a joint's coordinate times `factor` on top.
struct DhCell {
  DhLinear value{};  ///< without the joint; rad, or m and lengths
  int joint = -1;
  double factor = 0;
};

/// Mass, centre of mass and inertia as given.
struct DhMass {
  Location where{};
  std::string file{};  ///< of the last file that gave a number; empty: the model's
  double mass = 0;     ///< kg
  bool has_mass = false, has_cg = false, has_inertia = false;
  DhVector cg{};  ///< m, in the frame
  Symmetric3<double> inertia{};
  bool products = false;   ///< six numbers were given, not three
  bool at_origin = false;  ///< inertia about the frame's origin, not about the centre of mass
  DhTurn axes{};           ///< of the inertia's axes in the frame
};

/// A frame: a row of the table.
struct DhRow {
  std::string name, note;
  Location where{};
  int parent = -1;         ///< row; -1: the root's frame
  bool is_placed = false;  ///< by xyz and rpy, not by cells
  DhCell theta{}, d{};
  DhLinear alpha{}, a{};
  DhVector xyz{};
  DhTurn turn{};
  int joint = -1;  ///< of several axes, or of one along z behind a placement
  std::optional<DhMass> mass{};
};

struct DhSegment {
  std::string name;
  int row = -1;  ///< -1: the root's frame
  Location where{};
  DhMass mass{};
};

struct DhPoint {
  std::string name;
  int row = -1;
  Location where{};
  DhVector xyz{};
  DhTurn turn{};
};

struct DhRoot {
  std::string frame = "base";
  Location where{};
  bool is_free = false, quaternion = false;
  std::string translations = "XYZ", rotations = "ZYX";
  std::vector<std::string> names{};  ///< of the six coordinates
  DhVector xyz{};
  DhTurn turn{};
  std::optional<DhMass> mass{};
};

/// Rows left and right that should mirror each other.
struct DhMirror {
  Location where{};
  Vector3<double> normal{0, 1, 0};
  std::vector<int> left{}, right{};
};

/// A posture by name; entries are joints, or axes of joints.
struct DhPosture {
  std::string name;
  Location where{};
  std::vector<std::pair<std::string, double>> q{};  ///< rad, m
};

struct DhFile {
  std::string name;
  Location where{};
  bool modified = false;  ///< the convention
  bool human = false;     ///< profile: what is wrong with a person's data is looked for
  DhUnits units{};
  Vector3<double> gravity{0, 0, -9.81};
  std::string anthropometry{};  ///< path as written, relative to the file
  Location anthropometry_at{};
  DhRoot root{};
  std::vector<DhLength> lengths{};
  std::vector<DhJoint> joints{};
  std::vector<DhRow> rows{};
  std::vector<DhSegment> segments{};
  std::vector<DhPoint> points{};
  std::vector<DhMirror> mirrors{};
  std::vector<DhPosture> postures{};
  std::unordered_map<std::string, int> row_index{};
  std::unordered_map<std::string, DhSymbol> symbols{};  ///< joints and lengths by name
};

/// The private frame of a joint with several axes, `axes` as in "ZY", has them for coordinate
/// axes; a local frame has one of them for its z.  The first local frame is the private one turned
/// by the quarter turn that takes z there, and each next one is the one before, turned by the
/// quarter turn that takes its z to the next axis ([Astronaut] section 2).  Returned are the
/// rotations from the private to each local frame: columns are its axes.
std::vector<Matrix3<double>> local_frames(std::string_view axes);

/// What stands before the table: name, convention, units, gravity, [lengths].
DhFile read_head(const DhValue& document, const DhReport& report);
/// The rest, in which the lengths occur.
void read_body(const DhValue& document, const DhReport& report, DhFile& file);

/// An anthropometry file has two parts: lengths, read between head and body, and the numbers of
/// segments, read after these.  `is_own`: it is the one that the model names, and may bring
/// lengths that the model has not.
void override_lengths(const DhValue& document, const DhReport& report, bool is_own, DhFile& file);
void override_masses(const DhValue& document, const DhReport& report, DhFile& file);

// Sections of the body.
void read_joint_names(const DhValue& joints, const DhReport& report, DhFile& file);
void read_joints(const DhValue& joints, const DhReport& report, DhFile& file);
void read_root(const DhValue& root, const DhReport& report, DhFile& file);
void read_rows(const DhValue& frames, const DhReport& report, DhFile& file);
void read_segments(const DhValue& segments, const DhReport& report, DhFile& file);
void read_points(const DhValue& points, const DhReport& report, DhFile& file);
void read_postures(const DhValue& postures, const DhReport& report, DhFile& file);
void read_mirrors(const DhValue& mirrors, const DhReport& report, DhFile& file);

/// The keys mass, cg, inertia and inertia_about of a table: what is given replaces what `mass`
/// has.
void read_mass(DhTable& table, const DhUnits& units, DhFile& file, DhMass& mass);

/// A cell: a number or an expression, with constants in m or rad.
enum class DhQuantity { kLength, kAngle };
DhLinear read_cell(const DhValue& value, const std::string& element, const std::string& about,
                   DhQuantity quantity, const DhUnits& units, const DhReport& report, DhFile& file);
/// Three lengths.
void read_xyz(DhTable& table, const char* key, const DhUnits& units, DhFile& file, DhVector& xyz);
/// A frame by its name; -2 and a report if there is none.
int row_called(const std::string& name, Location where, const std::string& element,
               const DhReport& report, const DhFile& file);

/// Inertia about the centre of mass `c` of one that is given about the frame's origin.
Symmetric3<double> about_centre(const DhMass& mass, const Vector3<double>& c);

/// What cannot be right, and what cannot be; see docs/dh.md.
void check_dh(DhFile file, const DhReport& report);

/// Warns of bodies with more than three branch joints: people have none ([Astronaut] section 2).
void check_branches(const Model& model, const DhReport& report);

/// Where rows stand while all joints are at 0, in world axes.
struct DhPlace {
  Matrix3<double> R = Matrix3<double>::identity();
  Vector3<double> p{};
  Vector3<double> axis{};  ///< of the row's joint; 0 if it has none, or several axes
};
std::vector<DhPlace> zero_posture(const DhFile& file);
double value_of(const DhLinear& x, const DhFile& file);
Vector3<double> value_of(const DhVector& xyz, const DhFile& file);

/// Left and right rows that do not mirror each other: lengths, joints, segments.
void check_mirrors(const DhFile& file, const DhReport& report);
/// Segments whose numbers no body has, and with profile = "human" those that no limb has.
void check_segments(const DhFile& file, const DhReport& report);

/// The Model, in file order; call after checks that found no errors.
Model build_model(const DhFile& file);

}  // namespace arboc
