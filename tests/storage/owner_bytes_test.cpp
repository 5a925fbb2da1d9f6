// The sums of what the jobs of each owner take are those of their rows, whatever happens.
#include <absl/strings/cord.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "storage/every_store.h"
#include "testing/await.h"

namespace contact {
namespace {

const JobOwner kAda{"ada", "acme"};
const JobOwner kBob{"bob", "acme"};

class OwnerBytesTest : public EveryStoreTest {
 protected:
  static v1::Job Of(const JobOwner& whose, const std::string& name) {
    v1::Job job = MakeJob(name);
    job.set_owner(whose.owner);
    job.set_tenant(whose.tenant);
    return job;
  }
  std::int64_t BytesOf(const JobOwner& whose) {
    Await<absl::StatusOr<std::int64_t>> bytes;
    store_->OwnerBytes(whose, bytes.callback());
    return bytes.Get().value();
  }
  // What the tables hold of these jobs. Closes the store for a moment.
  std::int64_t Stored(const std::vector<std::string>& names) {
    std::int64_t bytes = 0;
    for (const std::string& name : names) bytes += StoredBytes(name);
    return bytes;
  }
  void End(v1::Job job) {
    job.set_state(v1::Job::SUCCEEDED);
    job.mutable_end_time()->set_seconds(7);
    job.add_cycles()->set_contact("A-B");
    ASSERT_TRUE(Update({.name = job.name(), .job = &job}).ok());
  }
};

INSTANTIATE_FOR_EVERY_STORE(OwnerBytesTest);

TEST_P(OwnerBytesTest, SumIsThatOfTheRowsThroughTheLifeOfJobs) {
  Open();
  EXPECT_EQ(BytesOf(kAda), 0);
  const std::vector<std::string> names = {"jobs/a", "jobs/b"};
  for (const std::string& name : names) ASSERT_TRUE(Create(Of(kAda, name)).ok());
  ASSERT_TRUE(Create(Of(kBob, "jobs/c")).ok());
  ASSERT_TRUE(Append("jobs/a", {FrameEvent(), FrameEvent(64), LogEvent("x")}).ok());
  const std::int64_t grown = BytesOf(kAda);
  EXPECT_EQ(grown, Stored(names));
  EXPECT_EQ(BytesOf(kAda), grown) << "after a restart";
  End(Of(kAda, "jobs/a"));
  EXPECT_GT(BytesOf(kAda), grown) << "its result has come";
  EXPECT_EQ(BytesOf(kAda), Stored(names));
  const std::int64_t whole = BytesOf(kAda);
  ASSERT_TRUE(Compact("jobs/a").ok());
  EXPECT_TRUE(Eventually([&] {  // Events go while there is nothing else to do.
    const std::int64_t stored = Stored(names);
    return stored < whole && BytesOf(kAda) == stored;
  })) << BytesOf(kAda);
  ASSERT_TRUE(Delete("jobs/a").ok());
  EXPECT_EQ(BytesOf(kAda), Stored({"jobs/b"}));
  EXPECT_EQ(BytesOf(kBob), Stored({"jobs/c"}));
}

TEST_P(OwnerBytesTest, RefusedChangeCountsNothing) {
  Open();
  ASSERT_TRUE(Create(Of(kAda, "jobs/a")).ok());
  const std::int64_t bytes = BytesOf(kAda);
  v1::Job other = Of(kAda, "jobs/a");
  other.set_uid("other");
  EXPECT_FALSE(Create(other).ok()) << "the name is taken: the transaction is undone";
  EXPECT_FALSE(Update({.name = "jobs/a", .epoch = 9, .events = {}}).ok());
  EXPECT_EQ(BytesOf(kAda), bytes);
}

TEST_P(OwnerBytesTest, NewJobOfAnOwnerWithTooMuchIsRefusedAndARepeatedOneAnswered) {
  Open();
  const std::vector<v1::Event> events = {StateEvent(v1::Job::QUEUED)};
  const auto create = [&](const JobOwner& whose, const std::string& name, const std::string& id) {
    v1::Job job = Of(whose, name);
    job.clear_title();
    job.mutable_scenario()->clear_title();
    Await<absl::StatusOr<StoredJob>> result;
    store_->Create({job, id, events, true, 1}, result.callback());
    return result.Get();
  };
  ASSERT_TRUE(create(kAda, "jobs/a", "first").ok());
  const absl::Status refused = create(kAda, "jobs/b", "second").status();
  EXPECT_TRUE(absl::IsResourceExhausted(refused));
  EXPECT_EQ(refused.GetPayload(kOwnerBytesPayload), absl::Cord(std::to_string(BytesOf(kAda))));
  EXPECT_FALSE(create(kAda, "jobs/z", "first")->created);
  EXPECT_TRUE(create(kBob, "jobs/c", "").ok());
}

}  // namespace
}  // namespace contact
