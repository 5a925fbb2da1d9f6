#include <gmock/gmock.h>

#include "cli/link/fake_server.h"
#include "cli/link/watch.h"

namespace contact::cli {
namespace {

using namespace std::chrono_literals;

// How often ReplayWhole replays if the first `holes` recordings have holes, and how it ends.
std::pair<int, std::string> Replays(int holes) {
  int replays = 0;
  try {
    ReplayWhole("x1", [&] { return replays++ >= holes; });
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::kRunFailed);
    return {replays, failure.what()};
  }
  return {replays, ""};
}

TEST(ReplayWhole, ARecordingWithHolesIsReplayedOnceMore) {
  EXPECT_EQ(Replays(0), std::pair(1, std::string()));
  EXPECT_EQ(Replays(1), std::pair(2, std::string()));
  for (const int holes : {2, 3, 10}) {
    EXPECT_EQ(Replays(holes),
              std::pair(2, std::string("parts of the trajectory of x1 do not come; try again")));
  }
}

TEST(WatchToEnd, TheTimeLimitOfTheSettingsEndsTheWatch) {
  FakeServer server;
  server.OnWatch([](const auto&, FakeServer::Writer& writer) {
    while (writer.Write({})) {  // Until the watcher has left.
    }
    return grpc::Status::OK;
  });
  Client client(server.address(), 5s);
  Settings settings;
  settings.timeout = "1ms";
  WatchOptions options;
  options.name = "jobs/x1";
  WatchObserver silence;
  try {
    WatchToEnd(client, options, settings, silence);
    ADD_FAILURE();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::kTimeout);
    EXPECT_STREQ(failure.what(), "time is up; jobs/x1 has not ended, or is long");
  }
}

TEST(WatchToEnd, SaysThatItWaitsForAJobThatHasNotEnded) {
  FakeServer server;
  server.OnWatch([](const auto&, FakeServer::Writer& writer) {
    v1::WatchJobResponse message;
    message.mutable_snapshot()->set_state(v1::Job::RUNNING);
    while (writer.Write(message)) {  // Until the watcher has left.
    }
    return grpc::Status::OK;
  });
  Client client(server.address(), 5s);
  Settings settings;
  settings.timeout = "1s";
  WatchOptions options;
  options.name = "jobs/x1";
  WatchObserver silence;
  testing::internal::CaptureStderr();
  EXPECT_THROW(WatchToEnd(client, options, settings, silence), Failure);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "jobs/x1 is RUNNING; waiting for its end\n");
}

TEST(WatchToEnd, AnEndedJobEndsTheWatch) {
  FakeServer server;
  server.OnWatch([](const auto&, FakeServer::Writer& writer) {
    v1::WatchJobResponse message;
    message.add_events()->mutable_state_changed()->set_state(v1::Job::FAILED);
    writer.Write(message);
    return grpc::Status::OK;
  });
  Client client(server.address(), 5s);
  WatchOptions options;
  options.name = "jobs/x1";
  WatchObserver silence;
  EXPECT_NO_THROW(WatchToEnd(client, options, Settings(), silence));
}

}  // namespace
}  // namespace contact::cli
