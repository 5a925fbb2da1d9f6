#include "base/ids.h"

#include <fmt/format.h>

#include <random>

#include "base/mutex.h"

namespace contact {
namespace {

class RandomIdSource final : public IdSource {
 public:
  // Crockford's base32, which has no letters that look like digits.
  std::string NextId() override {
    constexpr char kDigits[] = "0123456789abcdefghjkmnpqrstvwxyz";
    const MutexLock lock(mutex_);
    std::string id(10, '0');
    for (char& digit : id) digit = kDigits[device_() % 32];
    return id;
  }

  std::string NextUuid() override {
    const MutexLock lock(mutex_);
    return fmt::format("{:08x}-{:04x}-4{:03x}-{:04x}-{:08x}{:04x}", Bits(32), Bits(16), Bits(12),
                       0x8000 | Bits(14), Bits(32), Bits(16));
  }

 private:
  unsigned int Bits(int count) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    return device_() >> (32 - count);
  }

  Mutex mutex_;
  std::random_device device_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace

IdSource& RandomIds() {
  static RandomIdSource ids;
  return ids;
}

}  // namespace contact
