#include "cli/link/printable_answers.h"

#include <gmock/gmock.h>

#include "cli/link/client.h"
#include "cli/link/fake_server.h"
#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"

namespace contact::cli {
namespace {

using namespace std::chrono_literals;

// Sets a window's title, paints, turns the direction, and is a C1 control character.
constexpr char kHostile[] = "\x1b]0;pwn\x07\x1b[31m\xe2\x80\xae\xc2\x9b";
constexpr char kHarmless[] = "?]0;pwn??[31m??";

v1::Job HostileJob() {
  v1::Job job;
  job.set_name(kHostile);
  (*job.mutable_labels())["a"] = kHostile;
  job.mutable_scenario()->add_bodies()->set_name(kHostile);
  job.mutable_scenario()->add_contacts()->add_between(kHostile);
  return job;
}

TEST(PrintableAnswers, EachTextOfAnAnswerIsPrintable) {
  FakeServer server;
  server.OnCreate([](const auto&, v1::Job* job) {
    *job = HostileJob();
    return grpc::Status::OK;
  });
  Client client(server.address(), 5s);
  const v1::Job job = client.Call(&Client::Stub::CreateJob, v1::CreateJobRequest());
  EXPECT_EQ(job.name(), kHarmless);
  EXPECT_EQ(job.labels().at("a"), kHarmless);
  EXPECT_EQ(job.scenario().bodies(0).name(), kHarmless);
  EXPECT_EQ(job.scenario().contacts(0).between(0), kHarmless);
}

TEST(PrintableAnswers, EachMessageOfAStreamIsPrintable) {
  FakeServer server;
  server.OnWatchJobs([](const auto&, FakeServer::JobsWriter& writer) {
    v1::WatchJobsResponse response;
    *response.add_jobs() = HostileJob();
    writer.Write(response);
    return grpc::Status::OK;
  });
  Client client(server.address(), 5s);
  grpc::ClientContext context;
  const auto stream = client.stub().WatchJobs(&context, {});
  v1::WatchJobsResponse response;
  ASSERT_TRUE(stream->Read(&response));
  EXPECT_EQ(response.jobs(0).name(), kHarmless);
}

TEST(PrintableAnswers, AnErrorIsPrintableWithItsDetails) {
  google::rpc::BadRequest request;
  request.add_field_violations()->set_description(kHostile);
  google::rpc::Status details;
  details.add_details()->PackFrom(request);
  FakeServer server;
  server.OnCreate([&](const auto&, auto*) {
    return grpc::Status(grpc::StatusCode::INVALID_ARGUMENT, kHostile, details.SerializeAsString());
  });
  Client client(server.address(), 5s);
  try {
    client.Call(&Client::Stub::CreateJob, v1::CreateJobRequest());
    FAIL() << "the call did not fail";
  } catch (const CallFailure& failure) {
    EXPECT_STREQ(failure.what(), kHarmless);
    ASSERT_EQ(failure.violations().size(), 1U);
    EXPECT_EQ(failure.violations()[0].description, kHarmless);
  }
}

TEST(PrintableAnswers, BytesAndLinesStayAsTheyAre) {
  v1::ReadArtifactResponse response;
  response.set_data(kHostile);
  MakePrintable(&response);
  EXPECT_EQ(response.data(), kHostile);
  v1::Job job;
  job.set_name("a\tb\nc");
  MakePrintable(&job);
  EXPECT_EQ(job.name(), "a\tb\nc");
}

}  // namespace
}  // namespace contact::cli
