#include "identity/jwk.h"

#include <openssl/bn.h>
#include <openssl/core_names.h>
#include <openssl/ecdsa.h>
#include <openssl/param_build.h>

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>

namespace contact {
namespace {

constexpr int kLeastRsaBits = 2048;
constexpr int kMostRsaBits = 8192;  // More takes too long to verify.
constexpr std::size_t kP256Bytes = 32;
constexpr std::size_t kEd25519Bytes = 32;

template <class T, auto Free>
struct Deleter {
  void operator()(T* object) const { Free(object); }
};
template <class T, auto Free>
using Owned = std::unique_ptr<T, Deleter<T, Free>>;
using OwnedKey = Owned<EVP_PKEY, EVP_PKEY_free>;
using BigNumber = Owned<BIGNUM, BN_free>;
using Builder = Owned<OSSL_PARAM_BLD, OSSL_PARAM_BLD_free>;

const unsigned char* Bytes(std::string_view text) {
  return reinterpret_cast<const unsigned char*>(text.data());
}

// The bytes of a member in base64url; empty if it has none.
std::string Member(const nlohmann::json& object, const char* name) {
  return FromBase64Url(TextMember(object, name)).value_or("");
}

BigNumber ToNumber(std::string_view bytes) {
  return BigNumber(BN_bin2bn(Bytes(bytes), static_cast<int>(bytes.size()), nullptr));
}

// A public key of these parameters; null if they are none.
OwnedKey MakeKey(const char* kind, OSSL_PARAM_BLD* builder) {
  const Owned<OSSL_PARAM, OSSL_PARAM_free> parameters(OSSL_PARAM_BLD_to_param(builder));
  const Owned<EVP_PKEY_CTX, EVP_PKEY_CTX_free> context(
      EVP_PKEY_CTX_new_from_name(nullptr, kind, nullptr));
  EVP_PKEY* key = nullptr;
  if (!parameters || !context || EVP_PKEY_fromdata_init(context.get()) <= 0 ||
      EVP_PKEY_fromdata(context.get(), &key, EVP_PKEY_PUBLIC_KEY, parameters.get()) <= 0) {
    return nullptr;
  }
  return OwnedKey(key);
}

OwnedKey RsaKey(const nlohmann::json& object) {
  const BigNumber n = ToNumber(Member(object, "n")), e = ToNumber(Member(object, "e"));
  if (BN_num_bits(n.get()) < kLeastRsaBits || BN_num_bits(n.get()) > kMostRsaBits) return nullptr;
  // Of an even modulus everybody knows a factor, and to the power of 1 everybody signs.
  if (!BN_is_odd(n.get()) || !BN_is_odd(e.get()) || BN_is_one(e.get())) return nullptr;
  const Builder builder(OSSL_PARAM_BLD_new());
  OSSL_PARAM_BLD_push_BN(builder.get(), OSSL_PKEY_PARAM_RSA_N, n.get());
  OSSL_PARAM_BLD_push_BN(builder.get(), OSSL_PKEY_PARAM_RSA_E, e.get());
  return MakeKey("RSA", builder.get());
}

OwnedKey P256Key(const nlohmann::json& object) {
  const std::string x = Member(object, "x"), y = Member(object, "y");
  if (x.size() != kP256Bytes || y.size() != kP256Bytes) return nullptr;
  const std::string point = '\4' + x + y;  // Not compressed.
  const Builder builder(OSSL_PARAM_BLD_new());
  OSSL_PARAM_BLD_push_utf8_string(builder.get(), OSSL_PKEY_PARAM_GROUP_NAME, "prime256v1", 0);
  OSSL_PARAM_BLD_push_octet_string(builder.get(), OSSL_PKEY_PARAM_PUB_KEY, point.data(),
                                   point.size());
  return MakeKey("EC", builder.get());
}

// True for the eight points of Ed25519 whose multiples are these eight: everybody signs for them.
// Their y is 0, 1, −1 or solves 121665 y⁴ − 243332 y² + 121666 = 0 modulo 2^255 − 19, which follows
// from the curve's equation for a point whose double has y = 0.
bool IsOfSmallOrder(std::string key) {
  std::ranges::reverse(key);
  key.front() = static_cast<char>(key.front() & 0x7F);  // The sign of x.
  const Owned<BN_CTX, BN_CTX_free> context(BN_CTX_new());
  const BigNumber p(BN_new()), square = ToNumber(key), sum(BN_new()), product(BN_new());
  BN_set_bit(p.get(), 255);
  BN_sub_word(p.get(), 19);
  BN_mod_sqr(square.get(), square.get(), p.get(), context.get());
  // (121665 y² − 243332) y² + 121666
  BN_copy(sum.get(), square.get());
  BN_mul_word(sum.get(), 121665);
  BN_sub_word(sum.get(), 243332);
  BN_mod_mul(sum.get(), sum.get(), square.get(), p.get(), context.get());
  BN_add_word(sum.get(), 121666);
  // y² (y² − 1)
  BN_copy(product.get(), square.get());
  BN_sub_word(product.get(), 1);
  BN_mod_mul(product.get(), product.get(), square.get(), p.get(), context.get());
  BN_mod_mul(product.get(), product.get(), sum.get(), p.get(), context.get());
  return BN_is_zero(product.get());
}

OwnedKey Ed25519Key(const nlohmann::json& object) {
  const std::string x = Member(object, "x");
  if (x.size() != kEd25519Bytes || IsOfSmallOrder(x)) return nullptr;
  return OwnedKey(EVP_PKEY_new_raw_public_key(EVP_PKEY_ED25519, nullptr, Bytes(x), x.size()));
}

// A signature r, s of two numbers as OpenSSL has it; empty if it is none.
std::string ToDer(std::string_view signature) {
  if (signature.size() != 2 * kP256Bytes) return "";
  const Owned<ECDSA_SIG, ECDSA_SIG_free> pair(ECDSA_SIG_new());
  ECDSA_SIG_set0(pair.get(), ToNumber(signature.substr(0, kP256Bytes)).release(),
                 ToNumber(signature.substr(kP256Bytes)).release());
  unsigned char* bytes = nullptr;
  const int size = i2d_ECDSA_SIG(pair.get(), &bytes);
  if (size <= 0) return "";
  std::string der(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(size));
  OPENSSL_free(bytes);
  return der;
}

}  // namespace

std::string TextMember(const nlohmann::json& object, const std::string& name) {
  const auto found = object.find(name);
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

std::optional<std::string> FromBase64Url(std::string_view text) {
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;  // Of the bits that are not in `bytes` yet.
  for (const char c : text) {
    std::uint32_t digit = 0;
    if (c >= 'A' && c <= 'Z') {
      digit = static_cast<std::uint32_t>(c - 'A');
    } else if (c >= 'a' && c <= 'z') {
      digit = static_cast<std::uint32_t>(c - 'a' + 26);
    } else if (c >= '0' && c <= '9') {
      digit = static_cast<std::uint32_t>(c - '0' + 52);
    } else if (c == '-' || c == '_') {
      digit = c == '-' ? 62 : 63;
    } else {
      return std::nullopt;
    }
    bits = bits << 6U | digit;
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<char>(bits >> static_cast<unsigned>(count) & 0xFFU));
  }
  // No text of bytes ends with a single digit, or with bits that are not 0: one form for each.
  if (count == 6 || (bits & ((1U << static_cast<unsigned>(count)) - 1)) != 0) return std::nullopt;
  return bytes;
}

std::optional<Jwk> ReadJwk(const nlohmann::json& object) {
  const std::string kind = TextMember(object, "kty"), curve = TextMember(object, "crv");
  OwnedKey key;
  const char* algorithm = nullptr;
  if (kind == "RSA") {
    key = RsaKey(object);
    algorithm = "RS256";
  } else if (kind == "EC" && curve == "P-256") {
    key = P256Key(object);
    algorithm = "ES256";
  } else if (kind == "OKP" && curve == "Ed25519") {
    key = Ed25519Key(object);
    algorithm = "EdDSA";
  }
  if (!key) return std::nullopt;
  return Jwk{algorithm, std::move(key)};
}

bool IsSignedBy(EVP_PKEY* key, const std::string& algorithm, std::string_view text,
                const std::string& signature) {
  const std::string bytes = algorithm == "ES256" ? ToDer(signature) : signature;
  const EVP_MD* digest = algorithm == "EdDSA" ? nullptr : EVP_sha256();
  const Owned<EVP_MD_CTX, EVP_MD_CTX_free> context(EVP_MD_CTX_new());
  return EVP_DigestVerifyInit(context.get(), nullptr, digest, nullptr, key) == 1 &&
         EVP_DigestVerify(context.get(), Bytes(bytes), bytes.size(), Bytes(text), text.size()) == 1;
}

}  // namespace contact
