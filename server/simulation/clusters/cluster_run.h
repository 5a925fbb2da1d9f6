#pragma once

#include <cstdint>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "simulation/clusters/agenda.h"
#include "simulation/clusters/blocks.h"
#include "simulation/clusters/frames.h"
#include "simulation/clusters/inventory.h"
#include "simulation/clusters/meeting.h"
#include "simulation/clusters/piece_solver.h"
#include "simulation/clusters/world.h"
#include "simulation/episode/run_state.h"
#include "simulation/model/observer.h"

namespace contact {

/// A run whose bodies are solved in parts, the earliest first: what touches is a cluster, with a
/// clock, steps and unknowns of its own, and what touches nothing flies. README.md, "Clusters".
class ClusterRun {
 public:
  /// All outlive the run. Only for what MayPart.
  ClusterRun(const Scenario& scenario, Observer& observer, std::stop_token stop);

  /// Goes on from there instead of from the start.
  void Restore(const RunState& from);
  Outcome Run();

 private:
  // What a piece is tried with.
  struct Attempt {
    double time = 0;
    std::vector<int> bodies;  // Ascending.
    int touch = kNone;        // The contact that begins at this time.
    int joins = 0;            // How often others have joined.
    double until = 0;         // How far to look for others before it is solved [s].
  };

  void Treat(const Agenda::Entry& entry);
  bool Gather(const std::vector<int>& more, Attempt* attempt) const;
  void Flood(Attempt* attempt) const;
  bool Join(int body, Attempt* attempt);
  std::shared_ptr<Piece> Rewind(const Attempt& attempt);
  void Keep(const std::shared_ptr<Piece>& piece, const std::vector<Waiting>& groups);
  std::shared_ptr<Piece> Undo(const Piece& piece);
  bool Meets(Attempt* attempt);
  std::shared_ptr<Piece> Solve(const Attempt& attempt, double until);
  void Count(const Piece& piece);
  void Fail(const Piece& piece);

  void Advance();
  void TellProgress();
  void TellUntil(double instant);
  void Tell(const Report::News& news);
  void ForgetUntil(double instant);
  RunState Save() const;

  void Scale(const Inventory& now);
  void Summarize();

  const Scenario& scenario_;
  Observer& observer_;
  World world_;
  PieceSolver solver_;
  Agenda agenda_;
  Frames frames_;
  // What a run that goes on from here needs; Save fills in what the other members hold. Its time is
  // that up to which all is told.
  RunState run_;
  Pieces pieces_;             // Those that go on after that time.
  std::int64_t number_ = 0;   // Of the last piece that was tried.
  std::int64_t look_at_ = 0;  // The number at which to look what is certain.
  Blocks blocks_;
  std::string busy_with_;                 // Of the last piece.
  std::int64_t useful_ = 0, wasted_ = 0;  // Steps since bodies were bound last.
  // Of pieces that are certain: dissipated [J], the work of what is not steady [J], and the impulse
  // of that and of walls and fixed bodies [N·s].
  double loss_ = 0, work_ = 0, impulse_ = 0;
};

}  // namespace contact
