#include "storage/sqlite/purge.h"

#include <algorithm>
#include <cstdint>

#include "contact/v1/event.pb.h"
#include "storage/sqlite/database.h"

namespace contact {
namespace {

// Most events that one call removes. A log may have gigabytes, and whoever wants to commit waits
// for the call.
constexpr std::int64_t kPurgedEvents = 32;
// Most events that one call looks at.
constexpr std::int64_t kScannedEvents = 4096;

// Some events of a job that was removed. False: there is none.
bool PurgeRemoved(Database& database) {
  Query removed(database, "SELECT job FROM removed LIMIT 1");
  if (!removed.Next()) return false;
  const std::int64_t job = removed.Integer(0);
  Query events(database,
               "DELETE FROM events WHERE job=?1 AND sequence<"
               "(SELECT MIN(sequence) FROM events WHERE job=?1)+?2",
               job, kPurgedEvents);
  if (events.Run() == 0) Execute(database, "DELETE FROM removed WHERE job=?", job);
  return true;
}

// Some frame chunks of a job that is being compacted, from its position on. False: there is none.
bool PurgeCompacted(Database& database) {
  Query compacting(database,
                   "SELECT job, position, oldest_sequence FROM compacting, jobs WHERE job=number"
                   " LIMIT 1");
  if (!compacting.Next()) return false;
  const std::int64_t job = compacting.Integer(0);
  const std::int64_t position = compacting.Integer(1);
  std::int64_t next = std::min(position + kScannedEvents, compacting.Integer(2));
  Query chunks(
      database,
      "SELECT COUNT(*), MAX(sequence), SUM(bytes) FROM (SELECT sequence, LENGTH(payload) AS"
      " bytes FROM events WHERE job=? AND sequence>? AND sequence<=? AND kind=?"
      " ORDER BY sequence LIMIT ?)",
      job, position, next, v1::Event::kFrameChunk, kPurgedEvents);
  chunks.Next();
  if (chunks.Integer(0) == kPurgedEvents) next = chunks.Integer(1);
  Execute(database, "UPDATE jobs SET bytes=bytes-? WHERE number=?", chunks.Integer(2), job);
  Execute(database, "DELETE FROM events WHERE job=? AND sequence>? AND sequence<=? AND kind=?", job,
          position, next, v1::Event::kFrameChunk);
  if (next >= compacting.Integer(2)) {
    Execute(database, "DELETE FROM compacting WHERE job=?", job);
  } else {
    Execute(database, "UPDATE compacting SET position=? WHERE job=?", next, job);
  }
  return true;
}

}  // namespace

bool Purge(Database& database) { return PurgeRemoved(database) || PurgeCompacted(database); }

}  // namespace contact
