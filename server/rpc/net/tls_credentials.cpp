#include "rpc/net/tls_credentials.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <grpcpp/security/tls_certificate_provider.h>
#include <grpcpp/security/tls_credentials_options.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <functional>
#include <string_view>
#include <system_error>

namespace contact {
namespace {

[[noreturn]] void Throw() { throw std::system_error(errno, std::generic_category(), "memfd"); }

FileDescriptor Make(std::string_view contents) {
  FileDescriptor file(::memfd_create("contactd", MFD_CLOEXEC));
  if (!file.valid()) Throw();
  while (!contents.empty()) {
    const ssize_t written = ::write(file.get(), contents.data(), contents.size());
    if (written <= 0) Throw();
    contents.remove_prefix(static_cast<std::size_t>(written));
  }
  return file;
}

std::string PairOf(const TlsMaterial& material) {
  return material.key + "\n" + material.certificate;
}

// What certificates must say beyond their signature is up to the rules of identity.
class AnyName final : public grpc::experimental::ExternalCertificateVerifier {
 public:
  bool Verify(grpc::experimental::TlsCustomVerificationCheckRequest* /*request*/,
              std::function<void(grpc::Status)> /*callback*/, grpc::Status* status) override {
    *status = grpc::Status::OK;
    return true;
  }
  void Cancel(grpc::experimental::TlsCustomVerificationCheckRequest* /*request*/) override {}
};

}  // namespace

MemoryFile::MemoryFile(const std::string& contents) : file_(contact::Make(contents)) {}

void MemoryFile::Replace(const std::string& contents) {
  const FileDescriptor next = contact::Make(contents);
  if (::dup3(next.get(), file_.get(), O_CLOEXEC) < 0) Throw();
}

std::string MemoryFile::path() const { return fmt::format("/proc/self/fd/{}", file_.get()); }

TlsCredentials::TlsCredentials(const TlsMaterial& material)
    : pair_(PairOf(material)),
      client_ca_(material.client_ca),
      asks_clients_(!material.client_ca.empty()) {}

void TlsCredentials::Replace(const TlsMaterial& material) {
  pair_.Replace(PairOf(material));
  if (asks_clients_) client_ca_.Replace(material.client_ca);
}

std::shared_ptr<grpc::ServerCredentials> TlsCredentials::Make() const {
  using namespace grpc::experimental;
  constexpr unsigned kRefreshSeconds = 1;
  TlsServerCredentialsOptions options(std::make_shared<FileWatcherCertificateProvider>(
      pair_.path(), pair_.path(), asks_clients_ ? client_ca_.path() : "", kRefreshSeconds));
  options.watch_identity_key_cert_pairs();
  if (asks_clients_) {
    options.watch_root_certs();
    options.set_cert_request_type(GRPC_SSL_REQUEST_AND_REQUIRE_CLIENT_CERTIFICATE_AND_VERIFY);
    options.set_certificate_verifier(ExternalCertificateVerifier::Create<AnyName>());
    options.set_check_call_host(false);
  }
  return TlsServerCredentials(options);
}

}  // namespace contact
