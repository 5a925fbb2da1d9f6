#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <thread>

#include "base/replace_file.h"
#include "cli/base/failure.h"
#include "cli/base/message.h"
#include "cli/verbs/identity/device_login.h"
#include "cli/verbs/identity/identity_commands.h"
#include "cli/verbs/identity/web.h"

namespace contact::cli {
namespace {

namespace fs = std::filesystem;

struct LoginOptions {
  LoginRequest request;
  // The authorities of the provider's certificate; empty: those of the system.
  std::string issuer_ca;
};

void Keep(const std::string& token, const std::string& file) {
  constexpr mode_t kOwnerOnly = 0600;
  std::error_code error;
  const fs::path folder = fs::path(file).parent_path();
  if (!folder.empty()) fs::create_directories(folder, error);
  error = ReplaceFile(file, token + '\n', kOwnerOnly);
  if (!error) return;
  throw Failure(ExitCode::kLocal, fmt::format("cannot write {}: {}", file, error.message()));
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
  line.SetKind(login.add_option("--issuer-ca", options->issuer_ca,
                                "Authorities of the provider's certificate. Default: the system's"),
               ValueKind::kFile);
  line.SetAction(login, options, Login);
}

}  // namespace contact::cli
