#include "gateway/protocol/rpc_request.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <variant>

#include "contact/v1/job_service.pb.h"
#include "gateway/protocol/codec.h"
#include "gateway/protocol/frames.h"

namespace contact::gateway {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Key;
using testing::Pair;

constexpr char kGet[] = "/contact.v1.JobService/GetJob";
constexpr char kCreate[] = "/contact.v1.JobService/CreateJob";
constexpr char kWatch[] = "/contact.v1.JobService/WatchJob";

HttpRequest Post(const std::string& path, const std::string& type, std::string body) {
  // The methods of the contract are known once it is linked.
  v1::GetJobRequest::descriptor();
  return {.method = "POST",
          .target = path,
          .headers = {{"content-type", type}},
          .body = std::move(body)};
}

std::string JobBytes() {
  v1::GetJobRequest request;
  request.set_name("jobs/a");
  return request.SerializeAsString();
}

// The call that the request is, which must be one.
RpcRequest Read(const HttpRequest& request) {
  auto read = ReadRpc(request);
  if (const auto* refusal = std::get_if<HttpAnswer>(&read)) {
    ADD_FAILURE() << refusal->status << " " << refusal->body;
    return {};
  }
  return std::get<RpcRequest>(read);
}

// The answer to a request that is no proper call.
HttpAnswer Refusal(const HttpRequest& request) {
  auto read = ReadRpc(request);
  if (!std::holds_alternative<HttpAnswer>(read)) {
    ADD_FAILURE() << "the request was taken";
    return {};
  }
  return std::get<HttpAnswer>(read);
}

std::string CodeOf(const HttpAnswer& answer) {
  return nlohmann::json::parse(answer.body).value("code", "");
}

TEST(RpcRequestTest, MethodsOfTheContractAreFoundOthersNot) {
  EXPECT_TRUE(IsRpc(Post(kGet, "", "")));
  for (const char* path : {"/contact.v1.JobService/Nothing", "/contact.v1.JobService", "/",
                           "/a/b/c", "/contact.v1/JobService/GetJob",
                           "/contact.v1.JobService/GetJob/", "contact.v1.JobService/GetJob"}) {
    EXPECT_FALSE(IsRpc(Post(path, "", ""))) << path;
  }
}

TEST(RpcRequestTest, OneMessageIsTheSameInAllDialects) {
  const std::string message = R"({"name":"jobs/a"})";
  for (const auto& [type, body] : std::vector<std::pair<std::string, std::string>>{
           {"application/json", message},
           {"Application/JSON; charset=utf-8", message},
           {"application/proto", JobBytes()},
           {"application/grpc-web", ToBytes({0, JobBytes()})},
           {"application/grpc-web+proto", ToBytes({0, JobBytes()})},
           {"application/grpc-web+json", ToBytes({0, message})},
           {"application/grpc-web-text", ToPaddedBase64(ToBytes({0, JobBytes()}))},
           {"application/grpc-web-text+proto", ToPaddedBase64(ToBytes({0, JobBytes()}))}}) {
    EXPECT_EQ(Read(Post(kGet, type, body)).message, JobBytes()) << type;
  }
  for (const auto& [type, body] : std::vector<std::pair<std::string, std::string>>{
           {"application/connect+json", ToBytes({0, message})},
           {"application/connect+proto", ToBytes({0, JobBytes()})},
           {"application/grpc-web", ToBytes({0, JobBytes()})}}) {
    EXPECT_EQ(Read(Post(kWatch, type, body)).message, JobBytes()) << type;
  }
}

TEST(RpcRequestTest, TypesThatTheMethodHasNotAreRefusedWithTheOnesItHas) {
  for (const char* type : {"", "text/plain", "application/grpc", "application/connect+json"}) {
    const HttpAnswer answer = Refusal(Post(kGet, type, "{}"));
    EXPECT_EQ(answer.status, 415) << type;
    EXPECT_THAT(answer.headers, Contains(Key("accept-post")));
    EXPECT_THAT(answer.body, HasSubstr("GetJob must be application/json, application/proto or"));
    EXPECT_THAT(answer.body, HasSubstr(std::string("and is '") + type + "'"));
  }
  const HttpAnswer stream = Refusal(Post(kWatch, "application/json", "{}"));
  EXPECT_EQ(stream.status, 415);
  EXPECT_THAT(stream.body, HasSubstr("application/connect+json, application/connect+proto or"));
}

TEST(RpcRequestTest, OnlyMethodsWithoutSideEffectsAreAGet) {
  HttpRequest get =
      Post(std::string(kGet) + "?connect=v1&encoding=json&message=%7B%22name%22%3A%22" +
               "jobs%2Fa%22%7D",
           "", "");
  get.method = "GET";
  EXPECT_EQ(Read(get).message, JobBytes());
  get.target = std::string(kGet) + "?base64=1&encoding=proto&message=" + ToBase64(JobBytes());
  EXPECT_EQ(Read(get).message, JobBytes());
  for (const char* path : {kCreate, kWatch}) {
    get.target = std::string(path) + "?encoding=json&message=%7B%7D";
    const HttpAnswer answer = Refusal(get);
    EXPECT_EQ(answer.status, 405);
    EXPECT_THAT(answer.headers, Contains(Pair("allow", "POST, OPTIONS")));
  }
}

TEST(RpcRequestTest, AGetThatIsNotWholeIsRefused) {
  HttpRequest get = Post(kGet, "", "");
  get.method = "GET";
  for (const auto& [query, status] : std::vector<std::pair<std::string, int>>{
           {"", 415},
           {"?encoding=xml&message=x", 415},
           {"?encoding=json", 400},
           {"?encoding=json&message=%7", 400},
           {"?connect=v2&encoding=json&message=%7B%7D", 400},
           {"?encoding=proto&base64=1&message=!", 400},
           {"?encoding=json&message=%7B%7D&compression=gzip", 501}}) {
    get.target = kGet + query;
    EXPECT_EQ(Refusal(get).status, status) << query;
  }
}

TEST(RpcRequestTest, CompressionIsUnimplementedAndWhatIsTakenIsSaid) {
  HttpRequest request = Post(kGet, "application/json", "{}");
  request.headers.emplace_back("content-encoding", "gzip");
  const HttpAnswer answer = Refusal(request);
  EXPECT_EQ(CodeOf(answer), "unimplemented");
  EXPECT_THAT(answer.headers, Contains(Pair("accept-encoding", "identity")));

  HttpRequest stream = Post(kWatch, "application/connect+proto", ToBytes({0, JobBytes()}));
  stream.headers.emplace_back("connect-content-encoding", "gzip");
  EXPECT_THAT(Refusal(stream).body, HasSubstr("unimplemented"));
  EXPECT_THAT(Refusal(stream).headers, Contains(Pair("connect-accept-encoding", "identity")));
  HttpRequest web = Post(kGet, "application/grpc-web", ToBytes({0, JobBytes()}));
  web.headers.emplace_back("grpc-encoding", "gzip");
  EXPECT_THAT(Refusal(web).body, HasSubstr("grpc-status: 12"));
  const auto frame = ToBytes({kCompressed, JobBytes()});
  EXPECT_THAT(Refusal(Post(kGet, "application/grpc-web", frame)).body,
              HasSubstr("grpc-status: 12"));
}

TEST(RpcRequestTest, OnlyVersionOneOfConnectIsKnown) {
  HttpRequest request = Post(kGet, "application/json", "{}");
  request.headers.emplace_back("connect-protocol-version", "2");
  EXPECT_EQ(CodeOf(Refusal(request)), "invalid_argument");
  request.headers.back().second = "1";
  Read(request);
}

TEST(RpcRequestTest, DeadlinesAreReadAndBadOnesRefused) {
  HttpRequest request = Post(kGet, "application/json", "{}");
  EXPECT_FALSE(Read(request).timeout);
  request.headers.emplace_back("connect-timeout-ms", "250");
  EXPECT_EQ(Read(request).timeout, std::chrono::milliseconds(250));
  request.headers.back().second = "soon";
  EXPECT_EQ(CodeOf(Refusal(request)), "invalid_argument");
  HttpRequest web = Post(kGet, "application/grpc-web", ToBytes({0, JobBytes()}));
  web.headers.emplace_back("grpc-timeout", "99999999H");
  EXPECT_EQ(Read(web).timeout, std::chrono::hours(24 * 365));
}

TEST(RpcRequestTest, BadFramesAreErrorsOfTheProtocol) {
  const std::string frame = ToBytes({0, JobBytes()});
  for (const auto& [body, code] : std::vector<std::pair<std::string, std::string>>{
           {"", "unimplemented"},
           {frame + frame, "unimplemented"},
           {frame.substr(0, 7), "invalid_argument"},
           {ToBytes({kEndOfStream, JobBytes()}), "invalid_argument"}}) {
    const HttpAnswer answer = Refusal(Post(kWatch, "application/connect+proto", body));
    EXPECT_EQ(answer.status, 200);
    const auto frames = ToFrames(answer.body);
    ASSERT_TRUE(frames && frames->size() == 1);
    EXPECT_EQ(frames->front().flags, kEndOfStream);
    EXPECT_EQ(nlohmann::json::parse(frames->front().payload)["error"]["code"], code);
  }
}

TEST(RpcRequestTest, BadJsonNamesThePlace) {
  const HttpAnswer answer = Refusal(Post(kGet, "application/json", R"({"nam":"jobs/a"})"));
  EXPECT_EQ(answer.status, 400);
  EXPECT_THAT(answer.body, HasSubstr("nam"));
  EXPECT_THAT(answer.body, HasSubstr("FIELD_INVALID"));
  for (const char* message : {"{", "[]", "null}", "{\"name\":1.5}", "{\"name\":\"\xff\"}"}) {
    EXPECT_EQ(CodeOf(Refusal(Post(kGet, "application/json", message))), "invalid_argument")
        << message;
  }
}

TEST(RpcRequestTest, AnEmptyBodyOfJsonIsAnEmptyMessage) {
  EXPECT_EQ(Read(Post(kGet, "application/json", "")).message, "");
}

TEST(RpcRequestTest, DeepJsonIsRefused) {
  std::string deep;
  for (int i = 0; i < 100'000; ++i) deep += R"({"job":)";
  EXPECT_EQ(CodeOf(Refusal(Post(kCreate, "application/json", deep))), "invalid_argument");
}

TEST(RpcRequestTest, AnAnswerHasItsMetadataBeforeAndBehind) {
  v1::Job job;
  job.set_name("jobs/a");
  const RpcRequest call = Read(Post(kGet, "application/json", "{}"));
  const HttpAnswer answer =
      AnswerOf(call, job.SerializeAsString(), grpc::Status::OK, {{"h", "1"}}, {{"t-bin", "\xff"}});
  EXPECT_EQ(answer.status, 200);
  EXPECT_EQ(answer.body, R"({"name":"jobs/a"})");
  EXPECT_THAT(answer.headers, Contains(Pair("h", "1")));
  EXPECT_THAT(answer.headers, Contains(Pair("trailer-t-bin", "/w")));
  EXPECT_THAT(answer.headers, Contains(Pair("cache-control", "no-store")));
}

TEST(RpcRequestTest, AWebAnswerIsAMessageAndItsTrailers) {
  v1::Job job;
  job.set_name("jobs/a");
  const std::string bytes = job.SerializeAsString();
  const RpcRequest call = Read(Post(kGet, "application/grpc-web", ToBytes({0, JobBytes()})));
  const auto frames = ToFrames(AnswerOf(call, bytes, grpc::Status::OK, {}, {}).body);
  ASSERT_TRUE(frames && frames->size() == 2);
  EXPECT_EQ(frames->front().payload, bytes);
  EXPECT_EQ(frames->back().flags, kTrailers);
}

TEST(RpcRequestTest, ABodyThatIsTooLargeIsAnErrorOfTheProtocol) {
  EXPECT_EQ(Exhausted(Post(kGet, "application/json", ""), 413, "").status, 429);
  EXPECT_EQ(Exhausted(Post(kGet, "application/grpc-web", ""), 413, "").status, 200);
  EXPECT_EQ(Exhausted(Post("/x", "application/json", ""), 413, "").status, 413);
}

}  // namespace
}  // namespace contact::gateway
