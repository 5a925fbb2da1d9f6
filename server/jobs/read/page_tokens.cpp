#include "jobs/read/page_tokens.h"

#include <absl/strings/escaping.h>
#include <openssl/evp.h>

#include <array>
#include <cstring>
#include <memory>
#include <stdexcept>

#include "base/digest.h"

namespace contact {
namespace {

// A position, and zeros that only whoever knows the key can make.
struct Block {
  std::int64_t position = 0;
  std::int64_t zero = 0;
};
constexpr std::size_t kBlockBytes = sizeof(Block);

using Bytes = std::array<unsigned char, kBlockBytes>;

void Require(bool done) {
  if (!done) throw std::runtime_error("OpenSSL cannot compute AES");
}

// Encrypts a block with a key of the tenant, or decrypts it.
Bytes Pass(const std::string& secret, const std::string& tenant, const Bytes& in, bool encrypt) {
  const std::string key = HmacSha256(secret, tenant);  // AES takes the first half.
  const std::unique_ptr<EVP_CIPHER_CTX, decltype(&EVP_CIPHER_CTX_free)> context(
      EVP_CIPHER_CTX_new(), EVP_CIPHER_CTX_free);
  Require(EVP_CipherInit_ex(context.get(), EVP_aes_128_ecb(), nullptr,
                            reinterpret_cast<const unsigned char*>(key.data()), nullptr,
                            encrypt ? 1 : 0) == 1);
  EVP_CIPHER_CTX_set_padding(context.get(), 0);
  Bytes out;
  int size = 0;
  Require(EVP_CipherUpdate(context.get(), out.data(), &size, in.data(),
                           static_cast<int>(kBlockBytes)) == 1);
  return out;
}

}  // namespace

std::string PageTokens::Seal(const std::string& tenant, std::int64_t position) const {
  if (position == 0) return "";
  const Block block{.position = position};
  Bytes bytes;
  std::memcpy(bytes.data(), &block, kBlockBytes);
  bytes = Pass(secret_, tenant, bytes, true);
  return absl::BytesToHexString({reinterpret_cast<const char*>(bytes.data()), kBlockBytes});
}

std::int64_t PageTokens::Open(const std::string& tenant, const std::string& token) const {
  if (token.empty()) return 0;
  const std::string sealed =
      token.size() == 2 * kBlockBytes ? absl::HexStringToBytes(token) : std::string();
  Bytes bytes{};
  std::memcpy(bytes.data(), sealed.data(), sealed.size());
  bytes = Pass(secret_, tenant, bytes, false);
  Block block;
  std::memcpy(&block, bytes.data(), kBlockBytes);
  return block.zero == 0 && Seal(tenant, block.position) == token ? block.position : -1;
}

}  // namespace contact
