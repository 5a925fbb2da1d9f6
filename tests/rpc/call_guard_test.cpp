#include "rpc/call/call_guard.h"

#include <grpcpp/test/server_context_test_spouse.h>
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "test_server.h"
#include "testing/fake_sources.h"

namespace contact {
namespace {

using namespace std::chrono_literals;

constexpr char kGetJob[] = "/contact.v1.JobService/GetJob";

TEST(PeerTest, IsTheAddressWithoutThePort) {
  EXPECT_EQ(PeerOf("ipv4:127.0.0.1:4711"), "ipv4:127.0.0.1");
  EXPECT_EQ(PeerOf("ipv6:%5B::1%5D:4711"), "ipv6:%5B::1%5D");
  EXPECT_EQ(PeerOf("unix:1000:7"), "unix:1000");
}

TEST(PeerTest, CountsUntilTheLeaseGoes) {
  const auto counts = std::make_shared<PeerCounts>();
  auto first = counts->Enter("a");
  const auto second = counts->Enter("a");
  const auto other = counts->Enter("b");
  EXPECT_EQ(counts->Of("a"), 2);
  first.reset();
  EXPECT_EQ(counts->Of("a"), 1);
  EXPECT_EQ(counts->Of("b"), 1);
  EXPECT_EQ(counts->Of("c"), 0);
}

TEST(CallGuardTest, MetadataUpToTheLimitIsTaken) {
  Quotas quotas({}, SystemClock());
  CallGuard guard({.max_metadata_bytes = 1024}, Door(), quotas, std::make_shared<PeerCounts>(),
                  std::make_shared<RpcMetrics>(), SystemClock());
  const std::string room(1024 - 2 * (32 + 2), 'x');  // Two entries with names of two bytes.
  for (const auto& [extra, taken] : {std::pair{"", true}, std::pair{"x", false}}) {
    grpc::ServerContext context;
    grpc::testing::ServerContextTestSpouse spouse(&context);
    spouse.AddClientMetadata("k1", room);
    spouse.AddClientMetadata("k2", extra);
    const auto refusal = guard.Check(context, kGetJob, CallKind::kUnary).refusal;
    EXPECT_EQ(!refusal, taken) << extra;
    EXPECT_EQ(refusal.value_or(Error{}).reason, taken ? "" : "METADATA_TOO_LARGE");
  }
}

TEST(CallGuardTest, CreatesArePacedByTheClockAndOtherCallsAreNot) {
  FakeClock clock;
  const auto metrics = std::make_shared<RpcMetrics>();
  Quotas quotas({}, clock);
  CallGuard guard({.max_creates_per_second = 1, .max_create_burst = 1}, Door(), quotas,
                  std::make_shared<PeerCounts>(), metrics, clock);
  grpc::ServerContext context;
  const auto reason = [&](CallKind kind) {
    return guard.Check(context, kGetJob, kind).refusal.value_or(Error{}).reason;
  };
  EXPECT_EQ(reason(CallKind::kCreateJob), "");
  EXPECT_EQ(reason(CallKind::kCreateJob), "RATE_LIMITED");
  EXPECT_EQ(reason(CallKind::kUnary), "");
  clock.Advance(1s);
  EXPECT_EQ(reason(CallKind::kCreateJob), "");
  EXPECT_EQ(metrics->refused()["RATE_LIMITED"], 1);
}

TEST(CallGuardTest, QuotasHoldForThePrincipalWhateverTheConnection) {
  FakeClock clock;
  const auto metrics = std::make_shared<RpcMetrics>();
  Quotas quotas({.creates_per_second = 1, .create_burst = 2, .streams = 1, .calls = 2}, clock);
  const auto guard_of = [&](const char* name) {
    return CallGuard({}, Door(Principal{name, "acme", {Role::kSubmit}, "socket"}), quotas,
                     std::make_shared<PeerCounts>(), metrics, clock);
  };
  CallGuard ada = guard_of("ada"), ada_elsewhere = guard_of("ada"), bob = guard_of("bob");
  grpc::ServerContext context;
  const auto reason = [](const Admission& admission) {
    return admission.refusal.value_or(Error{}).reason;
  };
  Admission first = ada.Check(context, kGetJob, CallKind::kStream);
  EXPECT_EQ(reason(first), "");
  EXPECT_EQ(reason(ada_elsewhere.Check(context, kGetJob, CallKind::kStream)), "QUOTA_EXCEEDED");
  EXPECT_EQ(reason(bob.Check(context, kGetJob, CallKind::kStream)), "");
  EXPECT_EQ(reason(ada.Check(context, kGetJob, CallKind::kUnary)), "") << "another resource";
  first = {};
  EXPECT_EQ(reason(ada.Check(context, kGetJob, CallKind::kStream)), "");
  for (const char* expected : {"", "", "QUOTA_EXCEEDED"}) {
    EXPECT_EQ(reason(ada.Check(context, kGetJob, CallKind::kCreateJob)), expected);
  }
  EXPECT_EQ(metrics->refused()["QUOTA_EXCEEDED"], 2);
  EXPECT_EQ(metrics->past_quota()["STREAMS"], 1);
  EXPECT_EQ(metrics->past_quota()["CREATE_CALLS"], 1);
}

TEST(CallGuardTest, LimitsOfAPeerDoNotKeepAKnownAdminOut) {
  FakeClock clock;
  Quotas quotas({}, clock);
  const auto streams = std::make_shared<PeerCounts>();
  grpc::ServerContext context;
  const auto crowd = streams->Enter(PeerOf(context.peer()));
  for (const Role role : {Role::kOperator, Role::kAdmin}) {
    CallGuard guard(
        {.max_creates_per_second = 1e-9, .max_create_burst = 1, .max_watchers_per_peer = 0},
        Door(Principal{"x", "acme", {role}, "token"}), quotas, streams,
        std::make_shared<RpcMetrics>(), clock);
    guard.Check(context, kGetJob, CallKind::kCreateJob);
    const bool admin = role == Role::kAdmin;
    EXPECT_EQ(!guard.Check(context, kGetJob, CallKind::kCreateJob).refusal, admin);
    EXPECT_EQ(!guard.Check(context, kGetJob, CallKind::kStream).refusal, admin);
  }
}

// What the details of a status say.
std::chrono::milliseconds RetryAfter(const grpc::Status& status) {
  google::rpc::Status details;
  details.ParseFromString(status.error_details());
  google::rpc::RetryInfo retry;
  for (const auto& detail : details.details()) {
    if (!detail.UnpackTo(&retry)) continue;
    return std::chrono::seconds(retry.retry_delay().seconds()) +
           std::chrono::milliseconds(retry.retry_delay().nanos() / 1'000'000);
  }
  return 0ms;
}

TEST(CallLimitsTest, CreatesPastTheRateAreToldWhenToComeAgain) {
  TestServer server({.calls = {.max_creates_per_second = 0.001, .max_create_burst = 2}});
  server.Create(Collision());
  server.Create(Collision());
  grpc::ClientContext context;
  v1::Job job;
  const grpc::Status third = server.stub().CreateJob(&context, {}, &job);
  EXPECT_EQ(third.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_EQ(Reason(third), "RATE_LIMITED");
  EXPECT_GT(RetryAfter(third), 900s);
  EXPECT_LE(RetryAfter(third), 1000s);
}

TEST(CallLimitsTest, WatchersOfAPeerAreCountedWhileTheyWatch) {
  TestServer server({.calls = {.max_watchers_per_peer = 2}});
  v1::WatchJobRequest request;
  request.set_name(server.Create(Endless()));
  struct Watch {
    grpc::ClientContext context;
    std::unique_ptr<grpc::ClientReader<v1::WatchJobResponse>> reader;
  };
  std::vector<Watch> watches(2);
  v1::WatchJobResponse response;
  for (Watch& watch : watches) {
    watch.reader = server.stub().WatchJob(&watch.context, request);
    EXPECT_TRUE(watch.reader->Read(&response));
  }
  const auto watch_once = [&] {
    grpc::ClientContext context;
    const auto reader = server.stub().WatchJob(&context, request);
    if (reader->Read(&response)) context.TryCancel();
    return reader->Finish();
  };
  const grpc::Status third = watch_once();
  EXPECT_EQ(third.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_EQ(Reason(third), "WATCHER_LIMIT");
  EXPECT_GT(RetryAfter(third), 0ms);
  watches.front().context.TryCancel();
  EXPECT_TRUE(Eventually([&] { return watch_once().error_code() == grpc::StatusCode::CANCELLED; }));
}

TEST(CallLimitsTest, ServerTellsThem) {
  TestServer server({.max_message_bytes = 1 << 20,
                     .calls = {.max_metadata_bytes = 4096,
                               .max_creates_per_second = 5,
                               .max_create_burst = 6,
                               .max_watchers_per_peer = 7}});
  grpc::ClientContext context;
  v1::ServerInfo info;
  ASSERT_TRUE(server.stub().GetServerInfo(&context, {}, &info).ok());
  const v1::ServerLimits& limits = info.limits();
  EXPECT_EQ(limits.max_message_bytes(), 1 << 20);
  EXPECT_EQ(limits.max_metadata_bytes(), 4096);
  EXPECT_EQ(limits.max_creates_per_second(), 5);
  EXPECT_EQ(limits.max_create_burst(), 6);
  EXPECT_EQ(limits.max_watchers_per_peer(), 7);
}

}  // namespace
}  // namespace contact
