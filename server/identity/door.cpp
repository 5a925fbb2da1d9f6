#include "identity/door.h"

#include <optional>
#include <string_view>

namespace contact {
namespace {

constexpr std::string_view kBearer = "Bearer ";

// The caller, or why it is not known.
using Known = std::variant<Principal, std::string>;

Known ByToken(const std::vector<std::string>& authorization, const TokenTable* tokens,
              const JwtVerifier* jwt, std::chrono::system_clock::time_point now) {
  if (authorization.size() != 1 || !authorization.front().starts_with(kBearer)) {
    return "authorization must be one 'Bearer TOKEN'";
  }
  const std::string token = authorization.front().substr(kBearer.size());
  // Ours have no points, JSON Web Tokens have two.
  const bool is_ours = jwt == nullptr || token.find('.') == std::string::npos;
  if (is_ours && tokens == nullptr) return "the token is not known here";
  if (is_ours) return tokens->Find(token, now);
  return jwt->Verify(token, now);
}

Known ByProxy(const std::vector<std::string>& named) {
  std::string mistake = "the proxy must name the caller in one " + std::string(kPrincipalHeader);
  std::optional<Principal> principal;
  if (named.size() == 1) principal = ParsePrincipal(named.front(), &mistake);
  if (!principal) return mistake;
  principal->how = "proxy";
  return *principal;
}

Known BySource(const Presented& presented, const IdentitySource& source,
               std::chrono::system_clock::time_point now) {
  const auto tokens = source.tokens();
  const auto jwt = source.jwt();
  if ((tokens || jwt) && !presented.authorization.empty()) {
    return ByToken(presented.authorization, tokens.get(), jwt.get(), now);
  }
  const auto rules = source.rules();
  if (rules && !presented.certificate.empty()) {
    if (auto principal = rules->Find(presented.certificate)) return *std::move(principal);
    return "no rule of this server knows the client certificate";
  }
  return "this server asks who calls; show a token or a client certificate";
}

}  // namespace

std::variant<Principal, std::string> Door::Identify(
    const Presented& presented, std::chrono::system_clock::time_point now) const {
  if (const auto* everybody = std::get_if<Principal>(&who_)) return *everybody;
  if (std::holds_alternative<TrustedProxy>(who_)) return ByProxy(presented.principal);
  return BySource(presented, *std::get<std::shared_ptr<const IdentitySource>>(who_), now);
}

}  // namespace contact
