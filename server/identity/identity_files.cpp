#include "identity/identity_files.h"

#include <fmt/format.h>
#include <pthread.h>
#include <spdlog/spdlog.h>

#include <condition_variable>
#include <mutex>
#include <utility>

#include "identity/secret_file.h"

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

IdentityFiles::IdentityFiles(const IdentityPaths& paths, TlsChanged changed,
                             TokensChanged tokens_changed, const Clock& clock)
    : changed_(std::move(changed)), tokens_changed_(std::move(tokens_changed)) {
  if (!paths.tokens.empty()) {
    tokens_.emplace(std::vector{paths.tokens},
                    [file = paths.tokens] { return Load<TokenTable>(file, ReadSecretFile); });
  }
  if (!paths.rules.empty()) {
    rules_.emplace(std::vector{paths.rules},
                   [file = paths.rules] { return Load<CertificateRules>(file, ReadTextFile); });
  }
  if (!paths.jwt_keys.empty()) {
    jwt_.emplace(std::vector{paths.jwt_keys}, [file = paths.jwt_keys, policy = paths.jwt] {
      return Load<JwtVerifier>(file, ReadTextFile, policy);
    });
  }
  const TlsPaths& tls = paths.tls;
  if (tls.certificate.empty()) return;
  tls_.emplace(std::vector{tls.certificate, tls.key, tls.client_ca},
               [tls, &clock] { return LoadTls(tls, clock.Now()); });
}

std::variant<std::shared_ptr<IdentityFiles>, std::string> IdentityFiles::Open(
    const IdentityPaths& paths, TlsChanged changed, TokensChanged tokens_changed,
    const Clock& clock, std::chrono::milliseconds period) {
  std::shared_ptr<IdentityFiles> files(
      new IdentityFiles(paths, std::move(changed), std::move(tokens_changed), clock));
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
  const auto look = [&mistakes](auto& file) {
    const std::string mistake = file ? file->Look() : "";
    if (!mistakes.empty() && !mistake.empty()) mistakes += "; ";
    mistakes += mistake;
  };
  look(tokens_);
  look(rules_);
  look(jwt_);
  look(tls_);
  if (const auto now = tokens(); now && now != told_tokens_) {
    tokens_changed_(told_tokens_.get(), *now);
    told_tokens_ = now;
  }
  const auto tls = tls_ ? tls_->value() : nullptr;
  if (tls && tls != told_) {
    changed_(*tls);
    if (told_) spdlog::info("the certificate was read again");
    told_ = tls;
  }
  return mistakes;
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
