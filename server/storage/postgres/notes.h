#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "storage/shared_store.h"

namespace contact::postgres {

/// Notes that wait to be told: of each kind one a job, the newest.
class WaitingNotes {
 public:
  /// Adds a note, into the one of the same kind and job if there is one.
  void Add(const Note& note);
  bool empty() const { return notes_.empty(); }
  /// Takes them all, as texts of at most kMostBytes, which is what PostgreSQL notifies of.
  std::vector<std::string> Take();

  static constexpr std::size_t kMostBytes = 7900;

 private:
  std::map<std::pair<Note::Kind, std::string>, Note> notes_;
};

/// The notes of such a text. What is no note is left out.
std::vector<Note> NotesOf(const std::string& text);

}  // namespace contact::postgres
