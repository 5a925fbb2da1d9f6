#include "gateway/net/held_bytes.h"

#include <algorithm>
#include <utility>

namespace contact::gateway {

HeldBytes::Account::Account(HeldBytes& all, std::function<void()> cut)
    : all_(all), cut_(std::move(cut)) {
  const MutexLock lock(all_.mutex_);
  all_.accounts_.insert(this);
}

HeldBytes::Account::~Account() {
  const MutexLock lock(all_.mutex_);
  all_.accounts_.erase(this);
  if (cut_) all_.bytes_ -= bytes_;
}

void HeldBytes::Account::Add(std::size_t bytes) {
  const MutexLock lock(all_.mutex_);
  bytes_ += bytes;
  if (!cut_) return;
  all_.bytes_ += bytes;
  if (all_.bytes_ > all_.most_) all_.CutHeaviest();
}

void HeldBytes::Account::Sub(std::size_t bytes) {
  const MutexLock lock(all_.mutex_);
  bytes_ -= bytes;
  if (cut_) all_.bytes_ -= bytes;
}

std::size_t HeldBytes::bytes() const {
  const MutexLock lock(mutex_);
  return bytes_;
}

void HeldBytes::CutHeaviest() {
  const auto weight = [](const Account* account) { return account->cut_ ? account->bytes_ : 0; };
  Account* heaviest = *std::ranges::max_element(accounts_, {}, weight);
  bytes_ -= heaviest->bytes_;
  std::exchange(heaviest->cut_, nullptr)();
}

}  // namespace contact::gateway
