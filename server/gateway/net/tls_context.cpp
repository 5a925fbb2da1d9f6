#include "gateway/net/tls_context.h"

#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/x509v3.h>

#include <array>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace contact::gateway {
namespace {

using Bio = std::unique_ptr<BIO, decltype(&BIO_free_all)>;
using Certificate = std::unique_ptr<X509, decltype(&X509_free)>;
using List = std::unique_ptr<X509_CRL, decltype(&X509_CRL_free)>;

// The protocols that the server speaks, the better one first, each with its length before it.
constexpr std::string_view kProtocols("\x02h2\x08http/1.1", 12);

void Demand(bool good, const char* what) {
  if (good) return;
  std::array<char, 256> words{};
  ERR_error_string_n(ERR_get_error(), words.data(), words.size());
  ERR_clear_error();
  throw std::runtime_error(std::string("TLS: ") + what + ": " + words.data());
}

Bio Open(const std::string& pem) {
  return {BIO_new_mem_buf(pem.data(), static_cast<int>(pem.size())), &BIO_free_all};
}

Certificate Next(BIO* pem) {
  return {PEM_read_bio_X509(pem, nullptr, nullptr, nullptr), &X509_free};
}

int Choose(SSL* /*ssl*/, const unsigned char** chosen, unsigned char* size,
           const unsigned char* offered, unsigned offered_size, void* /*unused*/) {
  const auto* ours = reinterpret_cast<const unsigned char*>(kProtocols.data());
  const int found =
      SSL_select_next_proto(const_cast<unsigned char**>(chosen), size, ours,
                            static_cast<unsigned>(kProtocols.size()), offered, offered_size);
  return found == OPENSSL_NPN_NEGOTIATED ? SSL_TLSEXT_ERR_OK : SSL_TLSEXT_ERR_ALERT_FATAL;
}

void UsePair(SSL_CTX* context, const TlsMaterial& material) {
  const Bio certificates = Open(material.certificate);
  const Certificate own = Next(certificates.get());
  Demand(own && SSL_CTX_use_certificate(context, own.get()) == 1, "certificate");
  while (const Certificate issuer = Next(certificates.get())) {
    Demand(SSL_CTX_add1_chain_cert(context, issuer.get()) == 1, "certificate of an authority");
  }
  ERR_clear_error();  // The end of the text is one.
  const std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)> key(
      PEM_read_bio_PrivateKey(Open(material.key).get(), nullptr, nullptr, nullptr), &EVP_PKEY_free);
  Demand(key && SSL_CTX_use_PrivateKey(context, key.get()) == 1, "private key");
}

// What certificates must say beyond their signature is up to the rules of identity.
void AskClients(SSL_CTX* context, const TlsMaterial& material) {
  const Bio certificates = Open(material.client_ca);
  while (const Certificate authority = Next(certificates.get())) {
    Demand(X509_STORE_add_cert(SSL_CTX_get_cert_store(context), authority.get()) == 1 &&
               SSL_CTX_add_client_CA(context, authority.get()) == 1,
           "authority of clients");
  }
  X509_STORE* store = SSL_CTX_get_cert_store(context);
  const Bio lists = Open(material.crl);
  while (const List list{PEM_read_bio_X509_CRL(lists.get(), nullptr, nullptr, nullptr),
                         &X509_CRL_free}) {
    Demand(X509_STORE_add_crl(store, list.get()) == 1, "list of revoked certificates");
  }
  ERR_clear_error();
  if (!material.crl.empty()) X509_STORE_set_flags(store, X509_V_FLAG_CRL_CHECK);
  SSL_CTX_set_verify(context, SSL_VERIFY_PEER | SSL_VERIFY_FAIL_IF_NO_PEER_CERT, nullptr);
}

std::shared_ptr<SSL_CTX> MakeContext(const TlsMaterial& material) {
  std::shared_ptr<SSL_CTX> context(SSL_CTX_new(TLS_server_method()), &SSL_CTX_free);
  Demand(context != nullptr, "context");
  SSL_CTX_set_min_proto_version(context.get(), TLS1_2_VERSION);
  SSL_CTX_set_options(context.get(), SSL_OP_NO_RENEGOTIATION | SSL_OP_NO_TICKET |
                                         SSL_OP_NO_COMPRESSION | SSL_OP_CIPHER_SERVER_PREFERENCE);
  SSL_CTX_set_session_cache_mode(context.get(), SSL_SESS_CACHE_OFF);
  SSL_CTX_set_mode(context.get(), SSL_MODE_ENABLE_PARTIAL_WRITE |
                                      SSL_MODE_ACCEPT_MOVING_WRITE_BUFFER |
                                      SSL_MODE_RELEASE_BUFFERS);
  SSL_CTX_set_alpn_select_cb(context.get(), &Choose, nullptr);
  UsePair(context.get(), material);
  if (!material.client_ca.empty()) AskClients(context.get(), material);
  return context;
}

std::string_view View(const ASN1_STRING* text) {
  return {reinterpret_cast<const char*>(ASN1_STRING_get0_data(text)),
          static_cast<std::size_t>(ASN1_STRING_length(text))};
}

void AddAlternatives(const X509* certificate, std::vector<std::string>* names) {
  auto* all = static_cast<GENERAL_NAMES*>(
      X509_get_ext_d2i(certificate, NID_subject_alt_name, nullptr, nullptr));
  for (int i = 0; i < sk_GENERAL_NAME_num(all); ++i) {
    const GENERAL_NAME* name = sk_GENERAL_NAME_value(all, i);
    const auto add = [&](const char* prefix, const ASN1_STRING* text) {
      names->push_back(prefix + std::string(View(text)));
    };
    if (name->type == GEN_URI) add("", name->d.uniformResourceIdentifier);
    if (name->type == GEN_DNS) add("dns:", name->d.dNSName);
    if (name->type == GEN_EMAIL) add("email:", name->d.rfc822Name);
  }
  GENERAL_NAMES_free(all);
}

void AddCommonNames(const X509* certificate, std::vector<std::string>* names) {
  const X509_NAME* subject = X509_get_subject_name(certificate);
  for (int i = -1; (i = X509_NAME_get_index_by_NID(subject, NID_commonName, i)) >= 0;) {
    const ASN1_STRING* text = X509_NAME_ENTRY_get_data(X509_NAME_get_entry(subject, i));
    unsigned char* utf8 = nullptr;
    const int size = ASN1_STRING_to_UTF8(&utf8, text);
    if (size < 0) continue;
    names->push_back(
        "cn:" + std::string(reinterpret_cast<const char*>(utf8), static_cast<std::size_t>(size)));
    OPENSSL_free(utf8);
  }
}

}  // namespace

TlsContext::TlsContext(const TlsMaterial& material) : context_(MakeContext(material)) {}

void TlsContext::Replace(const TlsMaterial& material) {
  auto context = MakeContext(material);
  const MutexLock lock(mutex_);
  context_ = std::move(context);
}

Ssl TlsContext::Make(int fd) const {
  std::shared_ptr<SSL_CTX> context;
  {
    const MutexLock lock(mutex_);
    context = context_;
  }
  Ssl ssl(SSL_new(context.get()));
  SSL_set_fd(ssl.get(), fd);
  SSL_set_accept_state(ssl.get());
  return ssl;
}

std::vector<std::string> NamesOf(const SSL& ssl) {
  std::vector<std::string> names;
  const X509* certificate = SSL_get0_peer_certificate(&ssl);
  if (certificate == nullptr) return names;
  AddAlternatives(certificate, &names);
  AddCommonNames(certificate, &names);
  return names;
}

}  // namespace contact::gateway
