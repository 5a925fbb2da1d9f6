#include "identity/jwt.h"

#include <absl/strings/escaping.h>
#include <gmock/gmock.h>
#include <openssl/core_names.h>
#include <openssl/ecdsa.h>
#include <openssl/rsa.h>

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "identity/jwk.h"

namespace contact {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using Clock = std::chrono::system_clock;

const Clock::time_point kVerified{std::chrono::seconds(1'800'000'000)};
constexpr int kNowS = 1'800'000'000;

std::string ToBase64Url(const std::string& bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
  std::string text;
  unsigned bits = 0;
  unsigned count = 0;
  for (const char c : bytes) {
    bits = bits << 8U | static_cast<unsigned char>(c);
    for (count += 8; count >= 6; count -= 6) text += kDigits[bits >> (count - 6) & 63U];
  }
  if (count > 0) text += kDigits[bits << (6 - count) & 63U];
  return text;
}

// A key of an identity provider, which signs.
class Signer {
 public:
  Signer(std::string kid, std::string algorithm, EVP_PKEY* key)
      : kid_(std::move(kid)), algorithm_(std::move(algorithm)), key_(key, EVP_PKEY_free) {}

  std::string Number(const char* name, int bytes) const {
    BIGNUM* number = nullptr;
    EXPECT_EQ(EVP_PKEY_get_bn_param(key_.get(), name, &number), 1);
    std::string text(static_cast<std::size_t>(std::max(bytes, BN_num_bytes(number))), '\0');
    BN_bn2binpad(number, reinterpret_cast<unsigned char*>(text.data()),
                 static_cast<int>(text.size()));
    BN_free(number);
    return ToBase64Url(text);
  }

  json Jwk() const {
    json jwk = {{"kid", kid_}, {"use", "sig"}, {"alg", algorithm_}};
    if (algorithm_ == "RS256") {
      jwk.update({{"kty", "RSA"}, {"n", Number("n", 0)}, {"e", Number("e", 0)}});
    } else if (algorithm_ == "ES256") {
      jwk.update(
          {{"kty", "EC"}, {"crv", "P-256"}, {"x", Number("qx", 32)}, {"y", Number("qy", 32)}});
    } else {
      std::string raw(32, '\0');
      std::size_t size = raw.size();
      EVP_PKEY_get_raw_public_key(key_.get(), reinterpret_cast<unsigned char*>(raw.data()), &size);
      jwk.update({{"kty", "OKP"}, {"crv", "Ed25519"}, {"x", ToBase64Url(raw)}});
    }
    return jwk;
  }

  std::string Sign(const json& header, const json& claims) const {
    const std::string text = ToBase64Url(header.dump()) + '.' + ToBase64Url(claims.dump());
    EVP_MD_CTX* context = EVP_MD_CTX_new();
    EVP_DigestSignInit(context, nullptr, algorithm_ == "EdDSA" ? nullptr : EVP_sha256(), nullptr,
                       key_.get());
    std::string signature(1024, '\0');
    std::size_t size = signature.size();
    EXPECT_EQ(EVP_DigestSign(context, reinterpret_cast<unsigned char*>(signature.data()), &size,
                             reinterpret_cast<const unsigned char*>(text.data()), text.size()),
              1);
    EVP_MD_CTX_free(context);
    signature.resize(size);
    return text + '.' + ToBase64Url(algorithm_ == "ES256" ? FromDer(signature) : signature);
  }
  std::string Sign(const json& claims) const {
    return Sign({{"alg", algorithm_}, {"kid", kid_}, {"typ", "JWT"}}, claims);
  }

 private:
  static std::string FromDer(const std::string& der) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(der.data());
    ECDSA_SIG* pair = d2i_ECDSA_SIG(nullptr, &bytes, static_cast<long>(der.size()));
    std::string raw(64, '\0');
    auto* out = reinterpret_cast<unsigned char*>(raw.data());
    BN_bn2binpad(ECDSA_SIG_get0_r(pair), out, 32);
    BN_bn2binpad(ECDSA_SIG_get0_s(pair), out + 32, 32);
    ECDSA_SIG_free(pair);
    return raw;
  }

  std::string kid_;
  std::string algorithm_;
  std::shared_ptr<EVP_PKEY> key_;
};

Signer Rsa(unsigned bits = 2048) {
  return {"rsa", "RS256", EVP_PKEY_Q_keygen(nullptr, nullptr, "RSA", std::size_t{bits})};
}
Signer Ec() { return {"ec", "ES256", EVP_PKEY_Q_keygen(nullptr, nullptr, "EC", "P-256")}; }
Signer Ed() { return {"ed", "EdDSA", EVP_PKEY_Q_keygen(nullptr, nullptr, "ED25519")}; }

json Claims(const json& changes = json::object()) {
  json claims = {{"iss", "https://id.acme"}, {"aud", "contactd"},
                 {"exp", kNowS + 60},        {"sub", "ada"},
                 {"tenant", "acme"},         {"roles", {"submit", "dean"}}};
  claims.update(changes);
  return claims;
}

JwtVerifier Verifier(const std::vector<Signer>& signers) {
  json keys = json::array();
  for (const Signer& signer : signers) keys.push_back(signer.Jwk());
  auto verifier = JwtVerifier::Parse(json{{"keys", keys}}.dump(), {"https://id.acme", "contactd"});
  return std::get<JwtVerifier>(std::move(verifier));
}

// Whether a key is one of those that are used.
bool IsUsed(const json& jwk) {
  const json set = {{"keys", json::array({jwk})}};
  return std::holds_alternative<JwtVerifier>(JwtVerifier::Parse(set.dump(), {"issuer", "us"}));
}

std::string Mistake(const JwtVerifier& verifier, const std::string& token) {
  const auto found = verifier.Verify(token, kVerified);
  const auto* mistake = std::get_if<std::string>(&found);
  return mistake == nullptr ? "" : *mistake;
}

TEST(Jwt, EachAlgorithmTellsTheHolder) {
  const std::vector<Signer> signers = {Rsa(), Ec(), Ed()};
  const JwtVerifier verifier = Verifier(signers);
  for (const Signer& signer : signers) {
    const auto holder = std::get<Principal>(verifier.Verify(signer.Sign(Claims()), kVerified));
    EXPECT_EQ(holder, (Principal{"ada", "acme", {Role::kSubmit}, "jwt"}));
  }
}

TEST(Jwt, ClaimsMustFit) {
  const Signer ed = Ed();
  const JwtVerifier verifier = Verifier({ed});
  const std::vector<std::pair<json, std::string>> cases = {
      {{{"iss", "https://id.umbra"}}, "issuer"},
      {{{"iss", nullptr}}, "issuer"},
      {{{"aud", "other"}}, "audience"},
      {{{"aud", {"other"}}}, "audience"},
      {{{"aud", 7}}, "audience"},
      {{{"exp", nullptr}}, "no end"},
      {{{"exp", "soon"}}, "no end"},
      {{{"exp", kNowS - 31}}, "expired"},
      {{{"nbf", kNowS + 31}}, "not valid yet"},
      {{{"roles", {"dean"}}}, "no role"},
      {{{"roles", 7}}, "no role"},
      {{{"sub", ""}}, "user and tenant"},
      {{{"sub", "ada tenant:umbra"}}, "user and tenant"},
      {{{"tenant", nullptr}}, "user and tenant"},
      {{{"tenant", std::string(65, 'a')}}, "user and tenant"},
  };
  for (const auto& [change, mistake] : cases) {
    EXPECT_THAT(Mistake(verifier, ed.Sign(Claims(change))), HasSubstr(mistake)) << change;
  }
  for (const json& change : std::vector<json>{{{"aud", {"other", "contactd"}}},
                                              {{"exp", kNowS - 29}},
                                              {{"nbf", kNowS + 29}},
                                              {{"roles", "read submit"}}}) {
    EXPECT_EQ(Mistake(verifier, ed.Sign(Claims(change))), "") << change;
  }
}

TEST(Jwt, KeyDecidesTheAlgorithm) {
  const Signer rsa = Rsa(), ec = Ec(), other = Ec();
  const JwtVerifier verifier = Verifier({rsa, ec});
  const auto header = [](const char* alg, const char* kid) {
    return json{{"alg", alg}, {"kid", kid}};
  };
  EXPECT_THAT(Mistake(verifier, rsa.Sign(header("none", "rsa"), Claims())), HasSubstr("algorithm"));
  EXPECT_THAT(Mistake(verifier, rsa.Sign(header("HS256", "rsa"), Claims())),
              HasSubstr("algorithm"));
  EXPECT_THAT(Mistake(verifier, ec.Sign(header("RS256", "ec"), Claims())), HasSubstr("algorithm"));
  EXPECT_THAT(Mistake(verifier, ec.Sign(header("ES256", "rsa"), Claims())), HasSubstr("algorithm"));
  EXPECT_THAT(Mistake(verifier, ec.Sign(header("ES256", "no"), Claims())), HasSubstr("not known"));
  EXPECT_THAT(Mistake(verifier, ec.Sign({{"alg", "ES256"}}, Claims())), HasSubstr("not known"));
  EXPECT_THAT(Mistake(verifier, other.Sign(Claims())), HasSubstr("signature"));
  json critical = header("ES256", "ec");
  critical["crit"] = {"exp"};
  EXPECT_THAT(Mistake(verifier, ec.Sign(critical, Claims())), HasSubstr("extension"));
}

TEST(Jwt, AnyChangedByteIsRefused) {
  for (const Signer& signer : {Rsa(), Ec(), Ed()}) {
    const JwtVerifier verifier = Verifier({signer});
    const std::string token = signer.Sign(Claims());
    ASSERT_EQ(Mistake(verifier, token), "");
    for (std::size_t i = 0; i < token.size(); ++i) {
      std::string changed = token;
      changed[i] = changed[i] == 'A' ? 'B' : 'A';
      EXPECT_NE(Mistake(verifier, changed), "") << i;
      EXPECT_NE(Mistake(verifier, token.substr(0, i)), "") << i;
    }
    EXPECT_NE(Mistake(verifier, token + "."), "");
    EXPECT_NE(Mistake(verifier, token + "="), "");
  }
}

TEST(Jwt, KeysThatCannotVerifyAreLeftAside) {
  const auto parse = [](const json& keys) {
    const auto parsed = JwtVerifier::Parse(json{{"keys", keys}}.dump(), {});
    const auto* mistake = std::get_if<std::string>(&parsed);
    return mistake == nullptr ? "" : *mistake;
  };
  const json good = Ed().Jwk();
  const auto with = [&good](const char* member, const json& value) {
    json key = good;
    key[member] = value;
    return key;
  };
  EXPECT_EQ(parse(json::array({good})), "");
  const std::vector<json> bad = {
      Rsa(1024).Jwk(),    with("use", "enc"),   with("alg", "RS256"),
      with("kty", "oct"), with("kty", 7),       with("x", "AAAA"),
      with("kid", ""),    with("crv", "Ed448"), json{{"kty", "oct"}, {"kid", "k"}, {"k", "AAAA"}}};
  for (const json& key : bad) {
    EXPECT_THAT(parse(json::array({key})), HasSubstr("no key")) << key;
    EXPECT_EQ(parse(json::array({key, with("kid", "other")})), "") << key;
  }
  EXPECT_THAT(parse(json::array({good, good})), HasSubstr("two keys"));
  EXPECT_THAT(std::get<std::string>(JwtVerifier::Parse("[]", {})), HasSubstr("set of keys"));
  EXPECT_THAT(std::get<std::string>(JwtVerifier::Parse("{", {})), HasSubstr("set of keys"));
}

TEST(Jwt, KeysForWhichEverybodyCanSignAreNotUsed) {
  const json rsa = Rsa().Jwk();
  json weak = rsa;
  ASSERT_TRUE(IsUsed(rsa));
  for (const char exponent : {'\0', '\1', '\4'}) {
    weak["e"] = ToBase64Url({exponent});
    EXPECT_FALSE(IsUsed(weak)) << int{exponent};
  }
  weak = rsa;
  std::string modulus = *FromBase64Url(rsa["n"].get<std::string>());
  modulus.back() ^= 1;
  weak["n"] = ToBase64Url(modulus);
  EXPECT_FALSE(IsUsed(weak)) << "an even modulus";
}

// The encodings of y of the points of small order, also those that are not reduced, with both signs
// of x; from their list in libsodium.
TEST(Jwt, PointsOfSmallOrderAreNoKeys) {
  const auto key = [](std::string bytes) {
    return json{{"kid", "a"}, {"kty", "OKP"}, {"crv", "Ed25519"}, {"x", ToBase64Url(bytes)}};
  };
  ASSERT_TRUE(IsUsed(Ed().Jwk()));
  const auto edge = [](char low) {
    return std::string(1, low) + std::string(30, '\xff') + std::string(1, '\x7f');
  };
  for (std::string y :
       {std::string(32, '\0'), '\1' + std::string(31, '\0'), edge('\xec'), edge('\xed'),
        edge('\xee'),
        absl::HexStringToBytes("26e8958fc2b227b045c3f489f2ef98f0d5dfac05d3c63339b13802886d53fc05"),
        absl::HexStringToBytes(
            "c7176a703d4dd84fba3c0b760d10670f2a2053fa2c39ccc64ec7fd7792ac037a")}) {
    EXPECT_FALSE(IsUsed(key(y))) << absl::BytesToHexString(y);
    y.back() = static_cast<char>(y.back() | 0x80);
    EXPECT_FALSE(IsUsed(key(y))) << absl::BytesToHexString(y);
  }
}

TEST(Base64Url, EachTextOfBytesHasOneForm) {
  for (const std::string& bytes : {std::string(), std::string("f"), std::string("fo"),
                                   std::string("foo"), std::string("\0\xff\x80", 3)}) {
    EXPECT_EQ(FromBase64Url(ToBase64Url(bytes)), bytes);
  }
  for (const char* text : {"A", "AB", "AAB", "AA==", "A+/A", "AAAAA"}) {
    EXPECT_EQ(FromBase64Url(text), std::nullopt) << text;
  }
}

}  // namespace
}  // namespace contact
