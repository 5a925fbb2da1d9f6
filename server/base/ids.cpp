#include "base/sources.h"

#include <fmt/format.h>

#include <mutex>
#include <random>

namespace contact {
namespace {

class RealClock final : public Clock {
 public:
  std::chrono::system_clock::time_point Now() const override {
    return std::chrono::system_clock::now();
  }
  std::chrono::steady_clock::time_point Elapsed() const override {
    return std::chrono::steady_clock::now();
  }
};

// 10 characters of Crockford's base32, 50 random bits: never the same twice in practice, and easy
// to read out aloud.
class RandomIdSource final : public IdSource {
 public:
  std::string NextJobId() override {
    constexpr char kDigits[] = "0123456789abcdefghjkmnpqrstvwxyz";
    const std::lock_guard lock(mutex_);
    std::string id(10, '0');
    for (char& digit : id) digit = kDigits[device_() % 32];
    return id;
  }

  // RFC 4122, version 4.
  std::string NextUid() override {
    const std::lock_guard lock(mutex_);
    return fmt::format("{:08x}-{:04x}-4{:03x}-{:04x}-{:08x}{:04x}", Bits(32), Bits(16), Bits(12),
                       0x8000 | Bits(14), Bits(32), Bits(16));
  }

 private:
  unsigned int Bits(int count) { return device_() >> (32 - count); }

  std::mutex mutex_;
  std::random_device device_;  // Guarded by mutex_.
};

}  // namespace

const Clock& SystemClock() {
  static const RealClock clock;
  return clock;
}

IdSource& RandomIds() {
  static RandomIdSource ids;
  return ids;
}

}  // namespace contact
