#include "gateway/protocol/codes.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "gateway/protocol/dialect.h"
#include "gateway/protocol/frames.h"
#include "rpc/call/status.h"

namespace contact::gateway {
namespace {

using nlohmann::json;

TEST(CodesTest, EveryCodeHasTheNameAndStatusOfConnect) {
  // https://connectrpc.com/docs/protocol#error-codes
  const std::vector<std::pair<std::string, int>> codes = {{"ok", 200},
                                                          {"canceled", 499},
                                                          {"unknown", 500},
                                                          {"invalid_argument", 400},
                                                          {"deadline_exceeded", 504},
                                                          {"not_found", 404},
                                                          {"already_exists", 409},
                                                          {"permission_denied", 403},
                                                          {"resource_exhausted", 429},
                                                          {"failed_precondition", 400},
                                                          {"aborted", 409},
                                                          {"out_of_range", 400},
                                                          {"unimplemented", 501},
                                                          {"internal", 500},
                                                          {"unavailable", 503},
                                                          {"data_loss", 500},
                                                          {"unauthenticated", 401}};
  for (std::size_t code = 0; code < codes.size(); ++code) {
    EXPECT_EQ(ConnectCode(static_cast<grpc::StatusCode>(code)), codes[code].first);
    EXPECT_EQ(HttpStatus(static_cast<grpc::StatusCode>(code)), codes[code].second);
  }
}

TEST(CodesTest, AnErrorHasItsDetailsAsBytesAndReadable) {
  Error error = MakeError(Reason::kFieldInvalid, "no");
  const json object = json::parse(ErrorJson(ToGrpc(error)));
  EXPECT_EQ(object["code"], "invalid_argument");
  EXPECT_EQ(object["message"], "no");
  const json& detail = object["details"].at(0);
  EXPECT_EQ(detail["type"], "google.rpc.ErrorInfo");
  EXPECT_EQ(detail["debug"]["reason"], "FIELD_INVALID");
  EXPECT_EQ(std::string(detail["value"]).find('='), std::string::npos);
}

TEST(CodesTest, AnErrorWithoutWordsOrWithBrokenOnesIsJson) {
  EXPECT_EQ(ErrorJson({grpc::StatusCode::INTERNAL, ""}), R"({"code":"internal"})");
  const json object = json::parse(ErrorJson({grpc::StatusCode::INTERNAL, "a\xff\"\n"}));
  EXPECT_EQ(object["message"], "a\xEF\xBF\xBD\"\n");
}

TEST(CodesTest, AConnectStreamEndsWithAFrameOfJson) {
  const Dialect connect = *DialectOf("application/connect+json");
  EXPECT_EQ(EndOf(connect, grpc::Status::OK, {}), ToBytes({kEndOfStream, "{}"}));
  const Trailers trailers = {{"a", "1"}, {"a", "2"}, {"b-bin", "\xff"}};
  const std::string end = EndOf(connect, {grpc::StatusCode::ABORTED, "x"}, trailers).substr(5);
  EXPECT_EQ(json::parse(end), json::parse(R"({"error":{"code":"aborted","message":"x"},
                            "metadata":{"a":["1","2"],"b-bin":["/w"]}})"));
}

TEST(CodesTest, AWebStreamEndsWithAFrameOfTrailers) {
  const Dialect web = *DialectOf("application/grpc-web");
  EXPECT_EQ(EndOf(web, grpc::Status::OK, {}), ToBytes({kTrailers, "grpc-status: 0\r\n"}));
  const grpc::Status error(grpc::StatusCode::NOT_FOUND, "50 %\r\né", "\x01\xff");
  EXPECT_EQ(EndOf(web, error, {{"b-bin", "\xff"}}).substr(5),
            "grpc-status: 5\r\ngrpc-message: 50 %25%0D%0A%C3%A9\r\n"
            "grpc-status-details-bin: Af8\r\nb-bin: /w\r\n");
  EXPECT_EQ(EndOf(*DialectOf("application/grpc-web-text"), grpc::Status::OK, {}),
            ToPaddedBase64(ToBytes({kTrailers, "grpc-status: 0\r\n"})));
}

TEST(CodesTest, AFailedUnaryCallHasTheStatusOfItsCodeAndItsTrailers) {
  const HttpAnswer answer =
      Failure(*DialectOf("application/proto"), {grpc::StatusCode::NOT_FOUND, "no"}, {{"a", "1"}});
  EXPECT_EQ(answer.status, 404);
  EXPECT_EQ(answer.headers.front().second, "application/json");
  EXPECT_EQ(answer.headers.back(), (std::pair<std::string, std::string>("trailer-a", "1")));
  EXPECT_EQ(
      Failure(*DialectOf("application/connect+proto"), {grpc::StatusCode::NOT_FOUND, "no"}).status,
      200);
}

}  // namespace
}  // namespace contact::gateway
