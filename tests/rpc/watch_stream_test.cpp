#include <gmock/gmock.h>
#include <grpcpp/generic/generic_stub.h>

#include <atomic>
#include <functional>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "rpc/stream/watch_source.h"
#include "test_server.h"
#include "testing/fake_run.h"

namespace contact {
namespace {

using std::chrono::milliseconds;

// A client's side of one watch.
class Watch {
 public:
  Watch(v1::JobService::Stub& stub, const std::string& name, int bookmark_interval_s = 0,
        std::uint64_t after = 0)
      : Watch(stub, Request(name, bookmark_interval_s, after)) {}
  Watch(v1::JobService::Stub& stub, const v1::WatchJobRequest& request) {
    context_.set_deadline(std::chrono::system_clock::now() + kPatience);
    reader_ = stub.WatchJob(&context_, request);
  }
  ~Watch() {
    if (reader_) End();
  }

  static v1::WatchJobRequest Request(const std::string& name, int bookmark_interval_s = 0,
                                     std::uint64_t after = 0) {
    v1::WatchJobRequest request;
    request.set_name(name);
    request.set_after_sequence(after);
    if (bookmark_interval_s != 0) {
      request.mutable_bookmark_interval()->set_seconds(bookmark_interval_s);
    }
    return request;
  }

  bool Read(v1::WatchJobResponse* message) { return reader_->Read(message); }
  void Cancel() { context_.TryCancel(); }

  // Reads to the end.
  grpc::Status End() {
    v1::WatchJobResponse message;
    while (reader_->Read(&message)) {
      for (v1::Event& event : *message.mutable_events()) events_.push_back(std::move(event));
    }
    return std::exchange(reader_, nullptr)->Finish();
  }

  const std::vector<v1::Event>& events() const { return events_; }

 private:
  grpc::ClientContext context_;
  std::unique_ptr<grpc::ClientReader<v1::WatchJobResponse>> reader_;
  std::vector<v1::Event> events_;
};

// Fills all workers, so that what is created next stays queued.
void Occupy(TestServer& server, int workers) {
  for (int i = 0; i < workers; ++i) {
    const std::string name = server.Create(Endless());
    Watch watch(server.stub(), name);
    v1::WatchJobResponse message;
    bool started = false;
    while (!started && watch.Read(&message)) {
      for (const v1::Event& event : message.events()) started |= event.has_attempt_started();
    }
    watch.Cancel();
  }
}

TEST(WatchStreamTest, FirstMessageIsTheSnapshotAndComesAtOnce) {
  TestServer server({}, {.workers = 1});
  Occupy(server, 1);
  const std::string name = server.Create(Collision());
  Watch watch(server.stub(), name);
  v1::WatchJobResponse message;
  ASSERT_TRUE(watch.Read(&message));
  EXPECT_EQ(message.snapshot().name(), name);
  EXPECT_EQ(message.snapshot().state(), v1::Job::QUEUED);
  watch.Cancel();
}

TEST(WatchStreamTest, EndsWithOkAfterTheFinalState) {
  TestServer server;
  Watch watch(server.stub(), server.Create(Collision()));
  EXPECT_TRUE(watch.End().ok());
  ASSERT_FALSE(watch.events().empty());
  EXPECT_EQ(watch.events().back().state_changed().state(), v1::Job::SUCCEEDED);
  std::uint64_t sequence = 0;
  for (const v1::Event& event : watch.events()) {
    if (event.has_progress() || event.has_bookmark()) continue;
    EXPECT_EQ(event.sequence(), ++sequence);
  }
}

TEST(WatchStreamTest, GoesOnAfterAnySequence) {
  TestServer server;
  const std::string name = server.Create(Collision());
  Watch all(server.stub(), name);
  EXPECT_TRUE(all.End().ok());
  const std::uint64_t last = all.events().back().sequence();
  Watch rest(server.stub(), name, 0, last - 1);
  EXPECT_TRUE(rest.End().ok());
  ASSERT_EQ(rest.events().size(), 1U);
  EXPECT_EQ(rest.events().front().sequence(), last);
}

TEST(WatchStreamTest, UnknownJobIsNotFound) {
  TestServer server;
  const grpc::Status status = Watch(server.stub(), "jobs/none").End();
  EXPECT_EQ(status.error_code(), grpc::NOT_FOUND);
  EXPECT_EQ(Reason(status), "JOB_NOT_FOUND");
  EXPECT_TRUE(Eventually([&] { return server.grpc().watchers() == 0; }));
}

TEST(WatchStreamTest, IdleWatchGetsBookmarksToResumeFrom) {
  TestServer server({}, {.workers = 1});
  Occupy(server, 1);
  Watch watch(server.stub(), server.Create(Collision()), 1);
  v1::WatchJobResponse message;
  std::uint64_t last = 0;
  do {
    ASSERT_TRUE(watch.Read(&message));
    for (const v1::Event& event : message.events()) {
      if (!event.has_bookmark()) last = event.sequence();
    }
  } while (message.events().empty() || !message.events(0).has_bookmark());
  EXPECT_EQ(message.events(0).sequence(), last);
  watch.Cancel();
}

TEST(WatchStreamTest, BookmarkIntervalOutOfRangeIsRefused) {
  TestServer server;
  const std::string name = server.Create(Collision());
  for (const int interval : {-1, 3601}) {
    const grpc::Status status = Watch(server.stub(), name, interval).End();
    EXPECT_EQ(status.error_code(), grpc::INVALID_ARGUMENT) << interval;
    EXPECT_EQ(Reason(status), "FIELD_INVALID");
  }
}

TEST(WatchStreamTest, StalledWatcherIsDroppedAndOthersAreNot) {
  TestServer server({.write_stall = milliseconds(1500)});
  const std::string name = server.Create(Endless());
  const auto stalled_stub = v1::JobService::NewStub(server.Connect());
  Watch stalled(*stalled_stub, name);
  v1::WatchJobResponse message;
  ASSERT_TRUE(stalled.Read(&message));

  Watch lively(server.stub(), name);
  ASSERT_TRUE(lively.Read(&message));
  while (server.grpc().watchers() == 2) ASSERT_TRUE(lively.Read(&message));
  EXPECT_EQ(stalled.End().error_code(), grpc::CANCELLED);
  EXPECT_TRUE(lively.Read(&message));
  lively.Cancel();
}

TEST(WatchStreamTest, DrainEndsWatchesAndThoseToCome) {
  TestServer server({}, {.workers = 1});
  Occupy(server, 1);
  const std::string name = server.Create(Collision());
  Watch before(server.stub(), name);
  v1::WatchJobResponse message;
  ASSERT_TRUE(before.Read(&message));
  server.grpc().Drain();
  Watch after(server.stub(), name);
  for (Watch* watch : {&before, &after}) {
    const grpc::Status status = watch->End();
    EXPECT_EQ(status.error_code(), grpc::UNAVAILABLE);
    EXPECT_EQ(Reason(status), "SERVER_DRAINING");
  }
}

TEST(WatchStreamTest, CancelAtAnyMomentLeavesNothing) {
  TestServer server;
  const std::string name = server.Create(Endless());
  for (int i = 0; i < 200; ++i) {
    Watch watch(server.stub(), name);
    v1::WatchJobResponse message;
    for (int reads = 0; reads < i % 4; ++reads) watch.Read(&message);
    watch.Cancel();
  }
  EXPECT_TRUE(Eventually([&] { return server.grpc().watchers() == 0; }));
}

// A run that waits, then brings so many frame chunks of so many rows, a remark after each.
JobOptions Filming(FakeRun& run) { return {.workers = 1, .run = std::ref(run)}; }
FakeRun::Script Frames(int chunks, std::int64_t rows) {
  return [chunks, rows](const Scenario&, Observer& observer, const std::stop_token&) {
    constexpr int kColumns = 9;
    for (std::int64_t i = 0; i < chunks; ++i) {
      std::vector<double> values(static_cast<std::size_t>(rows * kColumns), 0.5);
      observer.OnSamples({i * rows, kColumns, std::move(values)});
      observer.OnWarning(std::to_string(i));
    }
    return Outcome{};
  };
}

// Whether the events and the gaps between them make up the whole log, and what it has of remarks.
void ExpectWhole(const std::vector<v1::Event>& events, int remarks, std::uint64_t* left_out) {
  std::uint64_t sequence = 0;
  for (const v1::Event& event : events) {
    if (event.has_progress() || event.has_bookmark()) continue;
    EXPECT_EQ(event.has_gap() ? event.gap().first_sequence() : event.sequence(), sequence + 1);
    if (event.has_gap()) {
      *left_out += event.gap().dropped_count();
      EXPECT_EQ(event.gap().last_sequence() - sequence, event.gap().dropped_count());
    }
    if (event.has_log_entry()) --remarks;
    sequence = event.sequence();
  }
  EXPECT_EQ(remarks, 0);
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events.back().state_changed().state(), v1::Job::SUCCEEDED);
}

TEST(WatchStreamTest, FrameIntervalLeavesOutFramesAndNamesThem) {
  FakeRun run(Frames(50, 10));
  TestServer server({}, Filming(run));
  const std::string name = server.Create(Collision());
  v1::WatchJobRequest request = Watch::Request(name);
  request.mutable_delivery()->mutable_min_frame_interval()->set_seconds(3600);
  Watch watch(server.stub(), request);
  run.Allow();
  EXPECT_TRUE(watch.End().ok());
  std::uint64_t left_out = 0;
  ExpectWhole(watch.events(), 50, &left_out);
  EXPECT_GE(left_out, 48U);  // All but the first, and the last if it still was the newest.
  Watch replay(server.stub(), name);
  EXPECT_TRUE(replay.End().ok());
  std::uint64_t none = 0;
  ExpectWhole(replay.events(), 50, &none);
  EXPECT_EQ(none, 0U);
}

TEST(WatchStreamTest, IdleWatchGetsTheNewestFrameWhenItIsTime) {
  FakeRun run([](const Scenario&, Observer& observer, const std::stop_token& stop) {
    for (std::int64_t i = 0; i < 5; ++i) observer.OnSamples({i, 9, std::vector<double>(9)});
    while (!stop.stop_requested()) observer.OnProgress({});
    return Ending(Outcome::End::kStopped);
  });
  TestServer server({}, Filming(run));
  v1::WatchJobRequest request = Watch::Request(server.Create(Collision()));
  request.add_kinds("frame_chunk");
  request.mutable_delivery()->mutable_min_frame_interval()->set_nanos(100'000'000);
  Watch watch(server.stub(), request);
  run.Allow();
  v1::WatchJobResponse message;
  std::int64_t newest = -1;
  while (newest < 4 && watch.Read(&message)) {
    for (const v1::Event& event : message.events()) {
      if (event.has_frame_chunk()) newest = event.frame_chunk().first_sample();
    }
  }
  EXPECT_EQ(newest, 4);
  watch.Cancel();
}

// A watch that is up to date, and then takes nothing until the job has ended 11 MB later.
grpc::Status WatchLate(v1::DeliveryOptions::OverflowPolicy overflow,
                       std::vector<v1::Event>* events) {
  FakeRun run(Frames(16, 10'000));
  TestServer server({}, Filming(run));
  const std::string name = server.Create(Collision());
  run.AwaitStarted(1);
  const auto stub = v1::JobService::NewStub(server.Connect());
  v1::WatchJobRequest request = Watch::Request(name, 1);
  request.mutable_delivery()->set_overflow(overflow);
  Watch watch(*stub, request);
  v1::WatchJobResponse message;
  do {  // A bookmark says that all has been read.
    EXPECT_TRUE(watch.Read(&message));
    events->insert(events->end(), message.events().begin(), message.events().end());
  } while (message.events().empty() || !message.events().rbegin()->has_bookmark());
  run.Allow();
  EXPECT_TRUE(Watch(server.stub(), name).End().ok());
  grpc::Status status = watch.End();
  events->insert(events->end(), watch.events().begin(), watch.events().end());
  return status;
}

TEST(WatchStreamTest, SlowWatcherIsSparedFramesAndNothingElse) {
  std::vector<v1::Event> events;
  EXPECT_TRUE(WatchLate(v1::DeliveryOptions::CONFLATE, &events).ok());
  std::uint64_t left_out = 0;
  ExpectWhole(events, 16, &left_out);
  EXPECT_GT(left_out, 0U);
}

TEST(WatchStreamTest, SlowWatcherIsDisconnectedIfItWants) {
  std::vector<v1::Event> events;
  const grpc::Status status = WatchLate(v1::DeliveryOptions::DISCONNECT, &events);
  EXPECT_EQ(status.error_code(), grpc::RESOURCE_EXHAUSTED);
  EXPECT_EQ(Reason(status), "SLOW_WATCHER");
}

TEST(WatchStreamTest, SlowWatcherGetsEverythingIfItWants) {
  std::vector<v1::Event> events;
  EXPECT_TRUE(WatchLate(v1::DeliveryOptions::LAG, &events).ok());
  std::uint64_t left_out = 0;
  ExpectWhole(events, 16, &left_out);
  EXPECT_EQ(left_out, 0U);
}

TEST(WatchStreamTest, LiveOnlyBeginsAfterTheSnapshot) {
  FakeRun run(Frames(1, 1));
  TestServer server({}, Filming(run));
  const std::string name = server.Create(Collision());
  run.AwaitStarted(1);
  v1::WatchJobRequest request = Watch::Request(name);
  request.set_live_only(true);
  Watch watch(server.stub(), request);
  v1::WatchJobResponse message;
  ASSERT_TRUE(watch.Read(&message));
  EXPECT_EQ(message.snapshot().last_sequence(), 3U);
  run.Allow();
  EXPECT_TRUE(watch.End().ok());
  EXPECT_EQ(watch.events().front().sequence(), 4U);

  Watch late(server.stub(), request);
  EXPECT_TRUE(late.End().ok());
  EXPECT_TRUE(late.events().empty());
}

TEST(WatchStreamTest, ProgressDoesNotKeepBookmarksBack) {
  FakeRun run([](const Scenario&, Observer& observer, const std::stop_token& stop) {
    while (!stop.stop_requested()) observer.OnProgress({});
    return Ending(Outcome::End::kStopped);
  });
  TestServer server({}, Filming(run));
  v1::WatchJobRequest request = Watch::Request(server.Create(Collision()), 1);
  request.add_kinds("progress");
  Watch watch(server.stub(), request);
  run.Allow();
  v1::WatchJobResponse message;
  std::uint64_t told = 0;
  while (told < 3 && watch.Read(&message)) {
    for (const v1::Event& event : message.events()) {
      if (event.has_bookmark()) told = event.sequence();
    }
  }
  EXPECT_EQ(told, 3U);
  watch.Cancel();
}

TEST(WatchStreamTest, RequestThatIsNoneIsRefused) {
  TestServer server;
  grpc::GenericStub stub(server.Connect());
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + kPatience);
  grpc::CompletionQueue queue;
  const grpc::Slice garbage("\xff\xff");
  const auto call = stub.PrepareUnaryCall(&context, "/contact.v1.JobService/WatchJob",
                                          grpc::ByteBuffer(&garbage, 1), &queue);
  grpc::ByteBuffer answer;
  grpc::Status status;
  call->StartCall();
  call->Finish(&answer, &status, nullptr);
  void* tag = nullptr;
  bool ok = false;
  ASSERT_TRUE(queue.Next(&tag, &ok));
  EXPECT_EQ(status.error_code(), grpc::INVALID_ARGUMENT);
  EXPECT_EQ(Reason(status), "FIELD_INVALID");
}

// What the clients of the storm share.
struct Storm {
  TestServer& server;
  const std::string job;
  std::atomic<bool> over = false;
  std::atomic<int> events = 0;
};

// Reads some messages; true while the stream goes on. Sequences may only grow.
bool ReadSome(Watch& watch, std::uint_fast32_t messages, Storm& storm, std::uint64_t* last) {
  v1::WatchJobResponse message;
  for (; messages > 0; --messages) {
    if (!watch.Read(&message)) return false;
    for (const v1::Event& event : message.events()) {
      if (event.has_progress() || event.has_bookmark() || event.has_gap()) continue;
      EXPECT_GT(event.sequence(), *last);
      *last = event.sequence();
      ++storm.events;
    }
  }
  return true;
}

// One client that watches again and again, and reads, stalls and leaves as the dice say.
void WatchAtRandom(Storm& storm, unsigned seed) {
  std::minstd_rand random(seed);
  const auto stub = v1::JobService::NewStub(storm.server.Connect());
  std::uint64_t last = 0;
  while (!storm.over) {
    Watch watch(*stub, storm.job, 0, last);
    while (ReadSome(watch, random() % 10, storm, &last) && random() % 4 != 0) {
      std::this_thread::sleep_for(milliseconds(random() % 60));  // The stall.
    }
    watch.Cancel();
  }
}

TEST(WatchStreamTest, StormOfWatchersLeavesNothingAndShutsDownAtOnce) {
  TestServer server({.write_stall = milliseconds(20)});
  Storm storm{server, server.Create(Endless())};
  std::vector<std::jthread> clients;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    clients.emplace_back([&storm, seed] { WatchAtRandom(storm, seed); });
  }
  EXPECT_TRUE(Eventually([&] { return storm.events > 20'000; })) << storm.events;

  server.grpc().Drain();
  storm.over = true;
  const auto start = std::chrono::steady_clock::now();
  server.grpc().Shutdown(std::chrono::seconds(20));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
  EXPECT_EQ(server.grpc().watchers(), 0U);
}

}  // namespace
}  // namespace contact
