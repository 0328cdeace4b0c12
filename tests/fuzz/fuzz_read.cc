// Bytes -> Model.
#include <cmath>
#include <string>

#include "compile.h"
#include "frontend/urdf.h"
#include "fuzz/bytes.h"
#include "fuzz/targets.h"

namespace arboc::fuzz {
namespace {

bool one_printable_line(const std::string& text) {
  for (const char c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) return false;
  return true;
}

/// What Model promises (model/model.h) and later stages rely on.
void expect_sound(const Model& model) {
  const int links = static_cast<int>(model.links.size());
  ARBOC_FUZZ_EXPECT(0 <= model.root && model.root < links);
  ARBOC_FUZZ_EXPECT(model.joints.size() + 1 == model.links.size());
  for (const Joint& joint : model.joints) {
    ARBOC_FUZZ_EXPECT(0 <= joint.parent && joint.parent < links);
    ARBOC_FUZZ_EXPECT(0 <= joint.child && joint.child < links && joint.child != model.root);
    if (has_axis(joint.type)) {
      const double length = std::hypot(joint.axis.x, joint.axis.y, joint.axis.z);
      ARBOC_FUZZ_EXPECT(std::fabs(length - 1) < 1e-12);
    }
  }
  for (const Link& link : model.links)
    if (link.inertial) ARBOC_FUZZ_EXPECT(link.inertial->mass >= 0);
}

/// Small models go on to the graph.
void expect_compiles(const Model& model, Diagnostics& diagnostics) {
  constexpr int kMostFreedoms = 8;
  try {
    const Model configured = configure(model, {}, diagnostics);
    const int nv = coordinates(configured).nv;
    if (nv == 0 || nv > kMostFreedoms || configured.links.size() > 40) return;
    const Setup setup = resolve(configured);
    for (const char* function : {"rnea", "crba"}) compile_function({function}, setup);
  } catch (const InputError& e) {
    ARBOC_FUZZ_EXPECT(std::string(e.what()).find("error: ") != std::string::npos);
  }
}

}  // namespace

void read(const std::uint8_t* data, size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  Diagnostics diagnostics;
  bool refused = false;
  try {
    const Model model = parse_urdf(text, "fuzz.urdf", diagnostics);
    ARBOC_FUZZ_EXPECT(diagnostics.error_count() == 0);
    expect_sound(model);
    expect_compiles(model, diagnostics);
  } catch (const InputError& e) {
    refused = true;
    ARBOC_FUZZ_EXPECT(diagnostics.error_count() > 0);
    ARBOC_FUZZ_EXPECT(std::string(e.what()).find("error: ") != std::string::npos);
  }
  int errors = 0;
  for (const Diagnostic& d : diagnostics.all()) {
    errors += d.severity == Severity::kError;
    ARBOC_FUZZ_EXPECT(one_printable_line(to_string(d)));
    ARBOC_FUZZ_EXPECT(to_string(d).size() < 20000);
  }
  ARBOC_FUZZ_EXPECT(errors <= 21 && refused == (errors > 0));
}

}  // namespace arboc::fuzz
