#pragma once

#include <grpcpp/security/credentials.h>

#include <memory>

#include "cli/link/client.h"
#include "cli/settings/settings.h"

namespace contact::cli {

/// A client of the server that the settings name, with their time limit for calls. Connects in the
/// background. Throws Failure (kUsage) if the name is no HOST:PORT, and as CredentialsOf. Answers
/// that become JSON come as they were sent, because JSON escapes what steers a terminal.
Client Connect(const Settings& settings);

/// How the client and the server of the settings know each other: by TLS if a file of --tls-ca,
/// --cert or --key is named, by the token in --token-file if that is named. Throws Failure (kLocal)
/// if a file cannot be read, or if others may read key or token; (kUsage) for a token that would go
/// over the network unencrypted.
std::shared_ptr<grpc::ChannelCredentials> CredentialsOf(const Settings& settings);

}  // namespace contact::cli
