// Text of a tokens file, of a rules file or of a key set, then, after a NUL, what a caller shows:
// it is known or not, and what was parsed can be written and parsed again.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <variant>

#include "identity/certificate_rules.h"
#include "identity/jwt.h"
#include "identity/token_table.h"

namespace {

const std::chrono::system_clock::time_point kNow{std::chrono::seconds(1'800'000'000)};

void TryTokens(const std::string& text, const std::string& shown) {
  const auto parsed = contact::TokenTable::Parse(text);
  const auto* table = std::get_if<contact::TokenTable>(&parsed);
  if (table == nullptr) return;
  table->Find(shown, kNow);
  const auto again = contact::TokenTable::Parse(contact::TokenTable::Format(table->records()));
  if (!std::holds_alternative<contact::TokenTable>(again)) std::abort();
}

void TryRules(const std::string& text, const std::string& shown) {
  const auto parsed = contact::CertificateRules::Parse(text);
  if (const auto* rules = std::get_if<contact::CertificateRules>(&parsed)) rules->Find({shown});
}

void TryKeys(const std::string& text, const std::string& shown) {
  const auto parsed = contact::JwtVerifier::Parse(text, {"issuer", "audience"});
  const auto* verifier = std::get_if<contact::JwtVerifier>(&parsed);
  // Nobody can guess a signature.
  if (verifier && std::holds_alternative<contact::Principal>(verifier->Verify(shown, kNow))) {
    std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string input(reinterpret_cast<const char*>(data), size);
  const std::size_t end = std::min(input.find('\0'), size);
  const std::string text = input.substr(0, end);
  const std::string shown = input.substr(std::min(end + 1, size));
  TryTokens(text, shown);
  TryRules(text, shown);
  TryKeys(text, shown);
  return 0;
}
