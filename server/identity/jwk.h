#pragma once

#include <openssl/evp.h>

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace contact {

/// The bytes of a text in base64url without padding (RFC 4648, section 5); nothing if it is none.
std::optional<std::string> FromBase64Url(std::string_view text);

/// A member of an object that is a text; empty if it is not there or something else.
std::string TextMember(const nlohmann::json& object, const std::string& name);

/// A public key to verify signatures with.
struct Jwk {
  /// `RS256`, `ES256` or `EdDSA`, as the kind of the key allows.
  std::string algorithm;
  std::shared_ptr<EVP_PKEY> key;
};

/// Reads a JSON Web Key (RFC 7517, 7518, 8037): RSA of 2048 bits or more, P-256, or Ed25519.
/// Nothing for another kind, or if it is none.
std::optional<Jwk> ReadJwk(const nlohmann::json& object);

/// True if the signature is that of the text by the key, in the form of RFC 7518.
bool IsSignedBy(EVP_PKEY* key, const std::string& algorithm, std::string_view text,
                const std::string& signature);

}  // namespace contact
