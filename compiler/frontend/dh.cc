#include "frontend/dh.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <vector>

#include "base/sha256.h"
#include "frontend/dh_file.h"
#include "frontend/input_file.h"
#include "model/validate.h"

namespace arboc {
namespace {

/// A file beside the model's.
struct Attachment {
  std::string path, text;
  DhValue document;
  DhReport report;
  bool is_own = false;
};

std::optional<Attachment> attach(const std::string& path, bool is_own, Findings& findings) {
  Findings inside(shown_path(path));
  const auto text = read_input(path, inside);
  std::optional<DhValue> document;
  if (text) document = read_toml(*text, inside);
  inside.hand_over(findings);
  if (!document) return std::nullopt;
  return Attachment{path, *text, std::move(*document), {findings, shown_path(path)}, is_own};
}

std::vector<Attachment> attachments(const DhFile& file, const std::string& beside,
                                    const std::string& anthropometry, Findings& findings) {
  std::vector<Attachment> result;
  const auto add = [&](const std::string& path, bool is_own) {
    if (auto attachment = attach(path, is_own, findings)) result.push_back(std::move(*attachment));
  };
  if (!file.anthropometry.empty())
    add((std::filesystem::path(beside).parent_path() / file.anthropometry).string(), true);
  if (!anthropometry.empty()) add(anthropometry, false);
  return result;
}

}  // namespace

Model parse_dh(std::string_view text, const std::string& file_name,
               const std::string& anthropometry, Diagnostics& diagnostics) {
  Findings findings(file_name);
  const DhReport report{findings};
  Model model;
  std::string bytes(text);
  if (const auto document = read_toml(text, findings)) {
    DhFile file = read_head(*document, report);
    const auto others = attachments(file, file_name, anthropometry, findings);
    for (const Attachment& a : others) {
      override_lengths(a.document, a.report, a.is_own, file);
      bytes += a.text;
    }
    read_body(*document, report, file);
    for (const Attachment& a : others) override_masses(a.document, a.report, file);
    check_dh(file, report);
    if (findings.error_count() == 0) {
      model = build_model(file);
      model.kinematic = std::none_of(model.links.begin(), model.links.end(),
                                     [](const Link& link) { return link.inertial.has_value(); });
      validate(model, findings);
      if (file.human) check_branches(model, report);
    }
  }
  findings.deliver(diagnostics);
  model.file = base_name(file_name);
  model.source_sha256 = sha256(bytes);
  return model;
}

}  // namespace arboc
