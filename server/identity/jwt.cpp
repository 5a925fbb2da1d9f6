#include "identity/jwt.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "identity/jwk.h"

namespace contact {
namespace {

using nlohmann::json;
using Seconds = std::chrono::duration<double>;

// More than any token of ours has; metadata has a limit of its own.
constexpr std::size_t kMostBytes = 16'384;
// Clocks of two machines may differ by so much.
constexpr Seconds kLeeway{30};
constexpr const char* kNoToken = "the token is no JSON Web Token";

std::optional<double> Number(const json& object, const char* name) {
  const auto found = object.find(name);
  if (found == object.end() || !found->is_number()) return std::nullopt;
  return found->get<double>();
}

// An object that is encoded as a part of a token.
std::optional<json> Object(std::string_view part) {
  const std::optional<std::string> text = FromBase64Url(part);
  if (!text) return std::nullopt;
  json object = json::parse(*text, nullptr, false);
  if (!object.is_object()) return std::nullopt;
  return object;
}

// What ends at the next point; all of it, and nothing left, if there is none.
std::string_view TakePart(std::string_view* token) {
  const std::size_t point = std::min(token->find('.'), token->size());
  const std::string_view part = token->substr(0, point);
  token->remove_prefix(std::min(point + 1, token->size()));
  return part;
}

// True if `aud` is, or holds, the audience.
bool IsFor(const json& claims, const std::string& audience) {
  const auto found = claims.find("aud");
  if (found == claims.end()) return false;
  if (found->is_string()) return *found == audience;
  return found->is_array() && std::ranges::find(*found, json(audience)) != found->end();
}

// The roles of a claim, of those that there are.
std::set<Role> RolesOf(const json& claims, const std::string& name) {
  std::vector<std::string> words;
  if (const auto found = claims.find(name); found != claims.end() && found->is_array()) {
    for (const json& word : *found) {
      if (word.is_string()) words.push_back(word);
    }
  }
  std::string text = TextMember(claims, name) + ' ';
  for (std::size_t end = text.find(' '); end != std::string::npos; end = text.find(' ')) {
    words.push_back(text.substr(0, end));
    text.erase(0, end + 1);
  }
  std::set<Role> roles;
  for (const std::string& word : words) {
    // What a provider signs is of a tenant, and never of the whole server.
    const auto role = FindRole(word);
    if (role && *role != Role::kServer) roles.insert(*role);
  }
  return roles;
}

// Why the claims are not good now; empty if they are.
std::string Mistake(const json& claims, const JwtPolicy& policy,
                    std::chrono::system_clock::time_point now) {
  const Seconds time = now.time_since_epoch();
  const std::optional<double> end = Number(claims, "exp"), begin = Number(claims, "nbf");
  if (TextMember(claims, "iss") != policy.issuer) return "the token has another issuer";
  if (!IsFor(claims, policy.audience)) return "the token is for another audience";
  if (!end) return "the token has no end";
  if (!(time < Seconds(*end) + kLeeway)) return "the token has expired";
  if (begin && !(time >= Seconds(*begin) - kLeeway)) return "the token is not valid yet";
  return "";
}

// Whom the claims name; words if that is nobody.
std::variant<Principal, std::string> Holder(const json& claims, const JwtPolicy& policy) {
  Principal holder{.name = TextMember(claims, policy.user_claim),
                   .tenant = TextMember(claims, policy.tenant_claim),
                   .roles = RolesOf(claims, policy.roles_claim),
                   .how = "jwt"};
  if (holder.roles.empty()) return "the token has no role";
  std::string mistake;
  const std::optional<Principal> read = ParsePrincipal(FormatPrincipal(holder), &mistake);
  // Names with spaces in them would read as something else.
  if (!read || read->name != holder.name || read->tenant != holder.tenant) {
    return "the token has no user and tenant with a name";
  }
  return holder;
}

}  // namespace

std::variant<JwtVerifier, std::string> JwtVerifier::Parse(const std::string& jwks,
                                                          JwtPolicy policy) {
  const json set = json::parse(jwks, nullptr, false);
  if (!set.is_object() || !set.contains("keys") || !set["keys"].is_array()) {
    return "is no set of keys: {\"keys\": [...]}";
  }
  JwtVerifier verifier;
  verifier.policy_ = std::move(policy);
  for (const json& entry : set["keys"]) {
    if (!entry.is_object()) return "has a key that is no object";
    if (entry.contains("use") && TextMember(entry, "use") != "sig") continue;
    std::optional<Jwk> key = ReadJwk(entry);
    const std::string kid = TextMember(entry, "kid");
    if (!key || kid.empty()) continue;
    if (entry.contains("alg") && TextMember(entry, "alg") != key->algorithm) continue;
    if (!verifier.keys_.try_emplace(kid, Key{key->algorithm, std::move(key->key)}).second) {
      return "has two keys with kid '" + kid + "'";
    }
  }
  if (verifier.keys_.empty()) return "has no key with kid for RS256, ES256 or EdDSA";
  return verifier;
}

std::variant<Principal, std::string> JwtVerifier::Verify(
    const std::string& token, std::chrono::system_clock::time_point now) const {
  if (token.size() > kMostBytes) return "the token is too long";
  std::string_view rest = token;
  const std::string_view head = TakePart(&rest), body = TakePart(&rest);
  if (std::string mistake = MistakeInSignature(head, body, rest); !mistake.empty()) return mistake;
  const std::optional<json> claims = Object(body);
  if (!claims) return kNoToken;
  if (std::string mistake = Mistake(*claims, policy_, now); !mistake.empty()) return mistake;
  return Holder(*claims, policy_);
}

std::string JwtVerifier::MistakeInSignature(std::string_view head, std::string_view body,
                                            std::string_view signature) const {
  const std::optional<json> header = Object(head);
  const std::optional<std::string> bytes = FromBase64Url(signature);
  if (!header || !bytes) return kNoToken;
  const auto key = keys_.find(TextMember(*header, "kid"));
  if (key == keys_.end()) return "the token is signed with a key that is not known";
  // The key says which algorithm: what the token says may be forged.
  if (TextMember(*header, "alg") != key->second.algorithm) return "the token has another algorithm";
  if (header->contains("crit")) return "the token asks for an extension";
  const std::string signed_part = std::string(head) + '.' + std::string(body);
  return IsSignedBy(key->second.key.get(), key->second.algorithm, signed_part, *bytes)
             ? ""
             : "the signature of the token is wrong";
}

}  // namespace contact
