// A store that moves from one engine to the other is the same store.
#include "storage/store_copy.h"

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "storage/every_store.h"
#include "storage/sqlite/fsck.h"

namespace contact {
namespace {

// `store_` is copied from, on each engine; `other_` is of the other engine.
class StoreCopyTest : public EveryStoreTest {
 protected:
  void SetUp() override {
    Open();
    if (!postgres_) postgres_of_other_.emplace();
    auto opened = postgres_of_other_ ? OpenPostgres(postgres_of_other_->address())
                                     : OpenSqlite(directory_.path() / "other");
    ASSERT_TRUE(opened.ok()) << opened.status();
    other_ = *std::move(opened);
  }
  ~StoreCopyTest() override { other_.reset(); }

  // One job of each kind that a store can have.
  void Fill() {
    v1::Job job = MakeJob("jobs/ended");
    ASSERT_TRUE(Create(job, "request of ended").ok());
    ASSERT_TRUE(
        Append(job.name(), {FrameEvent(0, 500), LogEvent("between"), FrameEvent(500)}).ok());
    End(&job);
    job = MakeJob("jobs/compacted");
    ASSERT_TRUE(Create(job).ok());
    ASSERT_TRUE(Append(job.name(), {FrameEvent(), LogEvent("kept"), FrameEvent(64)}).ok());
    End(&job);
    ASSERT_TRUE(Compact(job.name()).ok());
    job = MakeJob("jobs/running");
    job.set_tenant("acme");
    job.set_owner("ada");
    ASSERT_TRUE(Create(job, "request of running").ok());
    const std::vector<v1::Event> events = {LogEvent("2"), LogEvent("3"), LogEvent("4")};
    const Checkpoint checkpoint{2, "state"};
    job.set_state(v1::Job::RUNNING);
    ASSERT_TRUE(Update({.name = job.name(),
                        .take = true,
                        .job = &job,
                        .events = events,
                        .checkpoint = &checkpoint})
                    .ok());
    Await<absl::StatusOr<bool>> asked;
    store_->RequestCancel(job.name(), asked.callback());
    ASSERT_TRUE(asked.Get().ok());
  }
  void End(v1::Job* job) {
    job->set_state(v1::Job::SUCCEEDED);
    job->mutable_end_time()->set_seconds(1'700'000'000);
    job->add_cycles()->set_mu(0.1 + 0.2);
    const std::vector<v1::Event> events = {StateEvent(v1::Job::SUCCEEDED)};
    ASSERT_TRUE(Update({.name = job->name(), .job = job, .events = events}).ok());
    ASSERT_TRUE(
        Remark({.name = job->name(), .labels = JobLabels{{"law", "x"}}, .note = "good"}).ok());
  }

  // All that a store tells of its jobs, as text.
  std::vector<std::string> Contents(std::unique_ptr<Store>& store) {
    std::swap(store, store_);
    std::vector<std::string> told;
    const auto page = List({});
    for (const StoredJob& job : page->jobs) {
      const auto all = Read(job.job.name());
      told.push_back(all->job.DebugString() + all->request_id +
                     (all->cancel_requested ? " cancel" : "") +
                     (all->compacted ? " compacted" : ""));
      const auto run = Read(job.job.name(), JobPart::kRun);
      told.push_back(run->checkpoint + std::to_string(run->checkpoint_sequence));
      const auto log = ReadEvents({.name = job.job.name(), .max_bytes = 1 << 20});
      for (const StoredEvent& event : log->events) {
        v1::Event parsed;
        EXPECT_TRUE(event.Parse(&parsed));
        told.push_back(std::to_string(event.sequence) + parsed.SerializeAsString());
      }
    }
    std::swap(store, store_);
    return told;
  }
  // Until no event that was given up is left.
  void AwaitPurge(std::unique_ptr<Store>& store) {
    std::swap(store, store_);
    while (!ReadEvents({.name = "jobs/compacted", .kinds = KindBit(v1::Event::kFrameChunk)})
                ->events.empty()) {
    }
    std::swap(store, store_);
  }

  std::optional<PostgresDatabase> postgres_of_other_;
  std::unique_ptr<Store> other_;
};
INSTANTIATE_FOR_EVERY_STORE(StoreCopyTest);

TEST_P(StoreCopyTest, EverythingIsTheSameAfterwards) {
  Fill();
  AwaitPurge(store_);
  const auto report = CopyStore(*store_, *other_);
  ASSERT_TRUE(report.ok()) << report.status();
  EXPECT_EQ(report->jobs, 3);
  AwaitPurge(other_);
  EXPECT_EQ(Contents(other_), Contents(store_));
  if (postgres_of_other_) return;
  other_.reset();
  const auto check = [](const std::string& finding) { ADD_FAILURE() << finding; };
  EXPECT_EQ(Fsck(directory_.path() / "other", check)->findings, 0);
}

TEST_P(StoreCopyTest, RequestIdsAreKnownInTheCopy) {
  Fill();
  ASSERT_TRUE(CopyStore(*store_, *other_).ok());
  std::swap(store_, other_);
  v1::Job again = MakeJob("jobs/ended");
  again.set_name("jobs/new");
  EXPECT_EQ(Create(again, "request of ended")->job.name(), "jobs/ended");
}

TEST_P(StoreCopyTest, StoreWithJobsIsNotCopiedInto) {
  Fill();
  ASSERT_TRUE(CopyStore(*store_, *other_).ok());
  EXPECT_TRUE(absl::IsFailedPrecondition(CopyStore(*store_, *other_).status()));
}

TEST_P(StoreCopyTest, DamageIsNotCopied) {
  Fill();
  const std::string damage = "UPDATE specs SET crc32 = crc32 + 1 WHERE job = 1";
  if (postgres_) {
    postgres_->Run("UPDATE contactd." + damage.substr(7));
  } else {
    store_.reset();
    SQLite::Database(database(), SQLite::OPEN_READWRITE).exec(damage);
    Open();
  }
  EXPECT_TRUE(absl::IsDataLoss(CopyStore(*store_, *other_).status()));
}

}  // namespace
}  // namespace contact
