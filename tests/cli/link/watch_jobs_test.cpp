#include "cli/link/watch_jobs.h"

#include <gmock/gmock.h>

#include "cli/link/fake_server.h"

namespace contact::cli {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;

const grpc::Status kLost(grpc::StatusCode::UNAVAILABLE, "draining", "details");

// Notes what it is told: `a RUNNING 1` with state and attempt, or `a gone`.
class Notes : public JobsObserver {
 public:
  void OnJob(const v1::Job& job) override {
    heard.push_back(
        fmt::format("{} {} {}", job.name(), v1::Job::State_Name(job.state()), job.attempt()));
  }
  void OnGone(const std::string& name) override { heard.push_back(name + " gone"); }
  void OnLost(const std::string&) override { ++lost; }
  void OnRegained() override { ++regained; }
  std::vector<std::string> heard;
  int lost = 0;
  int regained = 0;
};

void Send(FakeServer::JobsWriter& writer, const std::string& name, v1::Job::State state,
          int attempt = 1) {
  v1::WatchJobsResponse message;
  v1::Job& job = *message.add_jobs();
  job.set_name(name);
  job.set_state(state);
  job.set_attempt(attempt);
  writer.Write(message);
}

void EndSnapshot(FakeServer::JobsWriter& writer) {
  v1::WatchJobsResponse message;
  message.set_snapshot_complete(true);
  writer.Write(message);
}

void SendGone(FakeServer::JobsWriter& writer, const std::string& name) {
  v1::WatchJobsResponse message;
  message.add_gone(name);
  writer.Write(message);
}

class WatchJobsTest : public testing::Test {
 protected:
  WatchJobsTest() {
    options_.patience = {.first_pause = 1ms, .longest_pause = 4ms};
    options_.deadline = std::chrono::steady_clock::now() + 60s;
  }

  // Watches until `what` is heard.
  void FollowUntil(const std::string& what) {
    options_.stopped = [this, what] {
      return !notes_.heard.empty() && notes_.heard.back() == what;
    };
    Client client(server_.address(), 5s);
    EXPECT_EQ(WatchJobs(client, options_, notes_), WatchEnd::kStopped);
    server_.Settle();
  }

  FakeServer server_;
  JobsWatchOptions options_;
  Notes notes_;
};

TEST_F(WatchJobsTest, EachStateAndAttemptIsHeardOnce) {
  server_.OnWatchJobs([](const auto&, FakeServer::JobsWriter& writer) {
    for (int times = 0; times < 3; ++times) Send(writer, "a", v1::Job::QUEUED);
    EndSnapshot(writer);
    Send(writer, "a", v1::Job::RUNNING, 1);
    Send(writer, "a", v1::Job::RUNNING, 1);
    Send(writer, "a", v1::Job::RUNNING, 2);
    return kLost;
  });
  FollowUntil("a RUNNING 2");
  EXPECT_THAT(notes_.heard, ElementsAre("a QUEUED 1", "a RUNNING 1", "a RUNNING 2"));
}

TEST_F(WatchJobsTest, OnlyChangesAreHeardAfterAReconnection) {
  int streams = 0;
  server_.OnWatchJobs([&](const auto&, FakeServer::JobsWriter& writer) {
    Send(writer, "a", v1::Job::RUNNING);
    if (++streams == 1) Send(writer, "b", v1::Job::RUNNING);
    EndSnapshot(writer);
    if (streams == 3) Send(writer, "c", v1::Job::RUNNING);
    return kLost;
  });
  FollowUntil("c RUNNING 1");
  EXPECT_THAT(notes_.heard, ElementsAre("a RUNNING 1", "b RUNNING 1", "b gone", "c RUNNING 1"));
  EXPECT_GE(notes_.lost, 2);
  EXPECT_GE(notes_.regained, 2);
}

TEST_F(WatchJobsTest, AnIncompleteSnapshotForgetsNobody) {
  int streams = 0;
  server_.OnWatchJobs([&](const auto&, FakeServer::JobsWriter& writer) {
    if (++streams == 1) Send(writer, "a", v1::Job::RUNNING);
    if (streams == 4) Send(writer, "b", v1::Job::RUNNING);
    return kLost;
  });
  FollowUntil("b RUNNING 1");
  EXPECT_THAT(notes_.heard, ElementsAre("a RUNNING 1", "b RUNNING 1"));
}

TEST_F(WatchJobsTest, OnlyJobsThatWereHeardOfAreGone) {
  server_.OnWatchJobs([](const auto&, FakeServer::JobsWriter& writer) {
    EndSnapshot(writer);
    SendGone(writer, "stranger");
    Send(writer, "a", v1::Job::SUCCEEDED);
    SendGone(writer, "a");
    SendGone(writer, "a");
    return kLost;
  });
  FollowUntil("a gone");
  EXPECT_THAT(notes_.heard, ElementsAre("a SUCCEEDED 1", "a gone"));
}

TEST_F(WatchJobsTest, TheFilterIsAskedForAtEveryConnection) {
  (*options_.request.mutable_labels())["study"] = "x";
  std::vector<std::string> asked;
  server_.OnWatchJobs([&](const v1::WatchJobsRequest& request, FakeServer::JobsWriter& writer) {
    asked.push_back(request.labels().at("study"));
    if (asked.size() == 2) Send(writer, "a", v1::Job::RUNNING);
    EndSnapshot(writer);
    return kLost;
  });
  FollowUntil("a RUNNING 1");
  EXPECT_THAT(asked, testing::Each("x"));
  EXPECT_GE(asked.size(), 2U);
}

TEST_F(WatchJobsTest, EndsAtItsDeadline) {
  options_.deadline = std::chrono::steady_clock::now();
  server_.OnWatchJobs([](const auto&, auto&) { return kLost; });
  Client client(server_.address(), 5s);
  EXPECT_EQ(WatchJobs(client, options_, notes_), WatchEnd::kTimedOut);
  EXPECT_THAT(notes_.heard, IsEmpty());
}

TEST_F(WatchJobsTest, AFilterThatIsRefusedIsNotAskedForAgain) {
  int streams = 0;
  server_.OnWatchJobs([&](const auto&, auto&) {
    ++streams;
    return grpc::Status(grpc::StatusCode::INVALID_ARGUMENT, "no such state");
  });
  Client client(server_.address(), 5s);
  EXPECT_THROW(WatchJobs(client, options_, notes_), CallFailure);
  server_.Settle();
  EXPECT_EQ(streams, 1);
}

}  // namespace
}  // namespace contact::cli
