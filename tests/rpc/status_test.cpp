#include "rpc/call/status.h"

#include <gmock/gmock.h>

#include <map>
#include <optional>
#include <string>

#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"

namespace contact {
namespace {

using std::chrono::milliseconds;

google::rpc::Status Details(const grpc::Status& status) {
  google::rpc::Status details;
  EXPECT_TRUE(details.ParseFromString(status.error_details()));
  return details;
}

template <class Detail>
std::optional<Detail> FindDetail(const grpc::Status& status) {
  const google::rpc::Status details = Details(status);
  Detail detail;
  for (const auto& any : details.details()) {
    if (any.UnpackTo(&detail)) return detail;
  }
  return std::nullopt;
}

TEST(ToGrpcTest, EveryErrorOfTheContractKeepsCodeReasonAndWords) {
  const std::map<std::string, std::pair<absl::StatusCode, grpc::StatusCode>> contract = {
      {"SCENARIO_INVALID", {absl::StatusCode::kInvalidArgument, grpc::INVALID_ARGUMENT}},
      {"FIELD_INVALID", {absl::StatusCode::kInvalidArgument, grpc::INVALID_ARGUMENT}},
      {"REQUEST_ID_REUSED", {absl::StatusCode::kAlreadyExists, grpc::ALREADY_EXISTS}},
      {"QUEUE_FULL", {absl::StatusCode::kResourceExhausted, grpc::RESOURCE_EXHAUSTED}},
      {"WATCHER_LIMIT", {absl::StatusCode::kResourceExhausted, grpc::RESOURCE_EXHAUSTED}},
      {"NO_TRAJECTORY", {absl::StatusCode::kFailedPrecondition, grpc::FAILED_PRECONDITION}},
      {"SERIES_TOO_LARGE", {absl::StatusCode::kOutOfRange, grpc::OUT_OF_RANGE}},
      {"SERVER_DRAINING", {absl::StatusCode::kUnavailable, grpc::UNAVAILABLE}},
      {"JOB_NOT_FOUND", {absl::StatusCode::kNotFound, grpc::NOT_FOUND}},
      {"INVALID_STATE", {absl::StatusCode::kFailedPrecondition, grpc::FAILED_PRECONDITION}},
      {"EVENTS_COMPACTED", {absl::StatusCode::kOutOfRange, grpc::OUT_OF_RANGE}},
      {"INTERNAL", {absl::StatusCode::kInternal, grpc::INTERNAL}},
  };
  for (const auto& [reason, code] : contract) {
    const grpc::Status status = ToGrpc({code.first, reason, "some words", {}, {{"key", "value"}}});
    EXPECT_EQ(status.error_code(), code.second) << reason;
    EXPECT_EQ(status.error_message(), "some words");
    EXPECT_EQ(Details(status).code(), code.second);
    EXPECT_EQ(Details(status).message(), "some words");
    const auto info = FindDetail<google::rpc::ErrorInfo>(status);
    ASSERT_TRUE(info) << reason;
    EXPECT_EQ(info->domain(), "contact");
    EXPECT_EQ(info->reason(), reason);
    EXPECT_EQ(info->metadata().at("key"), "value");
  }
}

TEST(ToGrpcTest, ViolationsCarryTheirHints) {
  const grpc::Status status = ToGrpc({absl::StatusCode::kInvalidArgument,
                                      "SCENARIO_INVALID",
                                      "2 errors",
                                      {{"bodies[0].mass_kg", "is -1; must be in (0, 1e12]", ""},
                                       {"contacts[0].between", "names `B9`", "did you mean B2?"}}});
  const auto request = FindDetail<google::rpc::BadRequest>(status);
  ASSERT_TRUE(request);
  ASSERT_EQ(request->field_violations_size(), 2);
  EXPECT_EQ(request->field_violations(0).field(), "bodies[0].mass_kg");
  EXPECT_EQ(request->field_violations(0).description(), "is -1; must be in (0, 1e12]");
  EXPECT_EQ(request->field_violations(1).description(), "names `B9` — did you mean B2?");
}

TEST(ToGrpcTest, ViolationsBeyondTheTrailerLimitAreCounted) {
  Error error{absl::StatusCode::kInvalidArgument, "SCENARIO_INVALID", std::string(5000, 'm')};
  for (int i = 0; i < 100; ++i) {
    error.violations.push_back(
        {"bodies[" + std::to_string(i) + "].mass_kg", std::string(80, 'x'), std::string(40, 'y')});
  }
  const grpc::Status status = ToGrpc(error);
  const int listed = FindDetail<google::rpc::BadRequest>(status)->field_violations_size();
  const auto info = FindDetail<google::rpc::ErrorInfo>(status);
  EXPECT_GT(listed, 10);
  EXPECT_EQ(info->metadata().at("violations_left_out"), std::to_string(100 - listed));
  const std::size_t base64 = status.error_details().size() * 4 / 3;
  EXPECT_LT(base64 + status.error_message().size(), 8192 - 1024) << "other metadata needs room";
}

TEST(ToGrpcTest, LongTextIsCutBetweenCharacters) {
  std::string greek;
  for (int i = 0; i < 1000; ++i) greek += "μ";
  for (const std::string& text : {greek, "x" + greek}) {
    const grpc::Status status =
        ToGrpc({absl::StatusCode::kInvalidArgument, "FIELD_INVALID", text, {{text, text, text}}});
    for (const std::string& cut :
         {status.error_message(),
          FindDetail<google::rpc::BadRequest>(status)->field_violations(0).field(),
          FindDetail<google::rpc::BadRequest>(status)->field_violations(0).description()}) {
      EXPECT_LT(cut.size(), 520U);
      EXPECT_TRUE(cut.ends_with("μ…")) << cut;
    }
  }
}

TEST(ToGrpcTest, OnlyWhatAppliesIsSaid) {
  const grpc::Status plain = ToGrpc({absl::StatusCode::kFailedPrecondition, "INVALID_STATE", "m"});
  EXPECT_EQ(Details(plain).details_size(), 1);

  const grpc::Status retry = ToGrpc({.code = absl::StatusCode::kResourceExhausted,
                                     .reason = "QUEUE_FULL",
                                     .message = "m",
                                     .retry_after = milliseconds{1500}});
  EXPECT_EQ(FindDetail<google::rpc::RetryInfo>(retry)->retry_delay().seconds(), 1);
  EXPECT_EQ(FindDetail<google::rpc::RetryInfo>(retry)->retry_delay().nanos(), 500'000'000);

  const grpc::Status quota = ToGrpc({.code = absl::StatusCode::kResourceExhausted,
                                     .reason = "QUOTA_EXCEEDED",
                                     .message = "ada has 5",
                                     .metadata = {{"principal", "ada"}}});
  EXPECT_EQ(FindDetail<google::rpc::QuotaFailure>(quota)->violations(0).subject(), "principal:ada");
  EXPECT_EQ(FindDetail<google::rpc::QuotaFailure>(quota)->violations(0).description(), "ada has 5");
  EXPECT_FALSE(FindDetail<google::rpc::QuotaFailure>(retry));

  const grpc::Status missing =
      ToGrpc({absl::StatusCode::kNotFound, "JOB_NOT_FOUND", "no jobs/x", {}, {{"name", "jobs/x"}}});
  const auto resource = FindDetail<google::rpc::ResourceInfo>(missing);
  ASSERT_TRUE(resource);
  EXPECT_EQ(resource->resource_type(), "contact.v1.Job");
  EXPECT_EQ(resource->resource_name(), "jobs/x");
}

}  // namespace
}  // namespace contact
