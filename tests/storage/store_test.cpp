#include "storage/store.h"

#include <gmock/gmock.h>

#include "storage/every_store.h"

namespace contact {
namespace {

using testing::ElementsAre;

std::vector<std::string> Names(const JobPage& page) {
  std::vector<std::string> names;
  for (const StoredJob& job : page.jobs) names.push_back(job.job.name());
  return names;
}

std::vector<std::uint64_t> Sequences(const EventPage& page) {
  std::vector<std::uint64_t> sequences;
  sequences.reserve(page.events.size());
  for (const StoredEvent& event : page.events) sequences.push_back(event.sequence);
  return sequences;
}

using StoreCallsTest = EveryStoreTest;
INSTANTIATE_FOR_EVERY_STORE(StoreCallsTest);

TEST_P(StoreCallsTest, JobSurvivesReopening) {
  Open();
  const v1::Job job = MakeJob("jobs/a");
  ASSERT_TRUE(Create(job).ok());
  Open();
  const auto stored = Read("jobs/a");
  ASSERT_TRUE(stored.ok()) << stored.status();
  EXPECT_EQ(stored->job.scenario().title(), "of jobs/a");
  EXPECT_EQ(stored->job.labels().at("study"), "a");
  EXPECT_EQ(stored->job.state(), v1::Job::QUEUED);
  EXPECT_EQ(stored->job.last_sequence(), 1U);
}

TEST_P(StoreCallsTest, MissingJobIsNotFound) {
  Open();
  EXPECT_TRUE(absl::IsNotFound(Read("jobs/none").status()));
  EXPECT_TRUE(absl::IsNotFound(Delete("jobs/none")));
  EXPECT_TRUE(absl::IsNotFound(Append("jobs/none", {}).status()));
  EXPECT_TRUE(absl::IsNotFound(ReadEvents({.name = "jobs/none"}).status()));
}

TEST_P(StoreCallsTest, RepeatedRequestAnswersTheSameJob) {
  Open();
  ASSERT_TRUE(Create(MakeJob("jobs/a"), "request").ok());
  v1::Job again = MakeJob("jobs/a");
  again.set_name("jobs/b");
  const auto repeated = Create(again, "request");
  ASSERT_TRUE(repeated.ok()) << repeated.status();
  EXPECT_EQ(repeated->job.name(), "jobs/a");
  EXPECT_FALSE(repeated->created);
  EXPECT_TRUE(absl::IsNotFound(Read("jobs/b").status()));
}

TEST_P(StoreCallsTest, ResultIsReadAsBytesAndParsedByWhoeverAsked) {
  Open();
  v1::Job job = MakeJob("jobs/a");
  ASSERT_TRUE(Create(job).ok());
  job.add_cycles()->set_number(7);
  ASSERT_TRUE(Update({.name = job.name(), .epoch = 0, .job = &job}).ok());
  Await<absl::StatusOr<StoredJob>> read;
  store_->Read(job.name(), JobPart::kAll, read.callback());
  absl::StatusOr<StoredJob> stored = read.Get();
  ASSERT_TRUE(stored.ok());
  EXPECT_EQ(stored->job.cycles_size(), 0);
  StoredJob damaged = *stored;
  damaged.result.front() = static_cast<char>(damaged.result.front() ^ 1);
  EXPECT_FALSE(damaged.MergeResult());
  ASSERT_TRUE(stored->MergeResult());
  ASSERT_EQ(stored->job.cycles_size(), 1);
  EXPECT_EQ(stored->job.cycles(0).number(), 7);
}

TEST_P(StoreCallsTest, RequestIdNamesOneJobOnly) {
  Open();
  ASSERT_TRUE(Create(MakeJob("jobs/a"), "request").ok());
  EXPECT_TRUE(absl::IsAlreadyExists(Create(MakeJob("jobs/b"), "request").status()));
  EXPECT_TRUE(Create(MakeJob("jobs/b"), "other request").ok());
  EXPECT_TRUE(Create(MakeJob("jobs/c"), "").ok());
  EXPECT_TRUE(Create(MakeJob("jobs/d"), "").ok());
}

TEST_P(StoreCallsTest, JobThatMayNotBeCreatedIsOnlyFound) {
  Open();
  const v1::Job job = MakeJob("jobs/a");
  Await<absl::StatusOr<StoredJob>> refused;
  store_->Create({job, "request", {}, false}, refused.callback());
  EXPECT_TRUE(absl::IsResourceExhausted(refused.Get().status()));
  ASSERT_TRUE(Create(job, "request").ok());
  Await<absl::StatusOr<StoredJob>> found;
  store_->Create({job, "request", {}, false}, found.callback());
  EXPECT_TRUE(found.Get().ok());
}

TEST_P(StoreCallsTest, SequencesAreDensePerJob) {
  Open();
  ASSERT_TRUE(Create(MakeJob("jobs/a")).ok());
  ASSERT_TRUE(Create(MakeJob("jobs/b")).ok());
  EXPECT_EQ(*Append("jobs/a", {LogEvent("2"), LogEvent("3")}), 2U);
  EXPECT_EQ(*Append("jobs/b", {LogEvent("2")}), 2U);
  EXPECT_EQ(*Append("jobs/a", {LogEvent("4")}), 4U);
  const auto page = ReadEvents({.name = "jobs/a"});
  ASSERT_TRUE(page.ok());
  EXPECT_THAT(Sequences(*page), ElementsAre(1, 2, 3, 4));
  EXPECT_EQ(page->position, 4U);
  v1::Event event;
  ASSERT_TRUE(page->events[3].Parse(&event));
  EXPECT_EQ(event.log_entry().message(), "4");
}

TEST_P(StoreCallsTest, StaleOwnerIsFencedOff) {
  Open();
  ASSERT_TRUE(Create(MakeJob("jobs/a")).ok());
  ASSERT_TRUE(Update({.name = "jobs/a", .epoch = 0, .take = true}).ok());
  const v1::Job job = MakeJob("jobs/a");
  const std::vector<v1::Event> events = {LogEvent("late")};
  const auto late = Update({.name = "jobs/a", .epoch = 0, .job = &job, .events = events});
  EXPECT_TRUE(absl::IsAborted(late.status()));
  EXPECT_EQ(Read("jobs/a")->job.last_sequence(), 1U);
  EXPECT_EQ(Read("jobs/a")->epoch, 1U);
  EXPECT_TRUE(Update({.name = "jobs/a", .epoch = 1, .events = events}).ok());
}

TEST_P(StoreCallsTest, EndedJobIsNotChangedAgain) {
  Open();
  ASSERT_TRUE(Create(MakeJob("jobs/a")).ok());
  v1::Job ended = MakeJob("jobs/a");
  ended.set_state(v1::Job::CANCELLED);
  const std::vector<v1::Event> events = {StateEvent(v1::Job::CANCELLED)};
  ASSERT_TRUE(Update({.name = "jobs/a", .epoch = 0, .job = &ended, .events = events}).ok());
  // Whoever has lost the answer may ask for the same by another change.
  const auto again = Update({.name = "jobs/a", .epoch = 0, .job = &ended, .events = events});
  EXPECT_TRUE(absl::IsAborted(again.status())) << again.status();
  ended.set_state(v1::Job::SUCCEEDED);
  EXPECT_TRUE(absl::IsAborted(Update({.name = "jobs/a", .epoch = 0, .job = &ended}).status()));
  EXPECT_EQ(Read("jobs/a")->job.state(), v1::Job::CANCELLED);
  EXPECT_EQ(Read("jobs/a")->job.last_sequence(), 2U);
}

TEST_P(StoreCallsTest, ChangeOfJobKeepsItsSpecAndAddsItsResult) {
  Open();
  ASSERT_TRUE(Create(MakeJob("jobs/a")).ok());
  v1::Job ended;
  ended.set_name("jobs/a");
  ended.set_state(v1::Job::SUCCEEDED);
  ended.add_cycles()->set_restitution_out(0.7);
  ended.add_final_bodies()->set_velocity_m_per_s(-0.0);
  const std::vector<v1::Event> events = {StateEvent(v1::Job::SUCCEEDED)};
  ASSERT_TRUE(Update({.name = "jobs/a", .epoch = 0, .job = &ended, .events = events}).ok());
  const v1::Job all = Read("jobs/a")->job;
  EXPECT_EQ(all.scenario().title(), "of jobs/a");
  EXPECT_EQ(all.state(), v1::Job::SUCCEEDED);
  ASSERT_EQ(all.cycles_size(), 1);
  EXPECT_EQ(all.cycles(0).restitution_out(), 0.7);
  EXPECT_EQ(all.last_sequence(), 2U);
  const v1::Job header = Read("jobs/a", JobPart::kHeader)->job;
  EXPECT_FALSE(header.has_scenario());
  EXPECT_EQ(header.cycles_size() + header.final_bodies_size(), 0);
}

TEST_P(StoreCallsTest, WishToCancelIsRemembered) {
  Open();
  ASSERT_TRUE(Create(MakeJob("jobs/a")).ok());
  Await<absl::StatusOr<bool>> requested;
  store_->RequestCancel("jobs/a", requested.callback());
  ASSERT_TRUE(requested.Get().ok());
  ASSERT_TRUE(Append("jobs/a", {LogEvent("2")}).ok());
  Open();
  EXPECT_TRUE(Read("jobs/a")->cancel_requested);
}

TEST_P(StoreCallsTest, LabelsAndNoteOfARemarkAreThoseOfTheJob) {
  Open();
  ASSERT_TRUE(Create(MakeJob("jobs/a"), "request").ok());
  ASSERT_TRUE(Remark({.name = "jobs/a", .labels = JobLabels{{"law", "x"}}, .note = "β"}).ok());
  ASSERT_TRUE(Remark({.name = "jobs/a", .note = "two\nlines"}).ok());
  v1::Job ended = MakeJob("jobs/a");  // What a run that knows nothing of it writes.
  ended.set_state(v1::Job::SUCCEEDED);
  ASSERT_TRUE(Update({.name = "jobs/a", .job = &ended}).ok());
  Open();
  for (const JobPart part : {JobPart::kHeader, JobPart::kSpec, JobPart::kRun, JobPart::kAll}) {
    const v1::Job job = Read("jobs/a", part)->job;
    EXPECT_EQ(JobLabels(job.labels().begin(), job.labels().end()), (JobLabels{{"law", "x"}}));
    EXPECT_EQ(job.note(), "two\nlines");
  }
  EXPECT_THAT(Names(*List({.labels = {{"law", "x"}}})), ElementsAre("jobs/a"));
  EXPECT_THAT(Names(*List({.labels = {{"study", "a"}}})), ElementsAre());
  v1::Job again = MakeJob("jobs/a");
  again.set_name("jobs/b");
  EXPECT_EQ(Create(again, "request")->job.note(), "two\nlines") << "the same request";
}

TEST_P(StoreCallsTest, RemarkMayTakeEverythingAway) {
  Open();
  ASSERT_TRUE(Create(MakeJob("jobs/a")).ok());
  ASSERT_TRUE(Remark({.name = "jobs/a", .labels = JobLabels{}, .note = "x"}).ok());
  ASSERT_TRUE(Remark({.name = "jobs/a", .note = ""}).ok());
  EXPECT_EQ(Read("jobs/a")->job.labels_size(), 0);
  EXPECT_EQ(Read("jobs/a")->job.note(), "");
  EXPECT_EQ(Read("jobs/a")->created_labels, (JobLabels{{"study", "a"}}));
}

TEST_P(StoreCallsTest, RemarkIsOfTheJobExpectedOnly) {
  Open();
  v1::Job job = MakeJob("jobs/a");
  job.set_uid("one");
  ASSERT_TRUE(Create(job).ok());
  const absl::Status other = Remark({.name = "jobs/a", .expected_uid = "two", .note = "x"});
  EXPECT_TRUE(other.GetPayload(kUidPayload)) << other;
  EXPECT_EQ(Read("jobs/a")->job.note(), "");
  EXPECT_TRUE(Remark({.name = "jobs/a", .expected_uid = "one", .note = "x"}).ok());
  EXPECT_TRUE(absl::IsNotFound(Remark({.name = "jobs/none", .note = "x"})));
}

TEST_P(StoreCallsTest, EventsArePagedBySize) {
  Open();
  ASSERT_TRUE(Create(MakeJob("jobs/a")).ok());
  const std::vector<v1::Event> events(10, LogEvent(std::string(1000, 'x')));
  ASSERT_TRUE(Append("jobs/a", events).ok());
  EventQuery query{.name = "jobs/a", .max_bytes = 2500};
  std::vector<std::uint64_t> all;
  for (int pages = 0; query.after < 11; ++pages) {
    ASSERT_LT(pages, 11);
    const auto page = ReadEvents(query);
    ASSERT_TRUE(page.ok());
    EXPECT_LE(page->events.size(), 4U);
    for (const std::uint64_t sequence : Sequences(*page)) all.push_back(sequence);
    query.after = page->position;
  }
  EXPECT_THAT(all, ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11));
}

TEST_P(StoreCallsTest, PageHoldsAtLeastOneEventHoweverLarge) {
  Open();
  ASSERT_TRUE(Create(MakeJob("jobs/a")).ok());
  ASSERT_TRUE(Append("jobs/a", {LogEvent(std::string(100'000, 'x'))}).ok());
  const auto page = ReadEvents({.name = "jobs/a", .after = 1, .max_bytes = 1});
  ASSERT_TRUE(page.ok());
  EXPECT_THAT(Sequences(*page), ElementsAre(2));
}

TEST_P(StoreCallsTest, KindsAreFilteredAndPositionPassesOverTheOthers) {
  Open();
  ASSERT_TRUE(Create(MakeJob("jobs/a")).ok());
  ASSERT_TRUE(
      Append("jobs/a", {LogEvent("2"), LogEvent("3"), StateEvent(v1::Job::RUNNING), LogEvent("5")})
          .ok());
  const auto page = ReadEvents({.name = "jobs/a", .kinds = KindBit(v1::Event::kStateChanged)});
  ASSERT_TRUE(page.ok());
  EXPECT_THAT(Sequences(*page), ElementsAre(1, 4));
  EXPECT_EQ(page->position, 5U);
}

TEST_P(StoreCallsTest, PositionNeverGoesBack) {
  Open();
  ASSERT_TRUE(Create(MakeJob("jobs/a")).ok());
  for (const std::uint64_t after : {std::uint64_t{99}, UINT64_MAX}) {
    const auto page = ReadEvents({.name = "jobs/a", .after = after});
    ASSERT_TRUE(page.ok());
    EXPECT_TRUE(page->events.empty());
    EXPECT_EQ(page->position, after);
  }
}

TEST_F(StoreTest, PageThatNobodyWaitsForIsNotRead) {
  Open();
  ASSERT_TRUE(Create(MakeJob("jobs/a")).ok());
  bool abandoned = false;
  const auto look = [&abandoned] { return abandoned; };
  EXPECT_TRUE(List({.abandoned = look}).ok());
  EXPECT_TRUE(ReadEvents({.name = "jobs/a", .abandoned = look}).ok());
  abandoned = true;
  EXPECT_TRUE(absl::IsCancelled(List({.abandoned = look}).status()));
  EXPECT_TRUE(absl::IsCancelled(ReadEvents({.name = "jobs/a", .abandoned = look}).status()));
}

TEST_P(StoreCallsTest, ListIsPagedNewestFirst) {
  Open();
  for (const char* name : {"jobs/a", "jobs/b", "jobs/c", "jobs/d", "jobs/e"}) {
    ASSERT_TRUE(Create(MakeJob(name)).ok());
  }
  auto page = List({.limit = 2});
  EXPECT_THAT(Names(*page), ElementsAre("jobs/e", "jobs/d"));
  page = List({.before = page->next, .limit = 2});
  EXPECT_THAT(Names(*page), ElementsAre("jobs/c", "jobs/b"));
  page = List({.before = page->next, .limit = 2});
  EXPECT_THAT(Names(*page), ElementsAre("jobs/a"));
  EXPECT_EQ(page->next, 0);
  EXPECT_FALSE(page->jobs[0].job.has_scenario());
}

TEST_P(StoreCallsTest, ListIsFilteredByStateAndByEveryLabel) {
  Open();
  v1::Job job = MakeJob("jobs/a");
  ASSERT_TRUE(Create(job).ok());
  job.set_name("jobs/b");
  (*job.mutable_labels())["user"] = "ann";
  ASSERT_TRUE(Create(job).ok());
  job.set_name("jobs/c");
  job.set_state(v1::Job::RUNNING);
  ASSERT_TRUE(Create(job).ok());
  EXPECT_THAT(Names(*List({.states = {v1::Job::RUNNING}})), ElementsAre("jobs/c"));
  EXPECT_THAT(Names(*List({.labels = {{"user", "ann"}, {"study", "a"}}})),
              ElementsAre("jobs/c", "jobs/b"));
  EXPECT_THAT(Names(*List({.states = {v1::Job::QUEUED}, .labels = {{"user", "ann"}}})),
              ElementsAre("jobs/b"));
  EXPECT_THAT(Names(*List({.labels = {{"user", "bob"}}})), ElementsAre());
}

TEST_P(StoreCallsTest, ListIsFilteredByTheBeginningOfTheName) {
  Open();
  for (const char* name : {"jobs/ab1", "jobs/b", "jobs/abz", "jobs/ac", "jobs/a"}) {
    ASSERT_TRUE(Create(MakeJob(name)).ok());
  }
  EXPECT_THAT(Names(*List({.name_prefix = "jobs/ab"})), ElementsAre("jobs/abz", "jobs/ab1"));
  EXPECT_THAT(Names(*List({.name_prefix = "jobs/a", .limit = 2})),
              ElementsAre("jobs/a", "jobs/ac"));
  EXPECT_THAT(Names(*List({.labels = {{"study", "a"}}, .name_prefix = "jobs/ac"})),
              ElementsAre("jobs/ac"));
  EXPECT_THAT(Names(*List({.name_prefix = "jobs/abcd"})), ElementsAre());
}

TEST_P(StoreCallsTest, UnfinishedJobsComeInTheOrderOfTheirCreation) {
  Open();
  v1::Job job = MakeJob("jobs/z");
  ASSERT_TRUE(Create(job).ok());
  job.set_name("jobs/m");
  job.set_state(v1::Job::SUCCEEDED);
  ASSERT_TRUE(Create(job).ok());
  job.set_name("jobs/a");
  job.set_state(v1::Job::RUNNING);
  ASSERT_TRUE(Create(job).ok());
  Await<absl::StatusOr<std::vector<StoredJob>>> unfinished;
  store_->ListUnfinished(unfinished.callback());
  EXPECT_THAT(Names({*unfinished.Get()}), ElementsAre("jobs/z", "jobs/a"));
}

TEST_P(StoreCallsTest, FramesAreStoredCompressedAndReadAsTheyWere) {
  Open();
  ASSERT_TRUE(Create(MakeJob("jobs/a")).ok());
  const v1::Event frames = FrameEvent(0, 1000);
  ASSERT_TRUE(Append("jobs/a", {frames, LogEvent("3"), frames}).ok());
  const auto page = ReadEvents({.name = "jobs/a", .after = 1, .max_bytes = 1 << 20});
  ASSERT_EQ(page->events.size(), 3U);
  v1::Event read;
  ASSERT_TRUE(page->events[0].Parse(&read));
  EXPECT_EQ(read.SerializeAsString(), frames.SerializeAsString());
  EXPECT_LT(page->events[0].bytes.size(), frames.ByteSizeLong() * 2 / 3);
  EXPECT_EQ(page->events[2].bytes, page->events[0].bytes);
  ASSERT_TRUE(page->events[1].Parse(&read));
  EXPECT_EQ(read.log_entry().message(), "3");
}

TEST_P(StoreCallsTest, PageIsMeasuredAsItsReadersSeeIt) {
  Open();
  ASSERT_TRUE(Create(MakeJob("jobs/a")).ok());
  ASSERT_TRUE(Append("jobs/a", std::vector<v1::Event>(20, FrameEvent(0, 1000))).ok());
  const auto page = ReadEvents({.name = "jobs/a", .after = 1, .max_bytes = 50'000});
  EXPECT_EQ(page->events.size(), 4U) << "of 16 kB each";
}

TEST_P(StoreCallsTest, SizesAreThoseOfEndedJobsOldestEndFirst) {
  Open();
  v1::Job job = MakeJob("jobs/a");
  ASSERT_TRUE(Create(job).ok());
  job.set_name("jobs/b");
  ASSERT_TRUE(Create(job).ok());
  ASSERT_TRUE(Create(MakeJob("jobs/c")).ok());
  EXPECT_TRUE(Sizes()->empty()) << "none has ended";
  ASSERT_TRUE(Append("jobs/a", {FrameEvent(), LogEvent("x")}).ok());
  job.set_state(v1::Job::SUCCEEDED);
  job.add_cycles()->set_mu(1);
  job.mutable_end_time()->set_seconds(1'700'000'002);
  job.set_name("jobs/a");
  ASSERT_TRUE(Update({.name = "jobs/a", .epoch = 0, .job = &job}).ok());
  job.set_name("jobs/b");
  job.set_state(v1::Job::RUNNING);
  job.clear_end_time();
  ASSERT_TRUE(Update({.name = "jobs/b", .epoch = 0, .job = &job}).ok());
  job.add_cycles()->set_mu(2);  // A result that replaces another counts once.
  job.set_state(v1::Job::FAILED);
  job.mutable_end_time()->set_seconds(1'700'000'001);
  ASSERT_TRUE(Update({.name = "jobs/b", .epoch = 0, .job = &job}).ok());
  const auto sizes = Sizes();
  ASSERT_EQ(sizes->size(), 2U);
  EXPECT_EQ((*sizes)[0].name, "jobs/b");
  EXPECT_EQ((*sizes)[0].end_time, 1'700'000'001);
  EXPECT_EQ((*sizes)[1].name, "jobs/a");
  for (const JobSize& size : *sizes) EXPECT_EQ(size.bytes, StoredBytes(size.name)) << size.name;
}

TEST_P(StoreCallsTest, DeleteTakesEverythingOfAnEndedJob) {
  Open();
  v1::Job job = MakeJob("jobs/a");
  ASSERT_TRUE(Create(job).ok());
  ASSERT_TRUE(Append("jobs/a", std::vector<v1::Event>(1000, LogEvent("x"))).ok());
  EXPECT_TRUE(absl::IsFailedPrecondition(Delete("jobs/a")));
  job.set_state(v1::Job::CANCELLED);
  job.add_cycles();
  ASSERT_TRUE(Update({.name = "jobs/a", .epoch = 0, .job = &job}).ok());
  EXPECT_TRUE(Delete("jobs/a").ok());
  EXPECT_TRUE(absl::IsNotFound(Read("jobs/a").status()));
  // Its events go while there is nothing else to do, also after a restart.
  std::int64_t left = -1;
  for (int i = 0; i < 100 && left != 0; ++i) {
    for (int calls = 0; calls < 50; ++calls) (void)Read("jobs/a");
    store_.reset();
    left = 0;
    for (const char* table : {"jobs", "labels", "specs", "results", "events", "removed"}) {
      left += Number(std::string("SELECT COUNT(*) FROM ") + table);
    }
    Open();
  }
  EXPECT_EQ(left, 0);
}

TEST_P(StoreCallsTest, OnlyTheJobExpectedIsDeleted) {
  Open();
  v1::Job job = MakeJob("jobs/a");
  job.set_uid("this");
  job.set_state(v1::Job::SUCCEEDED);
  ASSERT_TRUE(Create(job).ok());
  const absl::Status refused = Delete("jobs/a", "that");
  EXPECT_TRUE(absl::IsAborted(refused));
  EXPECT_EQ(refused.GetPayload(kUidPayload), "this");
  EXPECT_TRUE(Delete("jobs/a", "this").ok());
}

TEST_P(StoreCallsTest, CompactionDropsFrameChunksOfAnEndedJobOnly) {
  Open();
  v1::Job job = MakeJob("jobs/a");
  ASSERT_TRUE(Create(job).ok());
  std::vector<v1::Event> events;
  for (int i = 0; i < 100; ++i) {
    events.push_back(FrameEvent(64 * i));
    events.push_back(LogEvent("after chunk " + std::to_string(i)));
  }
  ASSERT_TRUE(Append("jobs/a", events).ok());
  EXPECT_TRUE(absl::IsFailedPrecondition(Compact("jobs/a")));
  job.set_state(v1::Job::SUCCEEDED);
  ASSERT_TRUE(Update({.name = "jobs/a", .job = &job}).ok());
  EXPECT_EQ(Read("jobs/a")->job.oldest_sequence(), 1U);
  const std::int64_t before = Sizes()->front().bytes;
  ASSERT_TRUE(Compact("jobs/a").ok());
  ASSERT_TRUE(Compact("jobs/a").ok());
  EXPECT_TRUE(Read("jobs/a")->compacted);
  EXPECT_EQ(Read("jobs/a")->job.oldest_sequence(), 201U) << "after the last chunk";
  EXPECT_EQ(ReadEvents({.name = "jobs/a"})->oldest, 201U);
  // Takes several turns of the store's thread, and goes on after a restart.
  Open();
  while (
      !ReadEvents({.name = "jobs/a", .kinds = KindBit(v1::Event::kFrameChunk)})->events.empty()) {
  }
  EXPECT_LT(Sizes()->front().bytes, before);
  EXPECT_EQ(Sizes()->front().bytes, StoredBytes("jobs/a"));
  EXPECT_EQ(ReadEvents({.name = "jobs/a", .max_bytes = 1 << 20})->events.size(), 101U);
  EXPECT_EQ(Read("jobs/a")->job.last_sequence(), 201U) << "sequences stay";
}

TEST_P(StoreCallsTest, CheckpointIsReplacedAndGoesWithTheEnd) {
  Open();
  v1::Job job = MakeJob("jobs/a");
  ASSERT_TRUE(Create(job).ok());
  EXPECT_TRUE(Read("jobs/a", JobPart::kRun)->checkpoint.empty());
  const std::vector<v1::Event> events = {LogEvent("2"), LogEvent("3"), LogEvent("4")};
  for (const std::string state : {"first", "second"}) {
    const Checkpoint checkpoint{2, state};
    ASSERT_TRUE(Update({.name = "jobs/a", .events = events, .checkpoint = &checkpoint}).ok());
  }
  EXPECT_EQ(Read("jobs/a", JobPart::kRun)->checkpoint, "second");
  EXPECT_EQ(Read("jobs/a", JobPart::kRun)->checkpoint_sequence, 6U);
  EXPECT_TRUE(Read("jobs/a", JobPart::kSpec)->checkpoint.empty()) << "who does not run it";
  job.set_state(v1::Job::FAILED);
  job.mutable_end_time()->set_seconds(1);
  const Checkpoint last{0, "with the end"};
  ASSERT_TRUE(Update({.name = "jobs/a", .job = &job, .checkpoint = &last}).ok());
  EXPECT_TRUE(Read("jobs/a", JobPart::kRun)->checkpoint.empty());
}

TEST_P(StoreCallsTest, CallbacksRunInTheOrderOfTheCalls) {
  Open();
  ASSERT_TRUE(Create(MakeJob("jobs/a")).ok());
  std::vector<int> order;  // Of the store's thread until flushed.
  const std::string name = "jobs/a";
  for (int i = 0; i < 1000; ++i) {
    if (i % 3 == 0) {
      store_->Read(name, JobPart::kHeader, [&order, i](const auto&) { order.push_back(i); });
    } else {
      store_->Update({.name = name, .epoch = 0}, [&order, i](const auto&) { order.push_back(i); });
    }
  }
  Await<bool> flushed;
  store_->Flush([done = flushed.callback()] { done(true); });
  flushed.Get();
  ASSERT_EQ(order.size(), 1000U);
  EXPECT_TRUE(std::is_sorted(order.begin(), order.end()));
}

}  // namespace
}  // namespace contact
