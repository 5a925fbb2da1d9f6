#pragma once

#include <memory>
#include <queue>
#include <vector>

#include "simulation/clusters/world.h"

namespace contact {

/// What comes next in a world, the earliest first: contacts that begin between bodies in flight,
/// and groups that wait.
class Agenda {
 public:
  struct Entry {
    double time = kNever;                       ///< [s].
    int contact = kNone;                        ///< That begins, or
    std::shared_ptr<const Waiting> group = {};  ///< that waits.
    int left_changes = 0, right_changes = 0;
  };

  /// The world must outlive the agenda.
  explicit Agenda(const World& world) : world_(world) { Begin(); }

  /// Notes all anew.
  void Begin();
  /// Notes what these bodies do next. Call when their future has changed.
  void Note(const std::vector<int>& bodies);
  /// The earliest entry, and takes it out; of time kNever if there is none before the end.
  Entry Next();
  /// When that is [s].
  double NextTime();

 private:
  struct Later {
    bool operator()(const Entry& a, const Entry& b) const;
  };
  void NoteTouch(int contact);
  bool Holds(const Entry& entry) const;

  const World& world_;
  std::priority_queue<Entry, std::vector<Entry>, Later> entries_;
};

}  // namespace contact
