#include "identity/token_table.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <openssl/crypto.h>
#include <openssl/rand.h>

#include <algorithm>
#include <ctime>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "base/digest.h"
#include "identity/hex.h"
#include "identity/lines.h"

namespace contact {
namespace {

using std::chrono::system_clock;

constexpr std::string_view kPrefix = "ctk_";
constexpr std::string_view kDigits =
    "0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
constexpr std::size_t kIdDigits = 8;
constexpr std::size_t kSecretDigits = 43;  // 256 bits.

// Random digits, all equally likely.
std::string RandomDigits(std::size_t count) {
  constexpr unsigned kFair = 256 / 62 * 62;
  std::string digits;
  while (digits.size() < count) {
    unsigned char byte = 0;
    if (RAND_bytes(&byte, 1) != 1) throw std::runtime_error("OpenSSL has no random numbers");
    if (byte < kFair) digits += kDigits[byte % kDigits.size()];
  }
  return digits;
}

std::optional<system_clock::time_point> ParseUtc(const std::string& text) {
  std::tm time = {};
  const char* end = strptime(text.c_str(), "%Y-%m-%dT%H:%M:%SZ", &time);
  if (end == nullptr || *end != '\0') return std::nullopt;
  // Years that a time point holds, from 1970 to 2199.
  if (time.tm_year < 70 || time.tm_year >= 300) return std::nullopt;
  return system_clock::from_time_t(timegm(&time));
}

// The id in a token; empty if it is none.
std::string IdOf(std::string_view token) {
  if (token.size() != kPrefix.size() + kIdDigits + 1 + kSecretDigits) return "";
  if (!token.starts_with(kPrefix) || token[kPrefix.size() + kIdDigits] != '_') return "";
  return std::string(token.substr(kPrefix.size(), kIdDigits));
}

bool IsSame(const std::string& left, const std::string& right) {
  return left.size() == right.size() && CRYPTO_memcmp(left.data(), right.data(), left.size()) == 0;
}

std::optional<TokenRecord> ParseRecord(const std::string& line, std::string* mistake) {
  *mistake = "a token is 'ID SHA256 TIME valid|revoked user:NAME tenant:NAME roles:ROLE'";
  TokenRecord record;
  std::string time, state, principal;
  std::istringstream words(line);
  words >> record.id >> record.sha256 >> time >> state;
  std::getline(words, principal);
  const auto expires = ParseUtc(time);
  const bool valid = state == "valid";
  if (record.sha256.size() != 64 || !expires || (!valid && state != "revoked")) return std::nullopt;
  const auto whose = ParsePrincipal(principal, mistake);
  if (!whose) return std::nullopt;
  record.expires = *expires;
  record.revoked = !valid;
  record.principal = *whose;
  record.principal.how = "token";
  record.principal.token_id = record.id;
  return record;
}

}  // namespace

std::string FormatUtc(system_clock::time_point time) {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(system_clock::to_time_t(time)));
}

NewToken MakeToken(const Principal& principal, system_clock::time_point expires) {
  NewToken made;
  made.record.id = RandomDigits(kIdDigits);
  made.token = fmt::format("{}{}_{}", kPrefix, made.record.id, RandomDigits(kSecretDigits));
  made.record.sha256 = Sha256Hex(made.token);
  made.record.expires = expires;
  made.record.principal = principal;
  return made;
}

std::variant<TokenTable, std::string> TokenTable::Parse(const std::string& text) {
  TokenTable table;
  std::string first = ReadLines(text, [&](const std::string& line) -> std::string {
    std::string mistake;
    auto record = ParseRecord(line, &mistake);
    if (!record) return mistake;
    if (!table.places_.emplace(record->id, table.records_.size()).second) {
      return fmt::format("the id {} stands there twice", record->id);
    }
    table.records_.push_back(*std::move(record));
    return "";
  });
  if (!first.empty()) return first;
  return table;
}

std::string TokenTable::Format(const std::vector<TokenRecord>& records) {
  std::string text = "# Tokens of contactd. contactctl server token changes this file.\n";
  for (const TokenRecord& record : records) {
    text += fmt::format("{} {} {} {} {}\n", record.id, record.sha256, FormatUtc(record.expires),
                        record.revoked ? "revoked" : "valid", FormatPrincipal(record.principal));
  }
  return text;
}

std::variant<Principal, std::string> TokenTable::Find(const std::string& token,
                                                      system_clock::time_point now) const {
  const auto place = places_.find(IdOf(token));
  const std::string digest = Sha256Hex(token);
  if (place == places_.end() || !IsSame(digest, records_[place->second].sha256)) {
    return "the token is not known here";
  }
  const TokenRecord& record = records_[place->second];
  if (record.revoked) return fmt::format("the token {} was revoked", record.id);
  if (record.expires <= now) {
    return fmt::format("the token {} expired at {}", record.id, FormatUtc(record.expires));
  }
  return record.principal;
}

}  // namespace contact
