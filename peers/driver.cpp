// One peer as a shared library: -DPEER=kdl takes make_kdl.  Loaded by `arboc bench --peers`.
#include <cstdio>
#include <exception>

#include "peer.hpp"

namespace {

struct Session {
  std::unique_ptr<peers::Peer> peer;
  std::vector<peers::State> ours, native;
  char error[1000] = "";
};

Session& session() {
  static Session instance;
  return instance;
}

#define PEER_JOIN(a, b) a##b
#define PEER_MAKE(name) PEER_JOIN(make_, name)

/// 1 if `action` failed; what it said is arboc_peer_error().
template <class Action>
int guarded(const Action& action) {
  try {
    action();
    return 0;
  } catch (const std::exception& e) {
    std::snprintf(session().error, sizeof session().error, "%s", e.what());
    return 1;
  }
}

}  // namespace

extern "C" {

const char* arboc_peer_error() { return session().error; }

/// x: q, v, a, tau of all states, one state after the other.  1: failed or not supported.
int arboc_peer_open(const peers::Body* body, int states, const double* const* x) {
  return guarded([&] {
    Session& s = session();
    s.peer = peers::PEER_MAKE(PEER)(*body);
    if (!s.peer) throw std::runtime_error("the model has something that it lacks");
    const auto at = [&](int k, int size, int state) -> Eigen::VectorXd {
      return Eigen::Map<const Eigen::VectorXd>(x[k] + state * size, size);
    };
    for (int k = 0; k < states; ++k) {
      s.ours.push_back(
          {at(0, body->nq, k), at(1, body->nv, k), at(2, body->nv, k), at(3, body->nv, k)});
      s.native.push_back(s.peer->to_peer(s.ours.back()));
    }
  });
}

int arboc_peer_times(int f) {
  return session().peer->worth_timing(static_cast<peers::Function>(f));
}

/// Outputs at one state, each dense and by rows, one after the other.
int arboc_peer_result(int f, int state, double* out) {
  return guarded([&] {
    const auto k = static_cast<size_t>(state);
    for (const Eigen::MatrixXd& y :
         session().peer->evaluate(static_cast<peers::Function>(f), session().ours[k]))
      for (Eigen::Index row = 0; row < y.rows(); ++row)
        for (Eigen::Index col = 0; col < y.cols(); ++col) *out++ = y(row, col);
  });
}

/// What is timed: all states once.
void arboc_peer_pass(int f) {
  Session& s = session();
  for (const peers::State& x : s.native) s.peer->run(static_cast<peers::Function>(f), x);
}
}
