#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "storage/every_store.h"

namespace contact {
namespace {

class JoinedChangeTest : public EveryStoreTest {
 protected:
  absl::StatusOr<std::uint64_t> Change(const JobChange& change, std::uint64_t epoch) {
    Await<absl::StatusOr<std::uint64_t>> first;
    store_->Update(std::make_shared<const JobChange>(change), epoch, first.callback());
    return first.Get();
  }
  // Begins a run, stores a checkpoint or ends it, in one change or in two.
  StoredJob Attempt(const std::string& name, bool joined, const Checkpoint* checkpoint,
                    v1::Job::State state) {
    v1::Job job = MakeJob(name);
    EXPECT_TRUE(Create(job).ok());
    const std::vector<v1::Event> begin = {StateEvent(v1::Job::RUNNING), LogEvent("begins")};
    job.set_state(v1::Job::RUNNING);
    const JobChange take = ToChange({.name = name, .take = true, .job = &job, .events = begin});
    const std::vector<v1::Event> end = {LogEvent("runs"), StateEvent(state)};
    job.set_state(state);
    const JobChange then =
        ToChange({.name = name, .job = &job, .events = end, .checkpoint = checkpoint});
    if (joined) {
      EXPECT_EQ(Change(Joined(take, then), 0).value(), 2U);
    } else {
      EXPECT_EQ(Change(take, 0).value(), 2U);
      EXPECT_EQ(Change(then, 1).value(), 4U);
    }
    Await<absl::StatusOr<StoredJob>> stored;
    store_->Read(name, JobPart::kRun, stored.callback());
    return *stored.Get();
  }
};

TEST_P(JoinedChangeTest, DoesWhatTheTwoDo) {
  Open();
  const Checkpoint checkpoint{1, "state"};
  for (const Checkpoint* point : {static_cast<const Checkpoint*>(nullptr), &checkpoint}) {
    const v1::Job::State state = point == nullptr ? v1::Job::SUCCEEDED : v1::Job::QUEUED;
    const std::string suffix = point == nullptr ? "" : "-checkpoint";
    const StoredJob one = Attempt("jobs/one" + suffix, true, point, state);
    const StoredJob two = Attempt("jobs/two" + suffix, false, point, state);
    EXPECT_EQ(one.epoch, two.epoch);
    EXPECT_EQ(one.job.state(), state);
    EXPECT_EQ(one.job.last_sequence(), two.job.last_sequence());
    EXPECT_EQ(one.checkpoint, two.checkpoint);
    EXPECT_EQ(one.checkpoint_sequence, two.checkpoint_sequence);
    const auto events = ReadEvents({.name = one.job.name()})->events;
    const auto same = ReadEvents({.name = two.job.name()})->events;
    ASSERT_EQ(events.size(), same.size());
    for (std::size_t i = 0; i < events.size(); ++i) EXPECT_EQ(events[i].bytes, same[i].bytes);
  }
}

INSTANTIATE_FOR_EVERY_STORE(JoinedChangeTest);

}  // namespace
}  // namespace contact
