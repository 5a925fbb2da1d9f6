#include "jobs/job_reader.h"

#include <fmt/format.h>

#include <cstddef>
#include <memory>
#include <utility>

#include "jobs/read/artifact_plan.h"
#include "jobs/read/list_rules.h"
#include "jobs/schedule/retention.h"

namespace contact {
namespace {

// Leaves out what is past so many bytes of a list, and says so. `what` are its entries.
template <class Entry>
void Shorten(const char* what, std::size_t most_bytes,
             google::protobuf::RepeatedPtrField<Entry>* list, v1::Job* job) {
  std::size_t bytes = 0;
  int kept = 0;
  while (kept < list->size() && bytes < most_bytes) bytes += list->Get(kept++).ByteSizeLong();
  if (kept == list->size()) return;
  job->add_warnings(
      fmt::format("only the first {0} of {1} {2} are in this answer; the artifact {2}.csv and the "
                  "job's events have all",
                  kept, list->size(), what));
  list->DeleteSubrange(kept, list->size() - kept);
}

// Shortens what would make an answer too large.
void ShortenLedger(v1::Job* job) {
  Shorten("cycles", 2 << 20, job->mutable_cycles(), job);
  Shorten("groups", 1 << 20, job->mutable_groups(), job);
}

}  // namespace

void JobReader::Get(const Principal& caller, const std::string& name,
                    Callback<v1::Job> done) const {
  store_.ReadOf(caller.tenant, name, JobPart::kAll,
                [this, name, done = std::move(done)](absl::StatusOr<StoredJob> stored) {
                  if (!stored.ok()) return done(ToError(stored.status(), name));
                  Answer(*std::move(stored), done);
                });
}

void JobReader::List(const Principal& caller, const v1::ListJobsRequest& request,
                     Callback<v1::ListJobsResponse> done) const {
  Result<JobQuery> query = ToQuery(request, tokens_.Open(caller.tenant, request.page_token()));
  if (!query.ok()) return done(query.error());
  query.value().tenant = caller.tenant;
  store_.List(std::move(query.value()),
              [this, tenant = caller.tenant, done = std::move(done)](absl::StatusOr<JobPage> page) {
                if (!page.ok()) return done(ToError(page.status(), ""));
                v1::ListJobsResponse response;
                for (StoredJob& stored : page->jobs) {
                  Complete(&stored);
                  *response.add_jobs() = std::move(stored.job);
                }
                response.set_next_page_token(tokens_.Seal(tenant, page->next));
                done(std::move(response));
              });
}

void JobReader::Complete(StoredJob* stored) const {
  v1::Job& job = stored->job;
  if (!stored->intact) {
    job.mutable_error()->set_code(static_cast<int>(absl::StatusCode::kDataLoss));
    job.mutable_error()->set_message("the stored job fails its checksum");
  }
  if (const auto record = unfinished_.Record(job)) job.MergeFrom(record->Get(false));
  SetExpireTime(options_.retention, &job);
}

void JobReader::Answer(StoredJob stored, Callback<v1::Job> done) const {
  // Asked for here, because on the store's thread the record exists exactly while the job has not
  // ended.
  const auto record = unfinished_.Record(stored.job);
  const auto whole = std::make_shared<StoredJob>(std::move(stored));
  const auto answer = [this, record, whole, done = std::move(done)] {
    v1::Job& job = whole->job;
    if (!whole->MergeResult()) return done(Damaged(job.name()));
    if (record) job.MergeFrom(record->Get(true));
    SetExpireTime(options_.retention, &job);
    ShortenLedger(&job);
    AddArtifacts(&job);
    done(std::move(job));
  };
  if (!executor_.Post(answer)) answer();  // At the end nobody has to be spared.
}

}  // namespace contact
