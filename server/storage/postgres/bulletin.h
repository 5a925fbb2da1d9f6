#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "base/mutex.h"
#include "storage/postgres/connection.h"
#include "storage/postgres/notes.h"

namespace contact::postgres {

/// What the processes of one database tell each other, by LISTEN and NOTIFY, on a connection and a
/// thread of its own. A notification holds up the commits of all sessions for an instant, so one
/// process sends at most twenty a second; the first after a pause goes at once.
class Bulletin {
 public:
  using Heard = std::function<void(const Note&)>;
  using Missed = std::function<void()>;

  /// Starts the thread, which calls both: see SharedStore::Listen.
  Bulletin(std::string address, Heard heard, Missed missed);
  /// Tells what waits to be told, if the database answers, and joins.
  ~Bulletin();
  Bulletin(const Bulletin&) = delete;
  Bulletin& operator=(const Bulletin&) = delete;

  /// See SharedStore::Tell. Thread-safe; does not wait.
  void Tell(const Note& note);

 private:
  // All private methods run on the thread.
  void Loop();
  // A connection that listens. False: none is to be had now.
  bool Connect();
  // Of each: false if the connection is lost.
  // Waits for notes of others, for something to tell, or for the end.
  bool Wait();
  // Hands over what has come.
  bool Hear();
  // Sends what is to be told.
  bool Send();
  // What is to be told, if it is time.
  std::vector<std::string> TakeDue();
  bool stopping() const;
  // Empties wake_.
  void ClearWake();

  const std::string address_;
  const Heard heard_;
  const Missed missed_;
  // An eventfd: there is something to tell, or it is time to end.
  const int wake_;

  // Of the thread.
  std::unique_ptr<Connection> connection_;
  std::chrono::steady_clock::time_point last_sent_ = {};

  mutable Mutex mutex_;
  WaitingNotes waiting_ ABSL_GUARDED_BY(mutex_);
  bool stopping_ ABSL_GUARDED_BY(mutex_) = false;
  std::thread thread_;  // Last: it uses all of the above.
};

}  // namespace contact::postgres
