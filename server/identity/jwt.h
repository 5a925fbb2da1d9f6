#pragma once

#include <openssl/evp.h>

#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <variant>

#include "identity/principal.h"

namespace contact {

/// Which JSON Web Tokens are taken, and what they say of their holder.
struct JwtPolicy {
  /// `iss` of each token.
  std::string issuer;
  /// `aud` of each token, or one of several.
  std::string audience;
  /// Claims with the name, the tenant and the roles of the holder. Roles are a list, or words with
  /// spaces between; those that are no Role are left aside.
  std::string user_claim = "sub";
  std::string tenant_claim = "tenant";
  std::string roles_claim = "roles";
};

/// Verifies JSON Web Tokens (RFC 7519) of an identity provider with its public keys, without asking
/// it. A token names its key (`kid`), and is signed by the algorithm of that key and no other:
/// RS256 with 2048 bits or more, ES256 or EdDSA with Ed25519. It has a beginning, if it says so,
/// and an end.
class JwtVerifier {
 public:
  /// Reads a set of keys (JWKS, RFC 7517), which may hold others that are not for signing or have
  /// other algorithms. Words about the mistake, if it cannot, or no key is left.
  static std::variant<JwtVerifier, std::string> Parse(const std::string& jwks, JwtPolicy policy);

  /// The holder of the token; words that say why it is refused, which hold nothing of it.
  std::variant<Principal, std::string> Verify(const std::string& token,
                                              std::chrono::system_clock::time_point now) const;

 private:
  struct Key {
    std::string algorithm;
    std::shared_ptr<EVP_PKEY> key;
  };

  /// Why the parts of a token are not signed with a key of these; empty if they are.
  std::string MistakeInSignature(std::string_view head, std::string_view body,
                                 std::string_view signature) const;

  JwtPolicy policy_;
  /// By `kid`.
  std::map<std::string, Key, std::less<>> keys_;
};

}  // namespace contact
