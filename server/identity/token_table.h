#pragma once

#include <chrono>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "identity/principal.h"

namespace contact {

/// What a server keeps of a token: not the token itself.
struct TokenRecord {
  /// Its public part.
  std::string id;
  /// SHA-256 of the whole token, 64 hexadecimal digits. A token has 256 random bits, so nothing
  /// slower is needed.
  std::string sha256;
  /// From then on the token is not valid. Whole seconds.
  std::chrono::system_clock::time_point expires;
  bool revoked = false;
  /// Whose the token is.
  Principal principal;
};

/// A new token and what a server keeps of it.
struct NewToken {
  /// `ctk_ID_SECRET`, to be shown once.
  std::string token;
  TokenRecord record;
};
/// Makes a token of 256 random bits for the principal.
NewToken MakeToken(const Principal& principal, std::chrono::system_clock::time_point expires);

/// The tokens of a server. A file has one a line, `#` begins a comment:
///   ID SHA256 2027-02-21T03:00:00Z valid|revoked user:NAME tenant:NAME roles:ROLE[,ROLE…]
class TokenTable {
 public:
  /// Reads the text of a file; words about the first mistake, with its line, if it cannot.
  static std::variant<TokenTable, std::string> Parse(const std::string& text);
  /// The text of a file with these tokens.
  static std::string Format(const std::vector<TokenRecord>& records);

  /// The principal of the token; words that say why there is none. They do not tell whether an id
  /// is known to who does not hold its token.
  std::variant<Principal, std::string> Find(const std::string& token,
                                            std::chrono::system_clock::time_point now) const;

  /// All tokens, in the order of their lines.
  const std::vector<TokenRecord>& records() const { return records_; }

 private:
  std::vector<TokenRecord> records_;
  /// Places in records_ by id.
  std::map<std::string, std::size_t> places_;
};

/// A time such as 2027-02-21T03:00:00Z.
std::string FormatUtc(std::chrono::system_clock::time_point time);

}  // namespace contact
