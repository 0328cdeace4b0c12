#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/sha256.h"
#include "emit/emit.h"

namespace arboc {
namespace {

using nlohmann::ordered_json;

ordered_json describe(const Argument& a) {
  ordered_json json;
  json["name"] = a.name;
  json["shape"] = a.scalar      ? ordered_json::array()
                  : a.cols == 1 ? ordered_json{a.rows}
                                : ordered_json{a.rows, a.cols};
  json["unit"] = a.unit;
  json["meaning"] = a.meaning;
  return json;
}

ordered_json operations(const OpCount& n) {
  ordered_json json{{"mul", n.mul}, {"add", n.add},   {"fma", n.fma},
                    {"div", n.div}, {"sqrt", n.sqrt}, {"sincos", n.sincos}};
  if (n.special > 0) json["special"] = n.special;
  return json;
}

ordered_json describe(const TargetFunction& f) {
  ordered_json json;
  json["name"] = f.signature.name;
  json["request"] = f.request;
  json["meaning"] = f.signature.meaning;
  json["inputs"] = ordered_json::array();
  json["outputs"] = ordered_json::array();
  for (const Argument& a : f.signature.inputs) json["inputs"].push_back(describe(a));
  for (size_t i = 0; i < f.signature.outputs.size(); ++i) {
    ordered_json output = describe(f.signature.outputs[i]);
    output["symmetric"] = f.signature.outputs[i].symmetric;
    output["entries"] = f.entries(i);
    output["tolerance"] = f.signature.outputs[i].tolerance;
    if (f.signature.outputs[i].sparse)
      output["sparsity"] = {{"row", f.patterns[i].row},
                            {"col", f.patterns[i].col},
                            {"colptr", f.patterns[i].colptr(f.signature.outputs[i].cols)}};
    json["outputs"].push_back(output);
  }
  json["arguments"] = ordered_json::array();
  for (const auto& list : {json["inputs"], json["outputs"]})
    for (const auto& argument : list) json["arguments"].push_back(argument["name"]);
  json["returns"] = f.signature.positive.empty()
                        ? ordered_json(nullptr)
                        : ordered_json("0, or 1 + index of the first " + f.signature.positive +
                                       " that is not positive");
  json["ops"] = operations(f.program.ops);
  json["functions_of_code"] = f.program.chunks.size();
  json["work"] = f.program.slots;
  if (f.lanes) {
    json["lanes"] = {{"limbs", f.lanes->limbs}, {"ops", operations(f.lanes->program.ops)}};
    const OpCount& n = f.lanes->program.ops;
    json["lanes"]["ops"].update({{"gathers", n.pack}, {"sums", n.hsum}, {"stores", n.lane}});
  }
  return json;
}

ordered_json describe(const TargetModel& model, const ExternalFunction& f) {
  const OpCount& n = f.program.ops;
  return {{"symbol", external_symbol(model, f)},
          {"ops", n.total()},
          {"sincos", n.sincos},
          {"functions_of_code", f.program.chunks.size()}};
}

ordered_json limit_array(const std::vector<double>& values) {
  ordered_json json = ordered_json::array();
  for (const double x : values)
    json.push_back(std::isfinite(x) ? ordered_json(x) : ordered_json(nullptr));
  return json;
}

}  // namespace

std::string manifest(const TargetModel& model, const Files& files) {
  ordered_json json;
  json["arboc"] = version();
  json["name"] = model.name;
  json["source"] = {{"file", model.source_file}, {"sha256", model.source_sha256}};
  json["options"] = model.options;
  json["nq"] = model.nq;
  json["nv"] = model.nv;
  if (!model.manifest_extra.empty()) json.update(ordered_json::parse(model.manifest_extra));
  for (const Table& table : model.limits) json["limits"][table.name] = limit_array(table.values);
  json["frames"] = model.frame_names;
  json["loads"] = model.load_names;
  json["axes"] = model.axes;
  json["joint_forces"] = model.joint_forces;
  json["friction_velocity"] = model.friction_velocity;
  json["parameters"] = ordered_json::array();
  for (const ParameterTable& p : model.parameters)
    json["parameters"].push_back({{"name", p.name},
                                  {"unit", p.unit},
                                  {"meaning", p.meaning},
                                  {"labels", p.labels},
                                  {"nominal", p.nominal}});
  json["conventions"] = {
      {"units", "SI, radians"},
      {"floating base",
       "q: x y z qx qy qz qw (unit quaternion); v, a: linear then angular, in the body frame"},
      {"planar joint",
       "q: x y theta; v, a: vx vy wz in the body frame, in the plane normal to the axis"},
      {"forces", "linear then angular, in the body frame"},
      {"matrices",
       "raw functions write structural non-zeros by columns, of symmetric ones the upper "
       "triangle; row and colptr are compressed column storage"},
      {"axes",
       "of frame velocities, Jacobians and external wrenches: local, at the frame's origin along "
       "its axes; world, of the point at the world's origin along the world's axes; aligned, at "
       "the frame's origin along the world's axes"},
      {"tolerance", "agreement with the reference engine, relative to the largest entry"}};
  json["functions"] = ordered_json::array();
  for (const TargetFunction& f : model.functions) json["functions"].push_back(describe(f));
  for (const ExternalFunction& f : model.externals) json["c"].push_back(describe(model, f));
  for (const auto& [path, bytes] : files) json["files"][path] = sha256(bytes);
  // The model's file may have any name; bytes that are not UTF-8 become U+FFFD.
  return json.dump(1, ' ', true, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace arboc
