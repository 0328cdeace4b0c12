// Other libraries of rigid-body dynamics, each compiled with its driver when it is asked for.
#pragma once
#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "body.hpp"
#include "cli/build.h"
#include "cli/measure.h"

namespace arboc::cli {

/// What the user says of peers.
struct PeerOptions {
  std::string list;                            ///< empty: all
  std::map<std::string, std::string> folders;  ///< pinocchio, cppad, cppadcodegen, rbdl
  std::string keep;                            ///< folder for what was compiled; empty: none
  std::string cxx;                             ///< of those that are not Debian packages
  std::string cxxflags = "-std=c++17 -O3 -march=native -DNDEBUG";
};

struct PeerKind {
  const char* name;
  const char* file;  ///< its source in peers/, which defines make_`maker`
  const char* maker;
  const char* libraries;             ///< linker flags of a Debian package, or
  std::vector<const char*> folders;  ///< checkouts that it is made of
  double allowed;                    ///< difference, relative to the largest entry
};

/// Those of the options' list, in the order of the table.  Throws UsageError.
std::vector<PeerKind> peer_kinds(const PeerOptions& options);

void add_peer_options(CLI::App& app, PeerOptions& options);

/// A body and its states: q, v, a, tau of all, one state after the other.
struct PeerTask {
  peers::Body body;
  int states = 0;
  std::array<const double*, 4> x{};
};

/// A peer of one body, with its states.
class PeerLibrary {
 public:
  /// Throws std::runtime_error where it cannot be had.
  PeerLibrary(const Common& common, const PeerOptions& options, const PeerKind& kind,
              PeerTask task);

  const PeerKind& kind() const { return kind_; }
  bool times(peers::Function f) const;
  /// Outputs at a state, dense and by rows, one after the other.
  std::vector<double> result(peers::Function f, int state, size_t size) const;
  Pass pass(peers::Function f) const;

 private:
  template <class Call>
  Call symbol(const char* name) const {
    return reinterpret_cast<Call>(library_.symbol(name));
  }
  [[noreturn]] void fail() const;

  PeerKind kind_;
  TemporaryFolder folder_;  ///< of what a peer generates
  Library library_;
};

}  // namespace arboc::cli
