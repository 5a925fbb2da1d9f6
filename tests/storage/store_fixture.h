#pragma once

#include <SQLiteCpp/SQLiteCpp.h>
#include <absl/strings/str_cat.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "identity/principal.h"
#include "storage/refusals.h"
#include "storage/sqlite/sqlite_store.h"
#include "testing/await.h"
#include "testing/temp_directory.h"

namespace contact {

inline v1::Job MakeJob(const std::string& name) {
  v1::Job job;
  job.set_name(name);
  job.set_state(v1::Job::QUEUED);
  job.set_title("of " + name);
  job.mutable_scenario()->set_title(job.title());
  (*job.mutable_labels())["study"] = "a";
  job.set_owner(kLocal);
  job.set_tenant(kLocal);
  return job;
}

inline v1::Event StateEvent(v1::Job::State state) {
  v1::Event event;
  event.mutable_state_changed()->set_state(state);
  return event;
}

inline v1::Event LogEvent(const std::string& message) {
  v1::Event event;
  event.mutable_log_entry()->set_message(message);
  return event;
}

/// A part of a smooth motion, of two columns.
inline v1::Event FrameEvent(int first_sample = 0, int samples = 64) {
  v1::Event event;
  event.mutable_frame_chunk()->set_first_sample(first_sample);
  event.mutable_frame_chunk()->set_samples(samples);
  for (const double speed : {1.0, -3.7}) {
    auto* column = event.mutable_frame_chunk()->add_columns();
    column->set_name("B.position");
    for (int i = 0; i < samples; ++i) {
      const double value = std::sin(1e-3 * speed * (first_sample + i));
      column->mutable_values()->append(reinterpret_cast<const char*>(&value), sizeof value);
    }
  }
  return event;
}

/// A store in a folder of its own, with calls that wait.
class StoreTest : public testing::Test {
 protected:
  void Open(StoreOptions options = {}) {
    store_.reset();
    auto opened = OpenStore(std::move(options));
    ASSERT_TRUE(opened.ok()) << opened.status();
    store_ = *std::move(opened);
  }

  virtual absl::StatusOr<std::unique_ptr<Store>> OpenStore(StoreOptions options) {
    return OpenSqlite(path(), std::move(options));
  }
  // The one number that a query of the tables answers, while the store is closed.
  virtual std::int64_t Number(const std::string& sql) {
    return SQLite::Database(database()).execAndGet(sql).getInt64();
  }

  std::filesystem::path path() const { return directory_.path() / "data"; }
  std::filesystem::path database() const { return path() / "contactd.db"; }

  absl::StatusOr<StoredJob> Create(const v1::Job& job, const std::string& request_id = "") {
    const std::vector<v1::Event> events = {StateEvent(v1::Job::QUEUED)};
    Await<absl::StatusOr<StoredJob>> result;
    store_->Create({job, request_id, events}, result.callback());
    return result.Get();
  }
  absl::StatusOr<std::uint64_t> Update(const JobUpdate& update) {
    Await<absl::StatusOr<std::uint64_t>> result;
    store_->Update(update, result.callback());
    return result.Get();
  }
  absl::StatusOr<std::uint64_t> Append(const std::string& name,
                                       const std::vector<v1::Event>& events) {
    return Update({.name = name, .epoch = 0, .events = events});
  }
  absl::StatusOr<StoredJob> Read(const std::string& name, JobPart part = JobPart::kAll) {
    Await<absl::StatusOr<StoredJob>> result;
    store_->Read(name, part, result.callback());
    absl::StatusOr<StoredJob> stored = result.Get();
    if (stored.ok() && !stored->MergeResult()) return absl::DataLossError("the result is damaged");
    return stored;
  }
  absl::StatusOr<StoredJob> ReadOf(const std::string& tenant, const std::string& name) {
    Await<absl::StatusOr<StoredJob>> result;
    store_->ReadOf(tenant, name, JobPart::kAll, result.callback());
    return result.Get();
  }
  absl::StatusOr<JobOwner> Owner(const std::string& tenant, const std::string& name) {
    Await<absl::StatusOr<JobOwner>> result;
    store_->Owner(tenant, name, result.callback());
    return result.Get();
  }
  absl::StatusOr<JobPage> List(JobQuery query) {
    Await<absl::StatusOr<JobPage>> result;
    store_->List(std::move(query), result.callback());
    return result.Get();
  }
  absl::StatusOr<EventPage> ReadEvents(EventQuery query) {
    Await<absl::StatusOr<EventPage>> result;
    store_->ReadEvents(std::move(query), result.callback());
    return result.Get();
  }
  absl::StatusOr<std::unique_ptr<BackupFile>> Backup(std::stop_token stop = {}) {
    Await<absl::StatusOr<std::unique_ptr<BackupFile>>> result;
    store_->Backup(std::move(stop), result.callback());
    return result.Get();
  }
  absl::StatusOr<std::vector<JobSize>> Sizes() {
    Await<absl::StatusOr<std::vector<JobSize>>> result;
    store_->Sizes(result.callback());
    return result.Get();
  }
  // What the tables hold of a job beside its row. Closes the store for a moment.
  std::int64_t StoredBytes(const std::string& name) {
    store_.reset();
    std::int64_t bytes = 0;
    for (const std::string part :
         {"payload)), 0) FROM events", "spec)), 0) FROM specs", "result)), 0) FROM results"}) {
      bytes += Number(absl::StrCat("SELECT COALESCE(SUM(LENGTH(", part,
                                   " WHERE job=(SELECT number FROM jobs WHERE name='", name, "')"));
    }
    Open();
    return bytes;
  }
  absl::Status Remark(const JobRemark& remark) {
    Await<absl::StatusOr<JobOwner>> result;
    store_->Remark(remark, result.callback());
    return result.Get().status();
  }
  absl::Status Delete(const std::string& name, const std::string& expected_uid = "") {
    Await<absl::StatusOr<JobOwner>> result;
    store_->Delete(name, expected_uid, result.callback());
    return result.Get().status();
  }
  absl::Status Compact(const std::string& name) {
    Await<absl::StatusOr<JobOwner>> result;
    store_->Compact(name, result.callback());
    return result.Get().status();
  }

  TempDirectory directory_;
  std::unique_ptr<Store> store_;
};

}  // namespace contact
