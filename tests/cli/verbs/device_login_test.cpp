#include "cli/verbs/identity/device_login.h"

#include <gmock/gmock.h>

#include <deque>
#include <vector>

#include "cli/base/failure.h"

namespace contact::cli {
namespace {

using nlohmann::json;
using std::chrono::seconds;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Pair;

constexpr char kIssuer[] = "https://id.acme/";
const char kJwt[] = "eyJhbGciOiJFZERTQSJ9.e30.c2ln";

// An identity provider whose answers at the token endpoint are given, and a user who waits.
class DeviceLogin : public testing::Test {
 protected:
  LoginToken Run() {
    return LogIn(request_, {.ask = [this](const auto& url, auto* form) { return Ask(url, form); },
                            .show = [this](const LoginPrompt& prompt) { prompt_ = prompt; },
                            .wait = [this](seconds time) { waits_.push_back(time); }});
  }

  // The exit code and message of a login that fails.
  std::pair<ExitCode, std::string> Failed() {
    try {
      Run();
    } catch (const Failure& failure) {
      return {failure.code(), failure.what()};
    }
    return {ExitCode::kOk, ""};
  }

  void Answer(const char* error) { answers_.push_back({400, {{"error", error}}}); }

  LoginRequest request_{.issuer = kIssuer, .client_id = "contactctl", .audience = "contactd"};
  json provider_ = {{"issuer", kIssuer},
                    {"device_authorization_endpoint", "https://id.acme/device"},
                    {"token_endpoint", "https://id.acme/token"}};
  json code_ = {{"device_code", "D"},
                {"user_code", "WDJB-MJHT"},
                {"expires_in", 60},
                {"verification_uri", "https://id.acme/go"},
                {"interval", 7}};
  std::deque<WebAnswer> answers_;
  std::vector<std::pair<std::string, Form>> posted_;
  std::vector<seconds> waits_;
  LoginPrompt prompt_;

 private:
  WebAnswer Ask(const std::string& url, const Form* form) {
    if (form == nullptr) {
      EXPECT_EQ(url, "https://id.acme/.well-known/openid-configuration");
      return {200, provider_};
    }
    posted_.emplace_back(url, *form);
    if (url == "https://id.acme/device") return {200, code_};
    if (answers_.empty()) return {400, {{"error", "authorization_pending"}}};
    WebAnswer answer = answers_.front();
    answers_.pop_front();
    return answer;
  }
};

TEST_F(DeviceLogin, TellsTheCodeAndKeepsTheAccessToken) {
  answers_ = {{200, {{"access_token", kJwt}, {"id_token", "a.b.c"}, {"expires_in", 300}}}};
  const LoginToken token = Run();
  EXPECT_EQ(token.text, kJwt);
  EXPECT_EQ(token.valid, seconds(300));
  EXPECT_EQ(prompt_.uri, "https://id.acme/go");
  EXPECT_EQ(prompt_.code, "WDJB-MJHT");
  EXPECT_EQ(prompt_.valid, seconds(60));
  ASSERT_EQ(posted_.size(), 2U);
  EXPECT_THAT(posted_[0].second,
              ElementsAre(Pair("audience", "contactd"), Pair("client_id", "contactctl"),
                          Pair("scope", "openid")));
  EXPECT_THAT(posted_[1].second,
              IsSupersetOf({Pair("device_code", "D"), Pair("client_id", "contactctl")}));
}

TEST_F(DeviceLogin, ShowsTheAddressThatHasTheCodeIfThereIsOne) {
  code_["verification_uri_complete"] = "https://id.acme/go?code=WDJB-MJHT";
  answers_ = {{200, {{"access_token", kJwt}}}};
  Run();
  EXPECT_EQ(prompt_.uri, "https://id.acme/go?code=WDJB-MJHT");
}

TEST_F(DeviceLogin, WaitsAsTheProviderAsks) {
  Answer("authorization_pending"), Answer("slow_down"), Answer("authorization_pending");
  answers_.push_back({200, {{"access_token", kJwt}}});
  Run();
  EXPECT_THAT(waits_, ElementsAre(seconds(7), seconds(7), seconds(12), seconds(12)));
}

TEST_F(DeviceLogin, EndsWhenTheCodeExpires) {
  EXPECT_EQ(Failed().first, ExitCode::kTimeout);
  EXPECT_EQ(waits_.size(), 9U) << "9 × 7 s are the first that exceed 60 s";
}

TEST_F(DeviceLogin, EndsWhenTheUserRefuses) {
  Answer("access_denied");
  EXPECT_EQ(Failed().first, ExitCode::kAuth);
}

TEST_F(DeviceLogin, TellsWhatTheProviderMinds) {
  answers_ = {{400, {{"error", "invalid_client"}, {"error_description", "who?\x1b[2J"}}}};
  EXPECT_THAT(Failed().second, HasSubstr("invalid_client: who??[2J"));
}

TEST_F(DeviceLogin, KeepsNoTokenThatTheServerCannotRead) {
  answers_ = {{200, {{"access_token", "opaque"}}}};
  EXPECT_THAT(Failed().second, HasSubstr("--id-token"));
  request_.id_token = true;
  answers_ = {{200, {{"access_token", "opaque"}, {"id_token", kJwt}}}};
  EXPECT_EQ(Run().text, kJwt);
}

TEST_F(DeviceLogin, AsksNobodyWhoCouldBeSomebodyElse) {
  request_.issuer = "http://id.acme";
  EXPECT_EQ(Failed().first, ExitCode::kUsage);
  request_.issuer = kIssuer;
  provider_["token_endpoint"] = "http://id.acme/token";
  EXPECT_THAT(Failed().second, HasSubstr("is not https"));
  for (const char* url : {"http://127.0.0.1:x@evil.example/", "http://localhost.evil.example",
                          "http://127.0.0.1.evil", "https://id.acme@evil.example/",
                          "http://localhost:80@evil.example", "ftp://localhost"}) {
    provider_["token_endpoint"] = url;
    EXPECT_THAT(Failed().second, HasSubstr("is not https")) << url;
  }
  provider_["issuer"] = "https://evil.example";
  EXPECT_THAT(Failed().second, HasSubstr("calls itself https://evil.example"));
  EXPECT_TRUE(posted_.empty());
}

TEST_F(DeviceLogin, SurvivesAnswersOfAnyForm) {
  for (const json& answer : {json(), json(3), json::array(), json{{"issuer", 1}}}) {
    provider_ = answer;
    EXPECT_EQ(Failed().first, ExitCode::kRunFailed) << answer;
  }
}

}  // namespace
}  // namespace contact::cli
