#include "cli/common.h"

#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "frontend/read_model.h"
#include "report/report_tables.h"

namespace arboc::cli {
namespace {

volatile std::sig_atomic_t interrupted = 0;
volatile std::sig_atomic_t to_clean_up = 0;

extern "C" void on_interrupt(int) {
  interrupted = 1;
  if (to_clean_up > 0) return;
  constexpr char kMessage[] = "interrupted\n";
  [[maybe_unused]] const auto written = write(STDERR_FILENO, kMessage, sizeof kMessage - 1);
  _exit(kInterrupted);
}

}  // namespace

void catch_interrupt() {
  struct sigaction action {};
  action.sa_handler = on_interrupt;  // without SA_RESTART: waiting for a child ends
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

CleanUp::CleanUp() { to_clean_up = to_clean_up + 1; }
CleanUp::~CleanUp() { to_clean_up = to_clean_up - 1; }

void check_interrupt() {
  if (interrupted) throw Interrupted();
}

std::string dump(const nlohmann::ordered_json& json, int indent) {
  return json.dump(indent, ' ', true, nlohmann::ordered_json::error_handler_t::replace);
}

void print_diagnostics(const Diagnostics& diagnostics, const Common& common, bool notes) {
  int hidden = 0;
  for (const Diagnostic& d : diagnostics.all()) {
    if (common.json_diagnostics)
      fmt::print(stderr, "{}\n", dump(to_json(d)));
    else if (d.severity == Severity::kNote && !notes)
      ++hidden;
    else
      fmt::print(stderr, "{}\n", to_string(d));
  }
  if (hidden > 0)
    fmt::print(stderr, "{} note{} (-v prints them)\n", hidden, hidden == 1 ? "" : "s");
}

void print_failure(const std::string& message, const Common& common) {
  if (message.empty()) return;
  std::string text = message;
  if (common.json_diagnostics) text = dump(to_json({Severity::kError, "", {}, "", message, ""}));
  std::fputs((text + "\n").c_str(), stderr);  // which may be full; fmt::print() would throw
}

Model read(const Common& common, Diagnostics& diagnostics) {
  try {
    Model model = read_model(common.path, diagnostics, common.anthropometry);
    if (common.strict && diagnostics.warning_count() > 0) {
      diagnostics.promote_warnings();
      throw InputError("");
    }
    return model;
  } catch (const InputError& e) {
    print_diagnostics(diagnostics, common, common.verbose);
    if (diagnostics.error_count() > 0) throw InputError("");  // printed already
    throw;
  }
}

Compilation compiled(const Common& common, const CompileOptions& options) {
  Diagnostics diagnostics;
  const Model model = read(common, diagnostics);
  try {
    CompileOptions with = options;
    with.leave_out_absent = asks_by_default(common);
    Compilation result = compile(model, with, diagnostics);
    print_diagnostics(diagnostics, common, common.verbose);
    return result;
  } catch (const InputError&) {
    print_diagnostics(diagnostics, common, common.verbose);
    throw;
  }
}

Model configured(const Common& common, const Model& model, Diagnostics& diagnostics) {
  return configure(model, common.compile.model, diagnostics);
}

void progress(int step, int steps, const std::string& what) {
  check_interrupt();
  if (isatty(STDERR_FILENO)) fmt::print(stderr, "\r\033[K[{}/{}] {}", step, steps, what);
}

void progress_done() {
  if (isatty(STDERR_FILENO)) fmt::print(stderr, "\r\033[K");
}

}  // namespace arboc::cli
