#include "jobs/run/replay.h"

#include <optional>
#include <utility>

#include "base/future.h"
#include "jobs/run/run_control.h"
#include "jobs/run/run_recorder.h"
#include "storage/store.h"

namespace contact {
namespace {

constexpr std::size_t kPageBytes = 1 << 20;

absl::StatusOr<EventPage> ReadPage(Store& store, EventQuery query, RunControl& control) {
  const RunControl::Hold hold(control);
  return Await<absl::StatusOr<EventPage>>(
      [&](auto done) { store.ReadEvents(std::move(query), std::move(done)); });
}

// Calls `take` with each event after `begin` and up to `end`, until it answers false.
template <class Take>
bool ForEach(Store& store, EventQuery query, std::uint64_t end, RunControl& control, Take take) {
  while (query.after < end && !control.stopping()) {
    const absl::StatusOr<EventPage> page = ReadPage(store, query, control);
    if (!page.ok()) return false;
    query.after = page->position;
    for (const StoredEvent& event : page->events) {
      if (event.sequence > end) break;
      if (!take(event)) return false;
    }
  }
  return true;
}

}  // namespace

bool Replay(Store& store, const std::string& job, std::uint64_t sequence, RunControl& control,
            RunRecorder& recorder) {
  std::uint64_t begin = 0;  // Of the attempt.
  const EventQuery attempts{job, 0, KindBit(v1::Event::kAttemptStarted), kPageBytes};
  const bool found = ForEach(store, attempts, sequence, control, [&](const StoredEvent& event) {
    begin = event.sequence;
    return event.intact;
  });
  if (!found) return false;
  return ForEach(store, {.name = job, .after = begin, .max_bytes = kPageBytes}, sequence, control,
                 [&](const StoredEvent& stored) {
                   v1::Event event;
                   if (!stored.Parse(&event)) return false;
                   recorder.Keep(std::move(event));
                   return true;
                 });
}

}  // namespace contact
