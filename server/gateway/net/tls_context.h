#pragma once

#include <openssl/ssl.h>

#include <memory>
#include <string>
#include <vector>

#include "base/mutex.h"
#include "identity/tls_material.h"

namespace contact::gateway {

struct FreeSsl {
  void operator()(SSL* ssl) const { SSL_free(ssl); }
};
/// The TLS of one connection.
using Ssl = std::unique_ptr<SSL, FreeSsl>;

/// The TLS of a server, whose certificate can be replaced while it serves: TLS 1.2 and later, for
/// HTTP/2 and HTTP/1.1. No session is resumed, so that every connection is judged by what holds
/// when it begins. Thread-safe.
class TlsContext {
 public:
  /// Throws std::runtime_error if OpenSSL does not take the material, which LoadTls has checked.
  explicit TlsContext(const TlsMaterial& material);

  /// Handshakes that begin from now on use this. Connections that are open stay. Throws as the
  /// constructor, with the material as it was.
  void Replace(const TlsMaterial& material);

  /// The server's side of a connection over `fd`, before its handshake. A client without a
  /// certificate of `client_ca` will be refused if there is one.
  Ssl Make(int fd) const;

 private:
  mutable Mutex mutex_;
  std::shared_ptr<SSL_CTX> context_ ABSL_GUARDED_BY(mutex_);
};

/// The names in the client's certificate, as CertificateRules compares them; none without one.
/// After the handshake.
std::vector<std::string> NamesOf(const SSL& ssl);

}  // namespace contact::gateway
