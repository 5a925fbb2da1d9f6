#pragma once

#include <cstddef>

namespace contact {

/// The places in the state vector y of N bodies and C contacts:
///   [u (N), v (N)]
/// and then quadratures, on which no slope depends:
///   [W (C)]                                    work of the running cycles
///   [E (C), load work, support loss, impulse]  when recording
class StateLayout {
 public:
  StateLayout(int bodies, int contacts) : bodies_(bodies), contacts_(contacts) {}

  int bodies() const { return bodies_; }
  int contacts() const { return contacts_; }
  /// How many numbers y has. It changes with `recording`.
  std::ptrdiff_t size() const { return work(contacts()) + (recording ? contacts() + 3 : 0); }
  /// How many of them, from the first, slopes depend on: all but the quadratures.
  std::ptrdiff_t coupled() const { return 2 * std::ptrdiff_t{bodies()}; }
  /// Place of the work W of a contact's running cycle [J], (W1).
  std::ptrdiff_t work(int contact) const { return coupled() + contact; }
  /// Place of the work E of F_e in a contact's running cycle [J], (W3). This and the next three
  /// only when recording.
  std::ptrdiff_t external_work(int contact) const { return work(contacts()) + contact; }
  /// Place of the work of all loads [J], (B1).
  std::ptrdiff_t load_work() const { return external_work(contacts()); }
  /// Place of what the supports dissipate [J], (B1).
  std::ptrdiff_t support_loss() const { return load_work() + 1; }
  /// Place of the impulse of the external forces [N·s], (B2).
  std::ptrdiff_t impulse() const { return load_work() + 2; }

  /// Whether y has the quadratures of the ledger.
  bool recording = false;

 private:
  const int bodies_, contacts_;
};

}  // namespace contact
