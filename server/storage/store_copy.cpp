#include "storage/store_copy.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "base/future.h"
#include "storage/refusals.h"

namespace contact {
namespace {

template <class T>
using Answer = absl::StatusOr<T>;

Answer<JobPage> List(Store& store, JobQuery query) {
  return Await<Answer<JobPage>>([&](auto done) { store.List(std::move(query), std::move(done)); });
}

// The names of all jobs, the oldest first.
Answer<std::vector<std::string>> Names(Store& store) {
  std::vector<std::string> names;
  JobQuery query{.limit = 1000};
  do {
    Answer<JobPage> page = List(store, query);
    if (!page.ok()) return page.status();
    for (const StoredJob& job : page->jobs) names.push_back(job.job.name());
    query.before = page->next;
  } while (query.before != 0);
  std::ranges::reverse(names);
  return names;
}

// Events of a job's log from the one after `last` on. In the place of a frame chunk that was
// dropped stands an empty one.
Answer<std::vector<v1::Event>> Page(Store& from, const std::string& name, std::uint64_t last) {
  const Answer<EventPage> page = Await<Answer<EventPage>>([&](auto done) {
    from.ReadEvents({.name = name, .after = last, .max_bytes = 1 << 20}, std::move(done));
  });
  if (!page.ok()) return page.status();
  std::vector<v1::Event> events;
  const auto drop_until = [&](std::uint64_t sequence) {
    while (last + events.size() + 1 < sequence) events.emplace_back().mutable_frame_chunk();
  };
  for (const StoredEvent& stored : page->events) {
    drop_until(stored.sequence);
    if (!stored.Parse(&events.emplace_back())) return FailsChecksum(name);
  }
  drop_until(page->position + 1);
  return events;
}

// Copies one job after another.
class Copier {
 public:
  Copier(Store& from, Store& to) : from_(from), to_(to) {}

  absl::Status Copy(const std::string& name) {
    Answer<StoredJob> stored = Read(name, JobPart::kAll);
    if (!stored.ok()) return stored.status();
    if (!stored->MergeResult()) return FailsChecksum(name);
    v1::Job open = stored->job;  // One that has ended would take no events.
    open.set_state(v1::Job::QUEUED);
    *open.mutable_labels() = {stored->created_labels.begin(), stored->created_labels.end()};
    const NewJob made{open, stored->request_id, {}};
    const Answer<StoredJob> created =
        Await<Answer<StoredJob>>([&](auto done) { to_.Create(made, std::move(done)); });
    if (!created.ok()) return created.status();
    const Answer<StoredJob> run = Read(name, JobPart::kRun);
    if (!run.ok()) return run.status();
    if (absl::Status log = CopyLog(*run); !log.ok()) return log;
    if (absl::Status end = Update({.name = name, .job = &stored->job}); !end.ok()) return end;
    ++report_.jobs;
    return CopyMarks(*stored);
  }

  const CopyReport& report() const { return report_; }

 private:
  Answer<StoredJob> Read(const std::string& name, JobPart part) {
    return Await<Answer<StoredJob>>([&](auto done) { from_.Read(name, part, std::move(done)); });
  }

  absl::Status Update(const JobUpdate& update) {
    return Await<Answer<std::uint64_t>>([&](auto done) { to_.Update(update, std::move(done)); })
        .status();
  }

  // The checkpoint comes with the events around it.
  absl::Status CopyLog(const StoredJob& run) {
    const std::string& name = run.job.name();
    for (std::uint64_t last = 0; last < run.job.last_sequence();) {
      const Answer<std::vector<v1::Event>> events = Page(from_, name, last);
      if (!events.ok()) return events.status();
      const Checkpoint checkpoint{run.checkpoint_sequence - last, run.checkpoint};
      const bool here = !run.checkpoint.empty() && last < run.checkpoint_sequence &&
                        run.checkpoint_sequence <= last + events->size();
      absl::Status appended =
          Update({.name = name, .events = *events, .checkpoint = here ? &checkpoint : nullptr});
      if (!appended.ok()) return appended;
      last += events->size();
      report_.events += static_cast<std::int64_t>(events->size());
    }
    return absl::OkStatus();
  }

  // What people have said of a job since it was created.
  absl::Status CopyRemark(const StoredJob& stored) {
    JobRemark remark{.name = stored.job.name()};
    const JobLabels labels(stored.job.labels().begin(), stored.job.labels().end());
    if (labels != stored.created_labels) remark.labels = labels;
    if (!stored.job.note().empty()) remark.note = stored.job.note();
    if (!remark.labels && !remark.note) return absl::OkStatus();
    return Await<Answer<JobOwner>>([&](auto done) { to_.Remark(remark, std::move(done)); })
        .status();
  }

  // What else the store remembers of a job.
  absl::Status CopyMarks(const StoredJob& stored) {
    const std::string& name = stored.job.name();
    if (stored.cancel_requested) {
      absl::Status asked = Await<Answer<bool>>([&](auto done) {
                             to_.RequestCancel(name, std::move(done));
                           }).status();
      if (!asked.ok()) return asked;
    }
    if (absl::Status said = CopyRemark(stored); !said.ok()) return said;
    if (!stored.compacted) return absl::OkStatus();
    return Await<Answer<JobOwner>>([&](auto done) { to_.Compact(name, std::move(done)); }).status();
  }

  Store& from_;
  Store& to_;
  CopyReport report_;
};

}  // namespace

absl::StatusOr<CopyReport> CopyStore(Store& from, Store& to) {
  const Answer<JobPage> there = List(to, {.limit = 1});
  if (!there.ok()) return there.status();
  if (!there->jobs.empty()) return absl::FailedPreconditionError("the other store has jobs");
  const Answer<std::vector<std::string>> names = Names(from);
  if (!names.ok()) return names.status();
  Copier copier(from, to);
  for (const std::string& name : *names) {
    if (absl::Status copied = copier.Copy(name); !copied.ok()) return copied;
  }
  return copier.report();
}

}  // namespace contact
