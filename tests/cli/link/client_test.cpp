#include "cli/link/client.h"

#include <gmock/gmock.h>

#include <optional>

#include "cli/link/fake_server.h"
#include "cli/link/jobs.h"
#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"

namespace contact::cli {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

// What a call that the server answers with this status ends in.
CallFailure FailureOf(grpc::Status status) {
  FakeServer server;
  server.OnCreate([&](const auto&, auto*) { return status; });
  Client client(server.address(), 5s);
  try {
    client.Call(&Client::Stub::CreateJob, v1::CreateJobRequest());
  } catch (const CallFailure& failure) {
    return failure;
  }
  throw std::logic_error("the call did not fail");
}

TEST(Client, EveryCodeHasItsExitCode) {
  using S = grpc::StatusCode;
  const std::vector<std::pair<S, ExitCode>> codes = {
      {S::UNAVAILABLE, ExitCode::kUnreachable},     {S::DEADLINE_EXCEEDED, ExitCode::kTimeout},
      {S::NOT_FOUND, ExitCode::kNotFound},          {S::INVALID_ARGUMENT, ExitCode::kUsage},
      {S::RESOURCE_EXHAUSTED, ExitCode::kOverload}, {S::UNAUTHENTICATED, ExitCode::kAuth},
      {S::PERMISSION_DENIED, ExitCode::kAuth},      {S::FAILED_PRECONDITION, ExitCode::kRunFailed},
      {S::INTERNAL, ExitCode::kRunFailed}};
  for (const auto& [code, expected] : codes) {
    EXPECT_EQ(FailureOf({code, "words"}).code(), expected) << code;
  }
}

TEST(Client, ViolationsOfTheServerAreThoseOfTheFile) {
  google::rpc::ErrorInfo info;
  info.set_reason("SCENARIO_INVALID");
  google::rpc::BadRequest request;
  request.add_field_violations()->set_field("scenario.bodies[1].mass_kg");
  request.mutable_field_violations(0)->set_description("is -1");
  google::rpc::Status details;
  details.add_details()->PackFrom(info);
  details.add_details()->PackFrom(request);
  const CallFailure failure =
      FailureOf({grpc::StatusCode::INVALID_ARGUMENT, "the scenario", details.SerializeAsString()});
  EXPECT_EQ(failure.code(), ExitCode::kInvalidScenario);
  EXPECT_EQ(failure.reason(), "SCENARIO_INVALID");
  EXPECT_STREQ(failure.what(), "the scenario (SCENARIO_INVALID)");
  ASSERT_EQ(failure.violations().size(), 1U);
  EXPECT_EQ(failure.violations()[0].field, "bodies[1].mass_kg");
}

TEST(Client, UnreadableDetailsAreNoDetails) {
  EXPECT_EQ(FailureOf({grpc::StatusCode::NOT_FOUND, "words", "\xFF\xFF"}).reason(), "");
}

TEST(Client, SubmitsAgainWithTheSameIdWhileTheServerIsUnavailable) {
  FakeServer server;
  std::vector<std::string> ids;
  server.OnCreate([&](const v1::CreateJobRequest& request, v1::Job* job) {
    ids.push_back(request.request_id());
    if (ids.size() < 3) return grpc::Status(grpc::StatusCode::UNAVAILABLE, "draining");
    job->set_name("jobs/x");
    return grpc::Status::OK;
  });
  Client client(server.address(), 5s);
  v1::CreateJobRequest request;
  request.set_request_id("id");
  EXPECT_EQ(client.Call(&Client::Stub::CreateJob, request).name(), "jobs/x");
  server.Settle();
  EXPECT_THAT(ids, testing::ElementsAre("id", "id", "id"));
}

TEST(Client, RefusedConnectionIsToldAtOnceWithWhatToDo) {
  Client client("127.0.0.1:1", 60s);
  std::optional<CallFailure> failure;
  const auto start = std::chrono::steady_clock::now();
  try {
    client.Call(&Client::Stub::GetServerInfo, v1::GetServerInfoRequest());
  } catch (const CallFailure& thrown) {
    failure = thrown;
  }
  EXPECT_LT(std::chrono::steady_clock::now() - start, 20s);
  ASSERT_TRUE(failure);
  EXPECT_EQ(failure->code(), ExitCode::kUnreachable);
  EXPECT_THAT(failure->what(), HasSubstr("127.0.0.1:1 (connection refused)"));
  EXPECT_THAT(failure->what(), HasSubstr("contactd --listen 127.0.0.1:1 --data-dir DIR"));
  EXPECT_THAT(failure->what(), HasSubstr("CONTACT_SERVER"));
}

TEST(Client, AddressNeedsAPort) {
  for (const char* address : {"", "host", "host:", ":7070", "host:http"}) {
    EXPECT_THROW(Client(address, 1s), Failure) << address;
  }
}

TEST(Client, AddressMayBeAnyHostOrASocketFile) {
  for (const char* address : {"lab.example:7070", "10.0.0.1:1", "[::1]:7070", "unix:/run/c.sock"}) {
    EXPECT_NO_THROW(Client(address, 1s)) << address;
  }
  for (const char* address : {"::1:7070", "a/b:7070", "dns:host:7070", "[::1:7070"}) {
    EXPECT_THROW(Client(address, 1s), Failure) << address;
  }
}

TEST(Client, AddressOfAnotherProtocolIsRefusedWithASentence) {
  for (const char* scheme : {"http", "https", "dns"}) {
    const std::string address = std::string(scheme) + "://127.0.0.1:7070";
    try {
      const Client client(address, 1s);
      ADD_FAILURE() << address;
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.code(), ExitCode::kUsage);
      EXPECT_EQ(failure.what(), "--server is '" + address + "': contactd speaks gRPC, not " +
                                    scheme + "; give HOST:PORT alone, such as 127.0.0.1:7070");
    }
  }
}

TEST(Client, ServerOfAnotherProtocolIsNotToBeStartedThere) {
  const CallFailure failure = FailureOf({grpc::StatusCode::UNAVAILABLE, "Failed parsing HTTP/2"});
  EXPECT_THAT(failure.what(), HasSubstr("(what answers there does not speak gRPC)"));
  EXPECT_THAT(failure.what(), testing::Not(HasSubstr("contactd --listen")));
  EXPECT_THAT(failure.what(), HasSubstr("contactctl --server HOST:PORT"));
}

TEST(Client, JobsMayBeNamedByTheirId) {
  EXPECT_EQ(JobName("k3v9"), "jobs/k3v9");
  EXPECT_EQ(JobName("jobs/k3v9"), "jobs/k3v9");
}

}  // namespace
}  // namespace contact::cli
