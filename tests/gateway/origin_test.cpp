#include "gateway/protocol/origin.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace contact::gateway {
namespace {

using testing::Contains;
using testing::IsEmpty;
using testing::Pair;

HttpRequest From(const std::string& host, const std::string& origin = "") {
  HttpRequest request;
  request.headers = {{"host", host}};
  if (!origin.empty()) request.headers.emplace_back("origin", origin);
  return request;
}

const OriginRules kRules = {{"lab.example"}, {"https://app.example"}};

TEST(OriginTest, NamesOfTheLoopbackAndOfTheRulesAreAnswered) {
  for (const char* host : {"localhost", "localhost:80", "LOCALHOST:8080", "127.0.0.1:1",
                           "127.1.2.3", "[::1]:8080", "[::1]", "lab.example", "Lab.Example:8443"}) {
    EXPECT_FALSE(Refuse(kRules, From(host))) << host;
  }
}

TEST(OriginTest, OtherNamesAreNot) {
  for (const char* host :
       {"", "evil.example", "127.0.0.1.evil.example", "localhost.evil.example", "128.0.0.1",
        "0.0.0.0", "127.1", "2130706433", "[::2]", "[::1", "localhost:", "localhost:80x",
        "localhost@evil.example", "lab.example.evil", "localhost:8080:9090"}) {
    const auto refusal = Refuse(kRules, From(host));
    ASSERT_TRUE(refusal) << host;
    EXPECT_EQ(refusal->status, 421);
  }
}

TEST(OriginTest, PagesOfItsOwnAndOfTheRulesAreAnsweredOthersNot) {
  EXPECT_FALSE(Refuse(kRules, From("localhost:8080", "http://localhost:8080")));
  EXPECT_FALSE(Refuse(kRules, From("lab.example", "https://lab.example")));
  EXPECT_FALSE(Refuse(kRules, From("localhost:8080", "https://app.example")));
  for (const char* origin : {"null", "http://evil.example", "http://localhost", "file://",
                             "http://localhost:8081", "https://app.example.evil"}) {
    const auto refusal = Refuse(kRules, From("localhost:8080", origin));
    ASSERT_TRUE(refusal) << origin;
    EXPECT_EQ(refusal->status, 403);
  }
}

TEST(OriginTest, OnlyOriginsOfTheRulesMayReadAnswers) {
  EXPECT_THAT(CorsHeaders(kRules, From("localhost", "https://app.example")),
              Contains(Pair("access-control-allow-origin", "https://app.example")));
  EXPECT_THAT(CorsHeaders(kRules, From("localhost", "http://localhost")), IsEmpty());
  EXPECT_THAT(CorsHeaders(kRules, From("localhost")), IsEmpty());
}

TEST(OriginTest, APreflightOfAnOriginOfTheRulesIsAllowedItsHeaders) {
  HttpRequest request = From("localhost", "https://app.example");
  request.headers.emplace_back("access-control-request-headers", "content-type,x-a");
  const HttpAnswer answer = Options(kRules, request, "GET");
  EXPECT_EQ(answer.status, 204);
  EXPECT_THAT(answer.headers, Contains(Pair("access-control-allow-headers", "content-type,x-a")));
  EXPECT_THAT(Options(kRules, From("localhost"), "GET").headers,
              testing::ElementsAre(Pair("allow", "GET")));
}

}  // namespace
}  // namespace contact::gateway
