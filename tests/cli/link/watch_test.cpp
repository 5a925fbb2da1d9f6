#include "cli/link/watch.h"

#include <gmock/gmock.h>

#include <numeric>

#include "cli/link/fake_server.h"

namespace contact::cli {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;

constexpr std::uint64_t kLast = 40;  // Sequence of the final event.

class Recorder : public WatchObserver {
 public:
  void OnEvent(const v1::Event& event) override { sequences.push_back(event.sequence()); }
  void OnLost(const std::string& why) override { told.push_back(why); }
  void OnRegained() override { told.emplace_back("regained"); }
  std::vector<std::uint64_t> sequences;
  std::vector<std::string> told;
};

v1::Event EventAt(std::uint64_t sequence) {
  v1::Event event;
  event.set_sequence(sequence);
  if (sequence == kLast) {
    event.mutable_state_changed()->set_state(v1::Job::SUCCEEDED);
  } else {
    event.mutable_cycle()->set_number(static_cast<int>(sequence));
  }
  return event;
}

void Send(FakeServer::Writer& writer, v1::Event event) {
  v1::WatchJobResponse message;
  *message.add_events() = std::move(event);
  writer.Write(message);
}

void SendSnapshot(FakeServer::Writer& writer, v1::Job::State state, std::uint64_t last) {
  v1::WatchJobResponse message;
  message.mutable_snapshot()->set_state(state);
  message.mutable_snapshot()->set_last_sequence(last);
  writer.Write(message);
}

class WatchTest : public testing::Test {
 protected:
  WatchTest() {
    options_.name = "jobs/x";
    options_.patience.first_pause = 1ms;
    options_.patience.longest_pause = 4ms;
    options_.deadline = std::chrono::steady_clock::now() + 60s;
  }
  WatchEnd Follow() {
    struct Settler {
      ~Settler() { server.Settle(); }
      FakeServer& server;
    } settler{server_};
    Client client(server_.address(), 5s);
    return Watch(client, options_, recorder_);
  }

  FakeServer server_;
  WatchOptions options_;
  Recorder recorder_;
};

std::vector<std::uint64_t> All() {
  std::vector<std::uint64_t> all(kLast);
  std::iota(all.begin(), all.end(), 1);
  return all;
}

TEST_F(WatchTest, HearsEachEventOnceAcrossTwentyCuts) {
  const std::vector<grpc::Status> ends = {
      {grpc::StatusCode::UNAVAILABLE, "draining", "details"},
      {grpc::StatusCode::INTERNAL, "reset"},
      {grpc::StatusCode::CANCELLED, "stalled"},
      {grpc::StatusCode::UNKNOWN, "?"},
      grpc::Status::OK,
  };
  int streams = 0;
  server_.OnWatch([&](const v1::WatchJobRequest& request, FakeServer::Writer& writer) {
    SendSnapshot(writer, v1::Job::RUNNING, kLast);
    const std::uint64_t from = request.after_sequence() + 1;
    for (std::uint64_t s = from; s < from + 2; ++s) Send(writer, EventAt(s));
    if (from + 1 == kLast) return grpc::Status::OK;
    return ends[static_cast<std::size_t>(streams++) % ends.size()];
  });
  EXPECT_EQ(Follow(), WatchEnd::kFinished);
  EXPECT_EQ(recorder_.sequences, All());
  EXPECT_EQ(recorder_.told.size(), 2 * 19U);
}

TEST_F(WatchTest, RepeatedEventsAreHeardOnce) {
  server_.OnWatch([](const auto&, FakeServer::Writer& writer) {
    for (std::uint64_t s = 1; s <= kLast; ++s) {
      Send(writer, EventAt(s > 3 ? s - 3 : s));
      Send(writer, EventAt(s));
    }
    return grpc::Status::OK;
  });
  EXPECT_EQ(Follow(), WatchEnd::kFinished);
  EXPECT_EQ(recorder_.sequences, All());
}

TEST_F(WatchTest, BookmarksMoveThePlaceToResumeFrom) {
  std::vector<std::uint64_t> asked;
  server_.OnWatch([&](const v1::WatchJobRequest& request, FakeServer::Writer& writer) {
    asked.push_back(request.after_sequence());
    if (asked.size() == 2) {
      Send(writer, EventAt(kLast));
      return grpc::Status::OK;
    }
    v1::Event bookmark;
    bookmark.set_sequence(7);
    bookmark.mutable_bookmark();
    Send(writer, bookmark);
    v1::Event progress;
    progress.mutable_progress();
    Send(writer, progress);
    return grpc::Status(grpc::StatusCode::UNAVAILABLE, "");
  });
  EXPECT_EQ(Follow(), WatchEnd::kFinished);
  EXPECT_THAT(asked, ElementsAre(0, 7));
}

TEST_F(WatchTest, EndOfTheStreamIsNotTheEndOfTheJob) {
  int streams = 0;
  server_.OnWatch([&](const auto&, FakeServer::Writer& writer) {
    SendSnapshot(writer, v1::Job::RUNNING, 0);
    if (++streams == 3) Send(writer, EventAt(kLast));
    return grpc::Status::OK;
  });
  EXPECT_EQ(Follow(), WatchEnd::kFinished);
  EXPECT_EQ(streams, 3);
}

TEST_F(WatchTest, NothingIsLeftToHearAfterTheLastEvent) {
  options_.after_sequence = kLast;
  server_.OnWatch([&](const auto&, FakeServer::Writer& writer) {
    SendSnapshot(writer, v1::Job::SUCCEEDED, kLast);
    return grpc::Status::OK;
  });
  EXPECT_EQ(Follow(), WatchEnd::kFinished);
  EXPECT_THAT(recorder_.sequences, testing::IsEmpty());
}

TEST_F(WatchTest, LiveOnlyIsAskedForOnceAndThenResumed) {
  options_.live_only = true;
  std::vector<std::pair<bool, std::uint64_t>> asked;
  server_.OnWatch([&](const v1::WatchJobRequest& request, FakeServer::Writer& writer) {
    asked.emplace_back(request.live_only(), request.after_sequence());
    SendSnapshot(writer, v1::Job::RUNNING, 7);
    if (asked.size() == 2) Send(writer, EventAt(kLast));
    return grpc::Status(grpc::StatusCode::UNAVAILABLE, "");
  });
  EXPECT_EQ(Follow(), WatchEnd::kFinished);
  EXPECT_THAT(asked, ElementsAre(std::pair(true, 0U), std::pair(false, 7U)));
}

TEST_F(WatchTest, ConnectionThatStaysAwayIsToldOnceAndOnceThatItIsBack) {
  int streams = 0;
  server_.OnWatch([&](const auto&, FakeServer::Writer& writer) {
    if (++streams == 1) SendSnapshot(writer, v1::Job::RUNNING, 0);
    if (streams == 5) Send(writer, EventAt(kLast));
    return grpc::Status(grpc::StatusCode::UNAVAILABLE, "Connection refused by host", "details");
  });
  EXPECT_EQ(Follow(), WatchEnd::kFinished);
  EXPECT_THAT(recorder_.told, ElementsAre("connection refused", "regained"));
}

TEST(Reconnection, PausesGrowUntilAMessageComes) {
  Reconnection reconnection("host:1", {.first_pause = 8ms, .longest_pause = 20ms});
  const grpc::Status lost(grpc::StatusCode::UNAVAILABLE, "", "details");
  const auto expect_pause = [&](std::chrono::milliseconds most) {
    const auto pause = reconnection.Lost(lost);
    EXPECT_GE(pause, most / 2);
    EXPECT_LE(pause, most);
    EXPECT_TRUE(reconnection.lost());
  };
  EXPECT_FALSE(reconnection.Heard());
  for (const auto most : {8ms, 16ms, 20ms, 20ms}) expect_pause(most);
  EXPECT_TRUE(reconnection.Heard());
  EXPECT_FALSE(reconnection.lost());
  expect_pause(8ms);
}

TEST_F(WatchTest, NeverAsksAgainWhereTheAnswerWillBeTheSame) {
  using S = grpc::StatusCode;
  for (const S code : {S::NOT_FOUND, S::OUT_OF_RANGE, S::INVALID_ARGUMENT, S::UNIMPLEMENTED,
                       S::RESOURCE_EXHAUSTED}) {
    int streams = 0;
    server_.OnWatch([&](const auto&, auto&) {
      ++streams;
      return grpc::Status(code, "");
    });
    EXPECT_THROW(Follow(), CallFailure) << code;
    EXPECT_EQ(streams, 1) << code;
  }
}

TEST_F(WatchTest, WatcherLimitIsWaitedForOnceTheWatchHasBegun) {
  int streams = 0;
  server_.OnWatch([&](const auto&, FakeServer::Writer& writer) {
    ++streams;
    if (streams == 2) return grpc::Status(grpc::StatusCode::RESOURCE_EXHAUSTED, "");
    SendSnapshot(writer, v1::Job::RUNNING, 0);
    if (streams == 3) Send(writer, EventAt(kLast));
    return grpc::Status(grpc::StatusCode::UNAVAILABLE, "");
  });
  EXPECT_EQ(Follow(), WatchEnd::kFinished);
}

TEST_F(WatchTest, GivesUpWhenNobodyAnswersForTooLong) {
  options_.patience.give_up_after = 20ms;
  int streams = 0;
  server_.OnWatch([&](const auto&, FakeServer::Writer& writer) {
    if (++streams == 1) SendSnapshot(writer, v1::Job::RUNNING, 0);
    return grpc::Status(grpc::StatusCode::UNAVAILABLE, "");
  });
  EXPECT_THROW(Follow(), CallFailure);
  EXPECT_GT(streams, 2);
}

TEST_F(WatchTest, StopsWhenAsked) {
  options_.stopped = [this] { return !recorder_.sequences.empty(); };
  server_.OnWatch([](const auto&, FakeServer::Writer& writer) {
    Send(writer, EventAt(1));
    while (writer.Write({})) {  // Until the watcher has left.
    }
    return grpc::Status::OK;
  });
  EXPECT_EQ(Follow(), WatchEnd::kStopped);
}

TEST_F(WatchTest, EndsAtItsDeadline) {
  options_.deadline = std::chrono::steady_clock::now() + 50ms;
  server_.OnWatch([](const auto&, FakeServer::Writer& writer) {
    while (writer.Write({})) {
    }
    return grpc::Status::OK;
  });
  EXPECT_EQ(Follow(), WatchEnd::kTimedOut);
}

TEST(Watch, ServerThatIsNotThereIsToldAtOnce) {
  Client client("127.0.0.1:1", 5s);
  Recorder recorder;
  WatchOptions options;
  options.name = "jobs/x";
  try {
    Watch(client, options, recorder);
    FAIL();
  } catch (const CallFailure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::kUnreachable);
  }
}

}  // namespace
}  // namespace contact::cli
