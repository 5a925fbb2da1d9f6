#include "rpc/job_service.h"

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "test_server.h"

namespace contact {
namespace {

using testing::HasSubstr;

template <class Detail>
Detail Find(const grpc::Status& status) {
  google::rpc::Status details;
  details.ParseFromString(status.error_details());
  Detail found;
  for (const auto& detail : details.details()) {
    if (detail.UnpackTo(&found)) return found;
  }
  ADD_FAILURE() << "no " << Detail::descriptor()->name();
  return found;
}

grpc::Status Create(TestServer& server, const v1::CreateJobRequest& request, v1::Job* job,
                    grpc_compression_algorithm compression = GRPC_COMPRESS_NONE) {
  grpc::ClientContext context;
  context.set_compression_algorithm(compression);
  return server.stub().CreateJob(&context, request, job);
}

v1::CreateJobRequest Request(const v1::Scenario& scenario) {
  v1::CreateJobRequest request;
  *request.mutable_job()->mutable_scenario() = scenario;
  return request;
}

int Jobs(TestServer& server) {
  grpc::ClientContext context;
  v1::ListJobsResponse response;
  EXPECT_TRUE(server.stub().ListJobs(&context, {}, &response).ok());
  return response.jobs_size();
}

TEST(JobServiceTest, UnknownJobIsNotFoundByName) {
  TestServer server;
  v1::Job job;
  std::vector<grpc::Status> answers;
  {
    grpc::ClientContext context;
    v1::GetJobRequest request;
    request.set_name("jobs/none");
    answers.push_back(server.stub().GetJob(&context, request, &job));
  }
  {
    grpc::ClientContext context;
    v1::CancelJobRequest request;
    request.set_name("jobs/none");
    answers.push_back(server.stub().CancelJob(&context, request, &job));
  }
  {
    grpc::ClientContext context;
    v1::UpdateJobRequest request;
    request.mutable_job()->set_name("jobs/none");
    request.mutable_job()->set_note("x");
    answers.push_back(server.stub().UpdateJob(&context, request, &job));
  }
  {
    grpc::ClientContext context;
    v1::DeleteJobRequest request;
    request.set_name("jobs/none");
    google::protobuf::Empty nothing;
    answers.push_back(server.stub().DeleteJob(&context, request, &nothing));
  }
  for (const grpc::Status& status : answers) {
    EXPECT_EQ(status.error_code(), grpc::NOT_FOUND);
    EXPECT_EQ(Reason(status), "JOB_NOT_FOUND");
    EXPECT_EQ(Find<google::rpc::ResourceInfo>(status).resource_name(), "jobs/none");
  }
}

TEST(JobServiceTest, CreatedJobCanBeRead) {
  TestServer server;
  v1::GetJobRequest request;
  request.set_name(server.Create(Collision()));
  grpc::ClientContext context;
  v1::Job job;
  ASSERT_TRUE(server.stub().GetJob(&context, request, &job).ok());
  EXPECT_EQ(job.name(), request.name());
  EXPECT_EQ(job.scenario().bodies_size(), 2);
}

TEST(JobServiceTest, BadScenarioListsAllThatIsWrongAndStoresNothing) {
  TestServer server;
  v1::Scenario scenario = Collision();
  scenario.mutable_bodies(0)->set_mass_kg(-1);
  scenario.mutable_contacts(0)->set_restitution(2);
  v1::Job job;
  const grpc::Status status = Create(server, Request(scenario), &job);
  EXPECT_EQ(status.error_code(), grpc::INVALID_ARGUMENT);
  EXPECT_EQ(Reason(status), "SCENARIO_INVALID");
  const auto request = Find<google::rpc::BadRequest>(status);
  ASSERT_EQ(request.field_violations_size(), 2);
  EXPECT_THAT(request.field_violations(0).field(), HasSubstr("bodies[0].mass_kg"));
  EXPECT_THAT(request.field_violations(1).field(), HasSubstr("contacts[0].restitution"));
  EXPECT_EQ(Jobs(server), 0);
}

TEST(JobServiceTest, ValidateOnlyStoresNothing) {
  TestServer server;
  v1::CreateJobRequest request = Request(Collision());
  request.set_validate_only(true);
  v1::Job job;
  EXPECT_TRUE(Create(server, request, &job).ok());
  EXPECT_EQ(job.name(), "");
  EXPECT_EQ(job.state(), v1::Job::STATE_UNSPECIFIED);
  EXPECT_EQ(Jobs(server), 0);
}

TEST(JobServiceTest, ServerInfoJoinsWhatServerAndManagerKnow) {
  TestServer server({.max_message_bytes = 1 << 20}, {.workers = 1, .max_watchers = 5});
  grpc::ClientContext context;
  v1::ServerInfo info;
  ASSERT_TRUE(server.stub().GetServerInfo(&context, {}, &info).ok());
  EXPECT_EQ(info.workers(), 1);
  EXPECT_EQ(info.limits().max_message_bytes(), 1 << 20);
  EXPECT_EQ(info.limits().max_watchers(), 5);
}

TEST(JobServiceTest, OversizedRequestIsRefusedBeforeItIsRead) {
  TestServer server({.max_message_bytes = 1 << 16});
  v1::Scenario scenario = Collision();
  scenario.set_title(std::string(1 << 16, 'x'));
  v1::Job job;
  EXPECT_EQ(Create(server, Request(scenario), &job).error_code(), grpc::RESOURCE_EXHAUSTED);
  scenario.set_title("");
  EXPECT_TRUE(Create(server, Request(scenario), &job).ok());
}

TEST(JobServiceTest, DrainingManagerRefusesNewJobsOnly) {
  TestServer server;
  server.Create(Collision());
  server.jobs().creator().Drain();
  v1::Job job;
  const grpc::Status status = Create(server, Request(Collision()), &job);
  EXPECT_EQ(status.error_code(), grpc::UNAVAILABLE);
  EXPECT_EQ(Reason(status), "SERVER_DRAINING");
  EXPECT_EQ(Jobs(server), 1);
}

TEST(JobServiceTest, SeriesAnswersColumnsAndTellsUnknownChannels) {
  TestServer server;
  const std::string name = server.Create(Collision());
  ASSERT_TRUE(Eventually([&] {
    grpc::ClientContext context;
    v1::GetJobRequest request;
    request.set_name(name);
    v1::Job job;
    return server.stub().GetJob(&context, request, &job).ok() && job.state() == v1::Job::SUCCEEDED;
  }));
  v1::GetSeriesRequest request;
  request.set_name(name);
  request.add_channels("A-B.contact_force");
  request.set_max_points(50);
  v1::Series series;
  grpc::ClientContext first;
  ASSERT_TRUE(server.stub().GetSeries(&first, request, &series).ok());
  EXPECT_LE(series.samples(), 50);
  EXPECT_EQ(series.recorded_samples(), 1001);
  ASSERT_EQ(series.columns_size(), 2);
  EXPECT_EQ(series.columns(1).unit(), "N");
  EXPECT_EQ(series.columns(1).values().size(), 8U * static_cast<unsigned>(series.samples()));

  request.add_channels("A.force");
  grpc::ClientContext second;
  const grpc::Status refused = server.stub().GetSeries(&second, request, &series);
  EXPECT_EQ(refused.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(Reason(refused), "FIELD_INVALID");
  const auto request_detail = Find<google::rpc::BadRequest>(refused);
  EXPECT_EQ(request_detail.field_violations(0).field(), "channels[1]");
  EXPECT_THAT(request_detail.field_violations(0).description(), HasSubstr("A-B.contact_force"));
}

}  // namespace
}  // namespace contact
