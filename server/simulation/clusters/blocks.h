#pragma once

#include <memory>
#include <vector>

namespace contact {

/// Bodies that are solved together for good, each with those that it is bound to.
struct Blocks {
  /// The block of each body; null: it is alone.
  std::vector<std::shared_ptr<const std::vector<int>>> of;

  /// The bodies that a body is bound to, itself among them, ascending.
  std::vector<int> With(int body) const;
  /// All blocks of more than one body.
  std::vector<std::vector<int>> All() const;
  /// Binds these bodies, and all that they are bound to.
  void Bind(const std::vector<int>& bodies);
};

}  // namespace contact
