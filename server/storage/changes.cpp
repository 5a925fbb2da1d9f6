#include "storage/changes.h"

#include <absl/strings/str_cat.h>

#include <atomic>
#include <random>

namespace contact {
namespace {

// Begins anywhere, so that two processes hardly ever give the same number.
std::uint64_t NextId() {
  static std::atomic<std::uint64_t> next =
      std::uint64_t{std::random_device{}()} << 32 | std::random_device{}();
  return ++next;
}

}  // namespace

JobInsert ToInsert(const NewJob& job) {
  JobInsert insert{.name = job.job.name(),
                   .request_key = {},
                   .whose = {OwnerOf(job.job), TenantOf(job.job)},
                   .state = job.job.state(),
                   .uid = job.job.uid(),
                   .labels = {},
                   .parts = Split(job.job),
                   .events = ToRows(job.events),
                   .may_create = job.may_create,
                   .max_owner_bytes = job.max_owner_bytes,
                   .limits = job.limits,
                   .priority = job.job.priority(),
                   .cells = job.job.progress().cells()};
  insert.labels.insert(job.job.labels().begin(), job.job.labels().end());
  // The id belongs to its tenant, whose name has no slash.
  if (!job.request_id.empty()) {
    insert.request_key = absl::StrCat(insert.whose.tenant, "/", job.request_id);
  }
  return insert;
}

std::string RequestIdOf(const std::string& request_key, const std::string& tenant) {
  const std::string prefix = tenant + "/";
  return request_key.starts_with(prefix) ? request_key.substr(prefix.size()) : "";
}

JobChange ToChange(const JobUpdate& update) {
  JobChange change{update.name, NextId(), update.take, 0, {}, ToRows(update.events), {}};
  if (update.checkpoint != nullptr) change.checkpoint = *update.checkpoint;
  if (update.job != nullptr) {
    change.state = update.job->state();
    change.parts = Split(*update.job);
  }
  return change;
}

JobChange Joined(const JobChange& first, const JobChange& last) {
  JobChange both = last;
  both.take = first.take || last.take;
  if (both.parts.header.empty()) {
    both.state = first.state;
    both.parts = first.parts;
  }
  both.events.insert(both.events.begin(), first.events.begin(), first.events.end());
  if (both.checkpoint) {
    both.checkpoint->events += first.events.size();
  } else {
    both.checkpoint = first.checkpoint;
  }
  return both;
}

std::string BytesOf(const JobLabels& labels) {
  v1::Job job;
  job.mutable_labels()->insert(labels.begin(), labels.end());
  return Split(job).spec;
}

std::size_t BytesOf(const std::vector<EventRow>& events) {
  std::size_t bytes = 0;
  for (const EventRow& row : events) bytes += row.event.bytes.size();
  return bytes;
}

}  // namespace contact
