#pragma once

#include <grpcpp/security/server_credentials.h>

#include <memory>
#include <string>

#include "base/file_descriptor.h"
#include "identity/tls_material.h"

namespace contact {

/// A file in memory whose contents are replaced at once: who opens it finds the old or the new.
/// Only this process finds it, and nothing is left of it when the process is killed.
class MemoryFile {
 public:
  /// Throws std::system_error if the system has no memory for it.
  explicit MemoryFile(const std::string& contents);
  /// Throws as the constructor, with the contents as they were.
  void Replace(const std::string& contents);
  /// The name under which this process finds it.
  std::string path() const;

 private:
  FileDescriptor file_;
};

/// The TLS of a server, whose certificate can be replaced while it serves. gRPC takes certificates
/// from files only, looks at them each second, and ends the process over an empty key; so it is
/// given files in memory that hold nothing but what LoadTls has checked. Thread-safe but for
/// Replace.
class TlsCredentials {
 public:
  explicit TlsCredentials(const TlsMaterial& material);

  /// From about a second later on, handshakes use this. Connections that are open stay.
  void Replace(const TlsMaterial& material);

  /// What gRPC needs. Clients without a certificate of `client_ca` are refused if there is one.
  std::shared_ptr<grpc::ServerCredentials> Make() const;

 private:
  /// Key and certificate in one, so that they are replaced together.
  MemoryFile pair_;
  MemoryFile client_ca_;
  const bool asks_clients_;
};

}  // namespace contact
