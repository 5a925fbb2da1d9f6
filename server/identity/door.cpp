#include "identity/door.h"

#include <string_view>

namespace contact {
namespace {

constexpr std::string_view kBearer = "Bearer ";

std::variant<Principal, std::string> ByToken(const std::vector<std::string>& authorization,
                                             const TokenTable* tokens, const JwtVerifier* jwt,
                                             std::chrono::system_clock::time_point now) {
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

}  // namespace

std::variant<Principal, std::string> Door::Identify(
    const Presented& presented, std::chrono::system_clock::time_point now) const {
  if (everybody_) return *everybody_;
  const auto tokens = source_->tokens();
  const auto jwt = source_->jwt();
  if ((tokens || jwt) && !presented.authorization.empty()) {
    return ByToken(presented.authorization, tokens.get(), jwt.get(), now);
  }
  const auto rules = source_->rules();
  if (rules && !presented.certificate.empty()) {
    if (auto principal = rules->Find(presented.certificate)) return *std::move(principal);
    return "no rule of this server knows the client certificate";
  }
  return "this server asks who calls; show a token or a client certificate";
}

}  // namespace contact
