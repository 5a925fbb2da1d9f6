#include <fmt/format.h>
#include <httplib.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <thread>

#include "cli/base/failure.h"
#include "cli/base/files.h"
#include "cli/base/message.h"
#include "cli/settings/options.h"
#include "cli/verbs/identity/device_login.h"
#include "cli/verbs/identity/identity_commands.h"

namespace contact::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostBytes = 1 << 20;  // Of an answer.

// Where the path of a URL begins: after scheme and host.
std::size_t PathBegin(const std::string& url) {
  const std::size_t host = url.find("://");
  if (host == std::string::npos) throw Failure(ExitCode::kUsage, url + " is no URL");
  return std::min(url.find('/', host + 3), url.size());
}

// Gets `url`, or posts `form` to it if there is one; follows no redirection. The server of an https
// URL must show a certificate of the authorities in the file `ca`, or of the system's if that is
// empty. `timeout` limits connecting and each wait for data. Throws Failure: kUnreachable if there
// is no answer or one of more than 1 MiB, kUsage if `url` is no http or https URL.
WebAnswer Ask(const std::string& url, const Form* form, const std::string& ca,
              std::chrono::milliseconds timeout) {
  const std::size_t path_begin = PathBegin(url);
  const std::string server = url.substr(0, path_begin);
  const std::string path = path_begin < url.size() ? url.substr(path_begin) : "/";
  httplib::Client client(server);
  if (!client.is_valid()) throw Failure(ExitCode::kUsage, url + " is no http or https URL");
  if (!ca.empty()) client.set_ca_cert_path(ca.c_str());
  client.set_connection_timeout(timeout);
  client.set_read_timeout(timeout);
  std::string text;
  httplib::Request request;
  request.method = form == nullptr ? "GET" : "POST";
  request.path = path;
  if (form != nullptr) {
    request.body = httplib::detail::params_to_query_str({form->begin(), form->end()});
    request.headers = {{"Content-Type", "application/x-www-form-urlencoded"}};
  }
  request.content_receiver = [&text](const char* data, std::size_t size, std::uint64_t /*offset*/,
                                     std::uint64_t /*total*/) {
    text.append(data, size);
    return text.size() <= kMostBytes;
  };
  const httplib::Result result = client.send(request);
  if (!result) {
    const bool long_answer = text.size() > kMostBytes;
    throw Failure(ExitCode::kUnreachable,
                  fmt::format("{}: {}", server,
                              long_answer ? "answers with more than 1 MiB"
                                          : to_string(result.error()) + " failed"));
  }
  auto body = nlohmann::json::parse(text, nullptr, false);
  if (body.is_discarded()) body = nullptr;
  return {result->status, std::move(body)};
}

struct LoginOptions {
  LoginRequest request;
  // The authorities of the provider's certificate; empty: those of the system.
  std::string issuer_ca;
};

void Keep(const std::string& token, const std::string& file) {
  std::error_code error;  // That of the file is told.
  const fs::path folder = fs::path(file).parent_path();
  if (!folder.empty()) fs::create_directories(folder, error);
  ReplaceText(token + '\n', file, kOwnerOnly);
}

ExitCode Login(const LoginOptions& options, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable});
  if (settings.token_file.empty()) {
    throw Failure(ExitCode::kUsage,
                  "where to keep the token is not set: --token-file FILE, or once for a profile "
                  "contactctl config set token_file FILE --profile NAME");
  }
  const LoginTools tools{
      .ask =
          [&](const std::string& url, const Form* form) {
            return Ask(url, form, options.issuer_ca, settings.CallTimeout());
          },
      .show =
          [](const LoginPrompt& prompt) {
            Tell("Open {}\nand confirm the code {} within {} s\n", prompt.uri, prompt.code,
                 prompt.valid.count());
          },
      .wait = [](std::chrono::seconds time) { std::this_thread::sleep_for(time); }};
  const LoginToken token = LogIn(options.request, tools);
  Keep(token.text, settings.token_file);
  const auto valid = token.valid.count();
  Tell("logged in: {}{}\n", settings.token_file,
       valid > 0 ? fmt::format(", valid for {} s", valid) : std::string());
  return ExitCode::kOk;
}

constexpr char kAbout[] =
    R"(Logs in at an identity provider with OpenID Connect: prints the address of a page and a code,
waits until you have confirmed the code there, in a browser on any machine, and keeps the token in
the file of --token-file, which the other commands send. The server must take tokens of this
provider (--jwt-keys, --jwt-issuer, --jwt-audience). Log in again once the token has expired.)";

}  // namespace

void AddLogin(CommandLine& line, CLI::App& login) {
  auto options = std::make_shared<LoginOptions>();
  LoginRequest& request = options->request;
  login.footer(kAbout);
  login.add_option("--issuer", request.issuer, "The provider, an https:// URL")
      ->type_name("URL")
      ->required();
  login.add_option("--client-id", request.client_id, "What the provider calls contactctl")
      ->type_name("ID")
      ->required();
  login
      .add_option("--audience", request.audience,
                  "Whom the token is for, if the provider wants to be told")
      ->type_name("AUDIENCE");
  login.add_option("--scope", request.scope, "What the token shall say, words with spaces between")
      ->type_name("WORDS")
      ->capture_default_str();
  login.add_flag("--id-token", request.id_token, "Keep the ID token instead of the access token");
  AddOption(line, login, "--issuer-ca", &options->issuer_ca, ValueKind::kFile,
            "Authorities of the provider's certificate. Default: the system's");
  line.SetAction(login, options, Login);
}

}  // namespace contact::cli
