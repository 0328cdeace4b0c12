#include "gltf.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace study {
namespace {

using Json = nlohmann::ordered_json;
using Floats = std::vector<float>;
using Vector3 = Eigen::Vector3d;

constexpr double kPi = 3.14159265358979323846;
constexpr int kFloat = 5126, kUnsignedShort = 5123;  // component types
constexpr double kBall = 0.035;                      // m
constexpr double kShortest = 1e-6;                   // m: no cylinder has length zero

struct Mesh {
  Floats positions, normals;
  std::vector<std::uint16_t> indices;

  void add(const Vector3& p, const Vector3& n) {
    for (int k = 0; k < 3; ++k) {
      positions.push_back(static_cast<float>(p[k]));
      normals.push_back(static_cast<float>(n[k]));
    }
  }
  /// Quads of a grid of rows x columns vertices, the columns around.
  void grid(int rows, int columns) {
    for (int r = 0; r + 1 < rows; ++r)
      for (int c = 0; c + 1 < columns; ++c) {
        const int a = r * columns + c, b = a + columns;
        for (const int i : {a, a + 1, b, a + 1, b + 1, b})
          indices.push_back(static_cast<std::uint16_t>(i));
      }
  }
};

/// Radius 1, from 0 to 1 along z.
Mesh cylinder() {
  constexpr int kSides = 12;
  Mesh mesh;
  for (const double z : {0.0, 1.0})
    for (int k = 0; k <= kSides; ++k) {
      const double angle = 2 * kPi * k / kSides;
      const Vector3 n(std::cos(angle), std::sin(angle), 0);
      mesh.add(n + z * Vector3::UnitZ(), n);
    }
  mesh.grid(2, kSides + 1);
  return mesh;
}

/// Radius 1.
Mesh ball() {
  constexpr int kRings = 8, kSides = 12;
  Mesh mesh;
  for (int r = 0; r <= kRings; ++r)
    for (int k = 0; k <= kSides; ++k) {
      const double down = kPi - kPi * r / kRings, angle = 2 * kPi * k / kSides;
      const Vector3 n(std::sin(down) * std::cos(angle), std::sin(down) * std::sin(angle),
                      std::cos(down));
      mesh.add(n, n);
    }
  mesh.grid(kRings + 1, kSides + 1);
  return mesh;
}

/// What a node does: a row a frame, one row if it stands still.
struct Motion {
  Rows translation, rotation, scale;  // rotation: x y z w
};

/// The shorter way from the row before.
void set_rotation(Rows& rows, Eigen::Index k, Eigen::Quaterniond r) {
  Eigen::Vector4d x = r.normalized().coeffs();
  if (k > 0 && x.dot(Eigen::Vector4d(rows.row(k - 1).transpose())) < 0) x = -x;
  rows.row(k) = x.transpose();
}

Motion motion_of(const Segment& segment) {
  const Eigen::Index n = segment.ends.rows();
  Motion m{Rows(n, 3), Rows(n, 4), Rows(n, 3)};
  for (Eigen::Index k = 0; k < n; ++k) {
    const Vector3 from = segment.ends.row(k).head<3>(),
                  along = segment.ends.row(k).tail<3>().transpose() - from;
    const double length = std::max(along.norm(), kShortest);
    m.translation.row(k) = from.transpose();
    set_rotation(m.rotation, k, Eigen::Quaterniond::FromTwoVectors(Vector3::UnitZ(), along));
    m.scale.row(k) << segment.radius, segment.radius, length;
  }
  return m;
}

Motion motion_of(const Animation& a, std::size_t body) {
  const Eigen::Index n = a.placements.rows();
  Motion m{Rows(n, 3), Rows(n, 4), Rows()};
  for (Eigen::Index k = 0; k < n; ++k) {
    const double* p = a.placements.row(k).data() + 12 * body;
    const Eigen::Matrix3d R = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(p);
    set_rotation(m.rotation, k, Eigen::Quaterniond(R));
    m.translation.row(k) = Eigen::Map<const Eigen::RowVector3d>(p + 9);
  }
  return m;
}

class Writer {
 public:
  explicit Writer(const Animation& a) : a_(a) {
    if (a.frames() == 0) throw std::invalid_argument("animation: no frames");
    json_["asset"] = {{"version", "2.0"}, {"generator", "arboc"}};
    json_["scene"] = 0;
    json_["scenes"] = {{{"name", a.name}, {"nodes", {0}}}};
    json_["nodes"] = Json::array({{{"name", a.name}, {"rotation", upright()}}});
    const double colours[4][4] = {
        {0.2, 0.27, 0.33, 1}, {0.8, 0.2, 0.05, 1}, {0.6, 0.6, 0.55, 1}, {0.9, 0.7, 0.3, 1}};
    json_["materials"] = Json::array();
    for (const auto& c : colours)
      json_["materials"].push_back({{"pbrMetallicRoughness",
                                     {{"baseColorFactor", {c[0], c[1], c[2], c[3]}},
                                      {"metallicFactor", 0},
                                      {"roughnessFactor", 0.8}}}});
    add_meshes();
    Floats times(a.times.begin(), a.times.end());
    times_ = accessor(times, 1, true);
    json_["animations"] =
        Json::array({{{"name", a.name}, {"samplers", Json::array()}, {"channels", Json::array()}}});
  }

  void add(const std::string& name, int mesh, const Motion& m) {
    Json node = {{"name", name}, {"mesh", mesh}};
    const int index = static_cast<int>(json_["nodes"].size());
    const std::pair<const char*, const Rows*> parts[] = {
        {"translation", &m.translation}, {"rotation", &m.rotation}, {"scale", &m.scale}};
    for (const auto& [path, rows] : parts) {
      if (rows->rows() == 0) continue;
      const Rows first = rows->row(0);
      node[path] = std::vector<double>(first.data(), first.data() + first.size());
      if (rows->rows() > 1 && (rows->rowwise() - rows->row(0)).cwiseAbs().maxCoeff() > 1e-9)
        animate(index, path, *rows);
    }
    json_["nodes"].push_back(node);
    children_.push_back(index);
  }
  /// A ball in the origin of the body.
  void add_body(const std::string& name, const Motion& m) {
    Motion scaled = m;
    scaled.scale = Rows::Constant(1, 3, kBall);
    add(name, 3, scaled);
  }

  std::string finish() {
    json_["nodes"][0]["children"] = children_;
    // No animation at all where nothing moves: empty lists are not allowed.
    if (json_["animations"][0]["channels"].empty()) json_.erase("animations");
    json_["buffers"] = Json::array({{{"byteLength", binary_.size()}}});
    std::string text = json_.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string out;
    const auto word = [&](std::size_t x) {
      for (int k = 0; k < 4; ++k) out += static_cast<char>((x >> (8 * k)) & 0xFF);
    };
    word(0x46546C67), word(2), word(12 + 8 + text.size() + 8 + binary_.size());  // "glTF"
    word(text.size()), word(0x4E4F534A);                                         // "JSON"
    out += text;
    word(binary_.size()), word(0x004E4942);  // "BIN"
    return out + binary_;
  }

 private:
  std::vector<double> upright() const {
    const Eigen::Quaterniond r =
        Eigen::Quaterniond::FromTwoVectors(Vector3::Unit(a_.up), Vector3::UnitY());
    return {r.x(), r.y(), r.z(), r.w()};
  }

  int view(const void* data, std::size_t bytes) {
    json_["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes}});
    const std::size_t at = binary_.size();
    binary_.resize(at + (bytes + 3) / 4 * 4, '\0');
    std::memcpy(&binary_[at], data, bytes);
    return static_cast<int>(json_["bufferViews"].size()) - 1;
  }
  int accessor(const Floats& x, int width, bool bounds) {
    static const char* const kTypes[] = {"", "SCALAR", "", "VEC3", "VEC4"};
    Json json = {{"bufferView", view(x.data(), x.size() * sizeof(float))},
                 {"componentType", kFloat},
                 {"count", x.size() / width},
                 {"type", kTypes[width]}};
    if (bounds) {
      std::vector<float> low(width, HUGE_VALF), high(width, -HUGE_VALF);
      for (std::size_t k = 0; k < x.size(); ++k) {
        low[k % width] = std::min(low[k % width], x[k]);
        high[k % width] = std::max(high[k % width], x[k]);
      }
      json["min"] = low;
      json["max"] = high;
    }
    json_["accessors"].push_back(json);
    return static_cast<int>(json_["accessors"].size()) - 1;
  }
  int accessor(const Rows& rows) {
    const Rows& r = rows;
    return accessor(Floats(r.data(), r.data() + r.size()), static_cast<int>(r.cols()), false);
  }

  void add_meshes() {
    json_["meshes"] = Json::array();
    const std::pair<Mesh, int> shapes[] = {{cylinder(), 3}, {ball(), 1}};
    for (const auto& [shape, materials] : shapes) {
      const int positions = accessor(shape.positions, 3, true);
      const int normals = accessor(shape.normals, 3, false);
      const int data = view(shape.indices.data(), shape.indices.size() * sizeof(std::uint16_t));
      json_["accessors"].push_back({{"bufferView", data},
                                    {"componentType", kUnsignedShort},
                                    {"count", shape.indices.size()},
                                    {"type", "SCALAR"}});
      const int indices = static_cast<int>(json_["accessors"].size()) - 1;
      // Meshes 0 to 2: cylinders in the colours of Segment::Kind; 3: balls.
      for (int k = 0; k < materials; ++k)
        json_["meshes"].push_back(
            {{"primitives",
              Json::array({{{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}},
                            {"indices", indices},
                            {"material", materials == 1 ? 3 : k}}})}});
    }
  }

  void animate(int node, const char* path, const Rows& rows) {
    Json& animation = json_["animations"][0];
    const auto sampler = animation["samplers"].size();
    animation["samplers"].push_back(
        {{"input", times_}, {"interpolation", "LINEAR"}, {"output", accessor(rows)}});
    animation["channels"].push_back(
        {{"sampler", sampler}, {"target", {{"node", node}, {"path", path}}}});
  }

  const Animation& a_;
  Json json_;
  std::string binary_;
  int times_ = 0;
  std::vector<int> children_;
};

}  // namespace

std::string glb(const Animation& animation) {
  Writer writer(animation);
  for (const Segment& s : segments(animation))
    writer.add(s.name, static_cast<int>(s.kind), motion_of(s));
  for (std::size_t b = 0; b < animation.bodies.size(); ++b)
    writer.add_body(animation.bodies[b], motion_of(animation, b));
  return writer.finish();
}

}  // namespace study
