#include "jobs/run/replay.h"

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
  if (!hold) return absl::CancelledError("the run was given up");
  return Await<absl::StatusOr<EventPage>>(
      [&](auto done) { store.ReadEvents(std::move(query), std::move(done)); });
}

}  // namespace

bool ForEachEvent(Store& store, EventQuery query, std::uint64_t end, RunControl& control,
                  const std::function<bool(const StoredEvent&)>& take) {
  query.max_bytes = kPageBytes;
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

bool Replay(Store& store, const std::string& job, std::uint64_t sequence, RunControl& control,
            RunRecorder& recorder) {
  std::uint64_t kept = 0;  // Up to here all is handed over, or is of an earlier attempt.
  const EventQuery attempts{.name = job, .kinds = KindBit(v1::Event::kAttemptStarted)};
  const bool found = ForEachEvent(store, attempts, sequence, control, [&](const auto& event) {
    kept = event.sequence;
    return event.intact;
  });
  if (!found) return false;
  const auto keep = [&](const StoredEvent& stored) {
    v1::Event event;
    if (!stored.Parse(&event)) return false;
    recorder.Keep(std::move(event));
    kept = stored.sequence;
    return true;
  };
  return ForEachEvent(store, {.name = job, .after = kept}, sequence, control, keep) &&
         kept >= sequence;
}

}  // namespace contact
