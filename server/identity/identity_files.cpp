#include "identity/identity_files.h"

#include <fmt/format.h>
#include <pthread.h>
#include <spdlog/spdlog.h>

#include <condition_variable>
#include <mutex>
#include <utility>

#include "base/ids.h"
#include "identity/secret_file.h"
#include "identity/token_changes.h"

namespace contact {
namespace {

namespace fs = std::filesystem;

// Reads a file and parses it, with `more` beside its text; the mistake names the file.
template <class T, class Read, class... More>
std::variant<T, std::string> Load(const fs::path& file, Read read, const More&... more) {
  std::string text, mistake;
  if (!read(file, &text, &mistake)) return mistake;
  auto parsed = T::Parse(text, more...);
  if (const auto* wrong = std::get_if<std::string>(&parsed)) {
    return fmt::format("{}: {}", file.string(), *wrong);
  }
  return parsed;
}

}  // namespace

IdentityFiles::IdentityFiles(IdentityPaths all, TlsChanged changed, Noted note, const Clock& clock)
    : paths_(std::move(all)), changed_(std::move(changed)), note_(std::move(note)), clock_(clock) {
  const IdentityPaths& paths = paths_;
  if (!paths.tokens.empty()) {
    tokens_.emplace(std::vector{paths.tokens},
                    [file = paths.tokens] { return Load<TokenTable>(file, ReadSecretFile); });
  }
  if (!paths.rules.empty()) {
    rules_.emplace(std::vector{paths.rules},
                   [file = paths.rules] { return Load<CertificateRules>(file, ReadTrustedFile); });
  }
  if (!paths.jwt_keys.empty()) {
    jwt_.emplace(std::vector{paths.jwt_keys}, [file = paths.jwt_keys, policy = paths.jwt] {
      return Load<JwtVerifier>(file, ReadTrustedFile, policy);
    });
  }
  const TlsPaths& tls = paths.tls;
  if (tls.certificate.empty()) return;
  tls_.emplace(std::vector{tls.certificate, tls.key, tls.client_ca, tls.crl},
               [tls, &clock] { return LoadTls(tls, clock.Now()); });
}

std::variant<std::shared_ptr<IdentityFiles>, std::string> IdentityFiles::Open(
    const IdentityPaths& paths, TlsChanged changed, Noted note, const Clock& clock,
    std::chrono::milliseconds period) {
  std::shared_ptr<IdentityFiles> files(
      new IdentityFiles(paths, std::move(changed), std::move(note), clock));
  if (const std::string mistakes = files->Look(); !mistakes.empty()) return mistakes;
  files->thread_ = std::jthread(
      [self = files.get(), period](const std::stop_token& stop) { self->Follow(stop, period); });
  return files;
}

IdentityFiles::~IdentityFiles() = default;

void IdentityFiles::Follow(const std::stop_token& stop, std::chrono::milliseconds period) {
  pthread_setname_np(pthread_self(), "identity");
  std::mutex mutex;
  std::unique_lock lock(mutex);
  std::condition_variable_any never;
  while (!never.wait_for(lock, stop, period, [&stop] { return stop.stop_requested(); })) {
    const std::string mistakes = Look();
    if (!mistakes.empty()) spdlog::error("{}; what was read before stays in use", mistakes);
  }
}

std::string IdentityFiles::Look() {
  std::string mistakes;
  const auto look = [&mistakes](auto& file, const auto& changed) {
    if (!file) return;
    const auto before = file->value();
    const std::string mistake = file->Look();
    if (!mistakes.empty() && !mistake.empty()) mistakes += "; ";
    mistakes += mistake;
    if (const auto now = file->value(); now && now != before) changed(before.get(), *now);
  };
  look(tokens_, [this](const TokenTable* before, const TokenTable& now) {
    for (AuditRecord& record : TokenChanges(before, now, paths_.tokens.string(), clock_.Now())) {
      note_(std::move(record));
    }
  });
  look(rules_, [this](const auto* before, const auto& /*now*/) {
    if (before != nullptr) NoteChange("rules", paths_.rules);
  });
  look(jwt_, [this](const auto* before, const auto& /*now*/) {
    if (before != nullptr) NoteChange("keys", paths_.jwt_keys);
  });
  look(tls_, [this](const TlsMaterial* before, const TlsMaterial& now) {
    changed_(now);
    if (before == nullptr) return;
    spdlog::info("the certificate was read again");
    NoteChange("tls", paths_.tls.certificate);
  });
  return mistakes;
}

void IdentityFiles::NoteChange(const char* what, const fs::path& file) const {
  note_({.time = clock_.Now(),
         .call = RandomIds().NextId(),
         .caller = {},
         .peer = "file:" + file.string(),
         .method = what,
         .job = {},
         .code = "CHANGED",
         .reason = {}});
}

std::shared_ptr<const TokenTable> IdentityFiles::tokens() const {
  return tokens_ ? tokens_->value() : nullptr;
}

std::shared_ptr<const CertificateRules> IdentityFiles::rules() const {
  return rules_ ? rules_->value() : nullptr;
}

std::shared_ptr<const JwtVerifier> IdentityFiles::jwt() const {
  return jwt_ ? jwt_->value() : nullptr;
}

std::int64_t IdentityFiles::tls_failures() const { return tls_ ? tls_->failures() : 0; }

std::int64_t IdentityFiles::failures() const {
  return (tokens_ ? tokens_->failures() : 0) + (rules_ ? rules_->failures() : 0) +
         (jwt_ ? jwt_->failures() : 0);
}

std::optional<std::chrono::system_clock::time_point> IdentityFiles::not_after() const {
  const auto tls = tls_ ? tls_->value() : nullptr;
  if (!tls) return std::nullopt;
  return tls->not_after;
}

}  // namespace contact
