#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "test_server.h"

namespace contact {
namespace {

// A client's side of one watch of all jobs.
class JobsWatch {
 public:
  explicit JobsWatch(TestServer& server, v1::WatchJobsRequest request = {}) {
    context_.set_deadline(std::chrono::system_clock::now() + kPatience);
    reader_ = server.stub().WatchJobs(&context_, request);
  }
  ~JobsWatch() {
    context_.TryCancel();
    if (reader_) End();
  }
  bool Read(v1::WatchJobsResponse* message) { return reader_->Read(message); }
  grpc::Status End() {
    v1::WatchJobsResponse message;
    while (reader_->Read(&message)) {
    }
    return std::exchange(reader_, nullptr)->Finish();
  }

 private:
  grpc::ClientContext context_;
  std::unique_ptr<grpc::ClientReader<v1::WatchJobsResponse>> reader_;
};

TEST(JobsStreamTest, TellsWhatThereIsAndThenEveryJobToItsEnd) {
  TestServer server;
  const std::string before = server.Create(Collision());
  JobsWatch watch(server);
  v1::WatchJobsResponse message;
  ASSERT_TRUE(watch.Read(&message));
  ASSERT_EQ(message.jobs_size(), 1);
  EXPECT_EQ(message.jobs(0).name(), before);
  EXPECT_TRUE(message.snapshot_complete());
  const std::string after = server.Create(Collision());
  for (v1::Job::State state = v1::Job::QUEUED; state != v1::Job::SUCCEEDED;) {
    ASSERT_TRUE(watch.Read(&message));
    EXPECT_TRUE(message.snapshot_complete());
    for (const v1::Job& job : message.jobs()) {
      if (job.name() == after) state = job.state();
    }
  }
}

TEST(JobsStreamTest, IdleWatchGetsEmptyMessages) {
  TestServer server;
  v1::WatchJobsRequest request;
  request.mutable_bookmark_interval()->set_seconds(1);
  JobsWatch watch(server, request);
  v1::WatchJobsResponse message;
  ASSERT_TRUE(watch.Read(&message));
  ASSERT_TRUE(watch.Read(&message));
  EXPECT_EQ(message.jobs_size() + message.gone_size(), 0);
  EXPECT_TRUE(message.snapshot_complete());
}

TEST(JobsStreamTest, BadFilterIsRefused) {
  TestServer server;
  v1::WatchJobsRequest request;
  request.add_states(static_cast<v1::Job::State>(77));
  const grpc::Status status = JobsWatch(server, request).End();
  EXPECT_EQ(status.error_code(), grpc::INVALID_ARGUMENT);
  EXPECT_EQ(Reason(status), "FIELD_INVALID");
}

TEST(JobsStreamTest, CountsAsAWatcherAndEndsWithTheServer) {
  TestServer server({}, {.workers = 1, .max_watchers = 1});
  JobsWatch watch(server);
  v1::WatchJobsResponse message;
  ASSERT_TRUE(watch.Read(&message));
  EXPECT_EQ(Reason(JobsWatch(server).End()), "WATCHER_LIMIT");
  server.grpc().Drain();
  const grpc::Status status = watch.End();
  EXPECT_EQ(status.error_code(), grpc::UNAVAILABLE);
  EXPECT_EQ(Reason(status), "SERVER_DRAINING");
}

}  // namespace
}  // namespace contact
