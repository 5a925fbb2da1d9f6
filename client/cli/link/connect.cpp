#include "cli/link/connect.h"

#include <boost/algorithm/string/trim.hpp>
#include <string>

#include "cli/base/failure.h"
#include "identity/secret_file.h"

namespace contact::cli {
namespace {

using Read = bool(const std::filesystem::path&, std::string*, std::string*);

// The text of the file that a flag names; empty without one.
std::string TextOf(const char* flag, const std::string& file, Read* read) {
  std::string text, mistake;
  if (file.empty() || read(file, &text, &mistake)) return text;
  throw Failure(ExitCode::kLocal, std::string(flag) + ": " + mistake);
}

std::shared_ptr<grpc::ChannelCredentials> Tls(const Settings& settings) {
  return grpc::SslCredentials({.pem_root_certs = TextOf("--tls-ca", settings.tls_ca, ReadTextFile),
                               .pem_private_key = TextOf("--key", settings.key, ReadSecretFile),
                               .pem_cert_chain = TextOf("--cert", settings.cert, ReadTextFile)});
}

// A token goes only over TLS, or over a socket file of this machine.
std::shared_ptr<grpc::ChannelCredentials> Channel(const Settings& settings, bool has_token) {
  const bool tls = !settings.tls_ca.empty() || !settings.cert.empty() || !settings.key.empty();
  if (settings.cert.empty() != settings.key.empty()) {
    throw Failure(ExitCode::kUsage, "--cert and --key go together");
  }
  if (tls) return Tls(settings);
  if (!has_token) return grpc::InsecureChannelCredentials();
  if (settings.server.starts_with("unix:")) return grpc::experimental::LocalCredentials(UDS);
  throw Failure(
      ExitCode::kUsage,
      "--token-file: the token would go unencrypted; --tls-ca FILE names the authority of "
      "the server's certificate");
}

}  // namespace

std::shared_ptr<grpc::ChannelCredentials> CredentialsOf(const Settings& settings) {
  std::string token = TextOf("--token-file", settings.token_file, ReadSecretFile);
  boost::algorithm::trim(token);
  auto channel = Channel(settings, !token.empty());
  if (token.empty()) return channel;
  return grpc::CompositeChannelCredentials(channel, grpc::AccessTokenCredentials(token));
}

Client Connect(const Settings& settings) {
  const bool json = settings.output == OutputFormat::kJson;
  return {settings.server, settings.CallTimeout(), CredentialsOf(settings),
          json ? Client::Answers::kAsSent : Client::Answers::kPrintable};
}

}  // namespace contact::cli
