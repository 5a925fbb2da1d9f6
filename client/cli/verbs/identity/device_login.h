#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace contact::cli {

/// Fields of an HTML form.
using Form = std::map<std::string, std::string>;

/// What a web server answered.
struct WebAnswer {
  /// The status of HTTP, such as 200.
  int status = 0;
  /// The body; null if it is no JSON.
  nlohmann::json body;
};

/// Who shall be asked, and for what.
struct LoginRequest {
  /// The identity provider: the URL that is `iss` in its tokens.
  std::string issuer;
  /// What the provider calls contactctl.
  std::string client_id;
  /// `aud` of the token, for providers that want to be told; may be empty.
  std::string audience;
  /// Words with spaces between.
  std::string scope = "openid";
  /// True to keep the ID token, false to keep the access token.
  bool id_token = false;
};

/// What the user has to do in a browser, on any machine.
struct LoginPrompt {
  /// The page to open.
  std::string uri;
  /// What to type there.
  std::string code;
  /// How long the code is valid.
  std::chrono::seconds valid{};
};

/// What a login needs from outside.
struct LoginTools {
  /// Gets the URL, or posts the form to it. Throws Failure (kUnreachable) without an answer.
  std::function<WebAnswer(const std::string& url, const Form* form)> ask;
  /// Tells the user what to do.
  std::function<void(const LoginPrompt&)> show;
  /// Waits between two questions.
  std::function<void(std::chrono::seconds)> wait;
};

/// A token that an identity provider has issued.
struct LoginToken {
  /// A JSON Web Token.
  std::string text;
  /// How long it is valid from now, if the provider says so; else 0.
  std::chrono::seconds valid{};
};

/// Has the user log in at an identity provider (OpenID Connect Discovery 1.0) in a browser while
/// this program waits for the token: the device authorization grant, RFC 8628. Throws Failure:
/// kAuth if the user or the provider refuses, kTimeout if the code expires first, kRunFailed if the
/// provider answers something else than the standards say, kUsage for an issuer that is not
/// reached over https (this machine's loopback excepted).
LoginToken LogIn(const LoginRequest& request, const LoginTools& tools);

}  // namespace contact::cli
