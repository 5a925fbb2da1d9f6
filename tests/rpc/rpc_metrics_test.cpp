#include "rpc/metrics/rpc_metrics.h"

#include <gmock/gmock.h>
#include <prometheus/text_serializer.h>

#include <string>

#include "rpc/metrics/metrics_page.h"
#include "test_server.h"

namespace contact {
namespace {

using testing::HasSubstr;

const std::string kService = "/contact.v1.JobService/";

TEST(RpcMetricsTest, CallsAreCountedByMethodAndCode) {
  TestServer server;
  v1::WatchJobRequest request;
  request.set_name(server.Create(Collision()));
  std::int64_t bytes = 0;
  {
    grpc::ClientContext context;
    const auto reader = server.stub().WatchJob(&context, request);
    for (v1::WatchJobResponse response; reader->Read(&response);) {
      bytes += static_cast<std::int64_t>(response.ByteSizeLong());
    }
    EXPECT_TRUE(reader->Finish().ok());
  }
  v1::Job job;
  for (int i = 0; i < 3; ++i) {
    grpc::ClientContext context;
    v1::GetJobRequest none;
    none.set_name("jobs/none");
    EXPECT_FALSE(server.stub().GetJob(&context, none, &job).ok());
  }
  const auto metrics = server.grpc().metrics();
  const auto ended = [&](const std::string& method, int code) {
    return metrics->methods()[kService + method].ended[code];
  };
  // A call is over for its client a moment before it is for the server.
  EXPECT_TRUE(Eventually([&] { return ended("GetJob", grpc::StatusCode::NOT_FOUND) == 3; }));
  EXPECT_TRUE(Eventually([&] { return ended("WatchJob", grpc::StatusCode::OK) == 1; }));
  EXPECT_TRUE(Eventually([&] { return ended("CreateJob", grpc::StatusCode::OK) == 1; }));
  const auto watch = metrics->methods()[kService + "WatchJob"];
  EXPECT_EQ(watch.streamed_bytes, bytes);
  EXPECT_EQ(watch.open, 0);
  EXPECT_GT(watch.seconds->Get().sum, 0);
}

TEST(RpcMetricsTest, WatcherThatLeavesIsNoLongerOpen) {
  TestServer server;
  v1::WatchJobRequest request;
  request.set_name(server.Create(Endless()));
  grpc::ClientContext context;
  const auto reader = server.stub().WatchJob(&context, request);
  v1::WatchJobResponse response;
  EXPECT_TRUE(reader->Read(&response));
  const auto open = [&] { return server.grpc().metrics()->methods()[kService + "WatchJob"].open; };
  EXPECT_EQ(open(), 1);
  context.TryCancel();
  EXPECT_TRUE(Eventually([&] { return open() == 0; }));
}

TEST(MetricsPageTest, TellsWhatWasCounted) {
  const auto jobs = std::make_shared<JobMetrics>();
  const auto store = std::make_shared<StoreMetrics>();
  const auto rpc = std::make_shared<RpcMetrics>();
  const auto streams = std::make_shared<StreamMetrics>();
  v1::Job job;
  job.set_state(v1::Job::FAILED);
  job.set_state_reason("NUMERIC");
  job.mutable_start_time()->set_seconds(10);
  job.mutable_end_time()->set_seconds(12);
  job.add_cycles()->set_iterations(3);
  job.mutable_summary()->set_steps(284);
  job.mutable_summary()->set_growths(5);
  jobs->Moved(v1::Job::RUNNING, job);
  store->commit_operations.Count(256);
  rpc->Refused("RATE_LIMITED");
  rpc->Refused("QUOTA_EXCEEDED", "STREAMS");
  streams->slow = 2;
  streams->conflated = 7;
  streams->reaction_seconds.Count(2e-6);
  const MetricsPage page(
      {[] { return MetricsSources::Now{.queued_jobs = 4}; }, jobs, store, rpc, streams});
  const std::string text = prometheus::TextSerializer().Serialize(page.Collect());
  for (const std::string line : {
           "contactd_jobs{state=\"QUEUED\"} 4\n",
           "contactd_job_moves_total{state=\"FAILED\",reason=\"NUMERIC\"} 1\n",
           "contactd_job_run_seconds_sum 2\n",
           "contactd_job_run_seconds_bucket{le=\"1\"} 0\n",
           "contactd_job_run_seconds_bucket{le=\"2.5\"} 1\n",
           "contactd_job_run_seconds_bucket{le=\"+Inf\"} 1\n",
           "contactd_cycle_iterations_count 1\n",
           "contactd_steps_total 284\n",
           "contactd_group_growths_total 5\n",
           "contactd_store_commit_operations_bucket{le=\"250\"} 0\n",
           "contactd_store_commit_operations_sum 256\n",
           "contactd_rpc_refused_total{reason=\"RATE_LIMITED\"} 1\n",
           "contactd_rpc_refused_total{reason=\"QUOTA_EXCEEDED\"} 1\n",
           "contactd_quota_refused_total{resource=\"STREAMS\"} 1\n",
           "contactd_streams_slow 2\n",
           "contactd_streams_dropped_total 0\n",
           "contactd_events_conflated_total 7\n",
           "contactd_stream_reaction_seconds_bucket{le=\"1e-06\"} 0\n",
           "contactd_stream_reaction_seconds_bucket{le=\"2.5e-06\"} 1\n",
       }) {
    EXPECT_THAT(text, HasSubstr(line));
  }
}

}  // namespace
}  // namespace contact
