#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "identity/principal.h"

namespace contact {

/// Says which principal a client certificate is. A file of rules has one a line, the first that
/// fits counts; `#` begins a comment:
///   cert spiffe://acme/user/*  user:$1 tenant:acme roles:submit
///   cert cn:ops                user:ops tenant:acme roles:admin
///   cert cn:mallory            nobody
/// A pattern is compared with the whole of each name in the certificate: URIs as they are, others
/// as `dns:NAME`, `email:NAME` and `cn:NAME`. `*` stands for one or more characters other than `/`;
/// `$1` to `$9` in user and tenant stand for what the first to ninth `*` stood for.
class CertificateRules {
 public:
  /// Reads the text of a file; words about the first mistake, with its line, if it cannot.
  static std::variant<CertificateRules, std::string> Parse(const std::string& text);

  /// The principal of a certificate with these names; nothing if no rule fits, or if the first that
  /// does says `nobody` or would make a name that is none.
  std::optional<Principal> Find(const std::vector<std::string>& names) const;

 private:
  struct Rule {
    /// With `*`.
    std::string pattern;
    /// As ParsePrincipal reads it, with $1 to $9; empty: nobody.
    std::string principal;
  };
  std::vector<Rule> rules_;
};

}  // namespace contact
