#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <variant>

#include "base/clock.h"
#include "identity/audit_log.h"
#include "identity/door.h"
#include "identity/reloaded.h"
#include "identity/tls_material.h"

namespace contact {

/// The files that say who may come in, each empty if the server has none.
struct IdentityPaths {
  /// See TokenTable. Others must not be able to read it.
  std::filesystem::path tokens = {};
  /// See CertificateRules.
  std::filesystem::path rules = {};
  /// Keys of an identity provider, see JwtVerifier.
  std::filesystem::path jwt_keys = {};
  JwtPolicy jwt = {};
  TlsPaths tls = {};
};

/// Follows these files on a thread of its own: looks once a second whether they have changed. What
/// cannot be used is left aside, with one line in the log. Thread-safe.
class IdentityFiles final : public IdentitySource {
 public:
  /// Called with what TLS is to use from now on: once by Open, later on the thread.
  using TlsChanged = std::function<void(const TlsMaterial&)>;

  /// Called with what the audit log is to say of the files, as TlsChanged: what TokenChanges tells,
  /// and one record for each change of rules, keys or certificates that is used from now on.
  using Noted = std::function<void(AuditRecord)>;

  /// Reads the files, and follows them by looking once a `period`; words about the first mistake if
  /// one cannot be used. The clock outlives the files.
  static std::variant<std::shared_ptr<IdentityFiles>, std::string> Open(
      const IdentityPaths& paths, TlsChanged changed, Noted note,
      const Clock& clock = SystemClock(),
      std::chrono::milliseconds period = std::chrono::seconds(1));
  ~IdentityFiles() override;
  IdentityFiles(const IdentityFiles&) = delete;
  IdentityFiles& operator=(const IdentityFiles&) = delete;

  std::shared_ptr<const TokenTable> tokens() const override;
  std::shared_ptr<const CertificateRules> rules() const override;
  std::shared_ptr<const JwtVerifier> jwt() const override;

  /// Number of changes of the files of TLS, and of those of tokens and rules, that could not be
  /// used.
  std::int64_t tls_failures() const;
  std::int64_t failures() const;
  /// End of the server's certificate; nothing without TLS.
  std::optional<std::chrono::system_clock::time_point> not_after() const;

 private:
  IdentityFiles(IdentityPaths paths, TlsChanged changed, Noted note, const Clock& clock);
  /// Looks at all files. Returns the mistakes, a line each.
  std::string Look();
  /// Body of the thread.
  void Follow(const std::stop_token& stop, std::chrono::milliseconds period);
  /// Notes that the file, or one of those with it, has changed; `what` stands for the method.
  void NoteChange(const char* what, const std::filesystem::path& file) const;

  const IdentityPaths paths_;
  const TlsChanged changed_;
  const Noted note_;
  const Clock& clock_;
  /// Nothing if the server has no such file.
  std::optional<Reloaded<TokenTable>> tokens_;
  std::optional<Reloaded<CertificateRules>> rules_;
  std::optional<Reloaded<JwtVerifier>> jwt_;
  std::optional<Reloaded<TlsMaterial>> tls_;
  std::jthread thread_;  // Last: it uses all of the above.
};

}  // namespace contact
