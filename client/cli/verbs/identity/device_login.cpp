#include "cli/verbs/identity/device_login.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string/trim.hpp>
#include <string_view>

#include "base/spelling.h"
#include "cli/base/failure.h"

namespace contact::cli {
namespace {

using Json = nlohmann::json;
using std::chrono::seconds;

constexpr seconds kUsualInterval{5};  // RFC 8628, 3.2.
constexpr seconds kSlower{5};         // RFC 8628, 3.5: added at each slow_down.
constexpr seconds kLongest{3600};     // Of a wait, whatever the provider says.

// A member that is a text; empty if there is none.
std::string Text(const Json& object, const char* name) {
  if (!object.is_object()) return "";
  const auto found = object.find(name);
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

// A member that is a number of seconds.
seconds Seconds(const Json& object, const char* name, seconds otherwise) {
  const auto found = object.find(name);
  if (found == object.end() || !found->is_number()) return otherwise;
  return seconds(static_cast<seconds::rep>(
      std::clamp(found->get<double>(), 0.0, static_cast<double>(kLongest.count()))));
}

// True for a URL whose answers nobody on the way can change. One with a user before its host is
// none: people would take that for the host.
bool IsSafe(std::string_view url) {
  const bool https = url.starts_with("https://");
  if (!https && !url.starts_with("http://")) return false;
  url.remove_prefix(https ? 8 : 7);
  const std::string_view authority = url.substr(0, url.find_first_of("/?#\\"));
  if (authority.find('@') != std::string_view::npos) return false;
  const std::size_t port = authority.find_last_not_of("0123456789");
  const bool has_port = port != std::string_view::npos && authority[port] == ':';
  const std::string_view host = has_port ? authority.substr(0, port) : authority;
  return https || host == "127.0.0.1" || host == "[::1]" || host == "localhost";
}

[[noreturn]] void Refuse(const std::string& issuer, const std::string& what) {
  throw Failure(ExitCode::kRunFailed, fmt::format("{}: {}", issuer, Printable(what)));
}

// The URL that a member of an answer names.
std::string Endpoint(const std::string& issuer, const Json& answer, const char* name) {
  std::string url = Text(answer, name);
  if (url.empty()) Refuse(issuer, fmt::format("offers no {}", name));
  if (!IsSafe(url)) Refuse(issuer, fmt::format("{} {} is not https", name, url));
  return url;
}

// What the provider says of itself.
Json Discover(const LoginRequest& request, const LoginTools& tools) {
  const std::string base = boost::algorithm::trim_right_copy_if(
      request.issuer, [](char character) { return character == '/'; });
  WebAnswer answer = tools.ask(base + "/.well-known/openid-configuration", nullptr);
  if (answer.status != 200) {
    Refuse(request.issuer, fmt::format("is no identity provider: status {}", answer.status));
  }
  // Else one provider could stand in for another.
  if (Text(answer.body, "issuer") != request.issuer) {
    Refuse(request.issuer, "calls itself " + Text(answer.body, "issuer"));
  }
  return std::move(answer.body);
}

// The provider's word for an error, and what it adds.
std::string ErrorOf(const WebAnswer& answer) {
  const std::string error = Text(answer.body, "error");
  const std::string more = Text(answer.body, "error_description");
  if (error.empty()) return fmt::format("status {}", answer.status);
  return more.empty() ? error : error + ": " + more;
}

Json AskForCode(const LoginRequest& request, const LoginTools& tools, const std::string& url) {
  Form form{{"client_id", request.client_id}, {"scope", request.scope}};
  if (!request.audience.empty()) form["audience"] = request.audience;
  WebAnswer answer = tools.ask(url, &form);
  if (answer.status != 200) Refuse(request.issuer, "refuses the login: " + ErrorOf(answer));
  if (Text(answer.body, "device_code").empty() || Text(answer.body, "user_code").empty()) {
    Refuse(request.issuer, "gives no code");
  }
  return std::move(answer.body);
}

void Show(const LoginRequest& request, const LoginTools& tools, const Json& code) {
  const bool whole = !Text(code, "verification_uri_complete").empty();
  const std::string uri =
      Endpoint(request.issuer, code, whole ? "verification_uri_complete" : "verification_uri");
  tools.show({.uri = Printable(uri),
              .code = Printable(Text(code, "user_code")),
              .valid = Seconds(code, "expires_in", kLongest)});
}

// Asks until the user has logged in.
Json AwaitAnswer(const LoginRequest& request, const LoginTools& tools, const Json& code,
                 const std::string& url) {
  const Form form{{"grant_type", "urn:ietf:params:oauth:grant-type:device_code"},
                  {"device_code", Text(code, "device_code")},
                  {"client_id", request.client_id}};
  seconds interval = std::max(Seconds(code, "interval", kUsualInterval), seconds(1));
  const seconds valid = Seconds(code, "expires_in", kLongest);
  for (seconds waited{0}; waited < valid; waited += interval) {
    tools.wait(interval);
    WebAnswer answer = tools.ask(url, &form);
    if (answer.status == 200) return std::move(answer.body);
    const std::string error = Text(answer.body, "error");
    if (error == "slow_down") {
      interval += kSlower;
    } else if (error == "access_denied") {
      throw Failure(ExitCode::kAuth, "the login was refused");
    } else if (error == "expired_token") {
      break;
    } else if (error != "authorization_pending") {
      Refuse(request.issuer, "refuses the login: " + ErrorOf(answer));
    }
  }
  throw Failure(ExitCode::kTimeout, "nobody logged in before the code expired");
}

bool IsJwt(std::string_view token) {
  return std::ranges::count(token, '.') == 2 && std::ranges::all_of(token, [](char c) {
           return c == '.' || c == '-' || c == '_' || (c >= '0' && c <= '9') ||
                  (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
         });
}

}  // namespace

LoginToken LogIn(const LoginRequest& request, const LoginTools& tools) {
  if (!IsSafe(request.issuer)) {
    throw Failure(ExitCode::kUsage, "--issuer: is the https:// URL of an identity provider");
  }
  const Json provider = Discover(request, tools);
  const std::string codes = Endpoint(request.issuer, provider, "device_authorization_endpoint");
  const std::string tokens = Endpoint(request.issuer, provider, "token_endpoint");
  const Json code = AskForCode(request, tools, codes);
  Show(request, tools, code);
  const Json answer = AwaitAnswer(request, tools, code, tokens);
  LoginToken token{.text = Text(answer, request.id_token ? "id_token" : "access_token"),
                   .valid = Seconds(answer, "expires_in", seconds(0))};
  if (!IsJwt(token.text)) {
    Refuse(request.issuer, request.id_token
                               ? "gives no ID token; --scope must have the word openid"
                               : "gives an access token that is no JSON Web Token; --audience may "
                                 "change that, or --id-token keeps the ID token instead");
  }
  return token;
}

}  // namespace contact::cli
