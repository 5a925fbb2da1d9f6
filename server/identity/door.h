#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "identity/certificate_rules.h"
#include "identity/jwt.h"
#include "identity/principal.h"
#include "identity/token_table.h"

namespace contact {

/// What a caller shows of itself.
struct Presented {
  /// The values of the metadata `authorization`. Secret.
  std::vector<std::string> authorization = {};
  /// Names in the client certificate, which TLS has verified; see CertificateRules.
  std::vector<std::string> certificate = {};
  /// The values of the metadata kPrincipalHeader.
  std::vector<std::string> principal = {};
};

/// The metadata by which a trusted proxy says who calls, as ParsePrincipal reads it.
inline constexpr char kPrincipalHeader[] = "x-contactd-principal";

/// Marks a listener whose only user is a proxy that has found out who calls.
struct TrustedProxy {};

/// Where a listener has its tokens and rules from. Thread-safe.
class IdentitySource {
 public:
  virtual ~IdentitySource() = default;
  /// The tokens that are valid now; null: none are taken.
  virtual std::shared_ptr<const TokenTable> tokens() const = 0;
  /// The rules for certificates; null: none.
  virtual std::shared_ptr<const CertificateRules> rules() const = 0;
  /// What verifies JSON Web Tokens; null: none are taken.
  virtual std::shared_ptr<const JwtVerifier> jwt() const { return nullptr; }
};

/// Decides who comes in through one listener. Thread-safe.
class Door {
 public:
  /// Everybody who comes in here is `everybody`.
  explicit Door(Principal everybody = LocalPrincipal()) : who_(std::move(everybody)) {}
  /// Only those come in whom the source knows.
  explicit Door(std::shared_ptr<const IdentitySource> source) : who_(std::move(source)) {}
  /// Those come in whom the proxy names.
  explicit Door(TrustedProxy proxy) : who_(proxy) {}

  /// False if everybody comes in, whatever is presented.
  bool asks() const { return !std::holds_alternative<Principal>(who_); }

  /// The caller, or words that say why it is not known; they hold no secret. A token decides if one
  /// is shown and tokens are taken, ours or JSON Web Tokens, then the certificate. A token that is
  /// not valid is refused, whatever else is shown.
  std::variant<Principal, std::string> Identify(const Presented& presented,
                                                std::chrono::system_clock::time_point now) const;

 private:
  std::variant<Principal, std::shared_ptr<const IdentitySource>, TrustedProxy> who_;
};

}  // namespace contact
