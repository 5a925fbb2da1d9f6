#include "identity/tls_material.h"

#include <fmt/format.h>
#include <openssl/bio.h>
#include <openssl/pem.h>
#include <openssl/x509.h>

#include <ctime>
#include <memory>

#include "identity/secret_file.h"
#include "identity/token_table.h"

namespace contact {
namespace {

using std::chrono::system_clock;
using Certificate = std::unique_ptr<X509, decltype(&X509_free)>;
using List = std::unique_ptr<X509_CRL, decltype(&X509_CRL_free)>;
using Key = std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)>;
using Memory = std::unique_ptr<BIO, decltype(&BIO_free_all)>;

Memory Open(const std::string& pem) {
  return {BIO_new_mem_buf(pem.data(), static_cast<int>(pem.size())), &BIO_free_all};
}

Certificate FirstCertificate(const std::string& pem) {
  return {PEM_read_bio_X509(Open(pem).get(), nullptr, nullptr, nullptr), &X509_free};
}

// A key with a password is none: nobody could type it.
Key ReadKey(const std::string& pem) {
  const auto refuse = [](char*, int, int, void*) { return 0; };
  return {PEM_read_bio_PrivateKey(Open(pem).get(), nullptr, refuse, nullptr), &EVP_PKEY_free};
}

system_clock::time_point ToTime(const ASN1_TIME* time) {
  std::tm parts = {};
  ASN1_TIME_to_tm(time, &parts);
  return system_clock::from_time_t(timegm(&parts));
}

std::string MistakeOfList(const std::filesystem::path& path, const std::string& pem,
                          system_clock::time_point now) {
  const Memory lists = Open(pem);
  int count = 0;
  while (const List list{PEM_read_bio_X509_CRL(lists.get(), nullptr, nullptr, nullptr),
                         &X509_CRL_free}) {
    const ASN1_TIME* end = X509_CRL_get0_nextUpdate(list.get());
    if (end != nullptr && now >= ToTime(end)) {
      return fmt::format("{} was to be replaced by {}", path.string(), FormatUtc(ToTime(end)));
    }
    ++count;
  }
  return count > 0 ? "" : path.string() + " holds no list of revoked certificates";
}

std::string MistakeOf(const TlsPaths& paths, const TlsMaterial& material,
                      system_clock::time_point now) {
  const Certificate certificate = FirstCertificate(material.certificate);
  if (!certificate) return paths.certificate.string() + " holds no certificate";
  const Key key = ReadKey(material.key);
  if (!key) return paths.key.string() + " holds no private key without password";
  if (X509_check_private_key(certificate.get(), key.get()) != 1) {
    return fmt::format("{} is not the key of {}", paths.key.string(), paths.certificate.string());
  }
  const auto begin = ToTime(X509_get0_notBefore(certificate.get()));
  const auto end = ToTime(X509_get0_notAfter(certificate.get()));
  if (now < begin || now >= end) {
    return fmt::format("{} is valid from {} to {} only", paths.certificate.string(),
                       FormatUtc(begin), FormatUtc(end));
  }
  if (!paths.client_ca.empty() && !FirstCertificate(material.client_ca)) {
    return paths.client_ca.string() + " holds no certificate";
  }
  return paths.crl.empty() ? "" : MistakeOfList(paths.crl, material.crl, now);
}

}  // namespace

std::variant<TlsMaterial, std::string> LoadTls(const TlsPaths& paths,
                                               system_clock::time_point now) {
  TlsMaterial material;
  std::string mistake;
  if (!ReadTrustedFile(paths.certificate, &material.certificate, &mistake)) return mistake;
  if (!ReadSecretFile(paths.key, &material.key, &mistake)) return mistake;
  if (!paths.client_ca.empty() &&
      !ReadTrustedFile(paths.client_ca, &material.client_ca, &mistake)) {
    return mistake;
  }
  if (!paths.crl.empty() && !ReadTrustedFile(paths.crl, &material.crl, &mistake)) return mistake;
  mistake = MistakeOf(paths, material, now);
  if (!mistake.empty()) return mistake;
  material.not_after = ToTime(X509_get0_notAfter(FirstCertificate(material.certificate).get()));
  return material;
}

}  // namespace contact
