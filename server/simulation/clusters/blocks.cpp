#include "simulation/clusters/blocks.h"

#include <cstddef>
#include <set>

namespace contact {

std::vector<int> Blocks::With(int body) const {
  const auto& block = of[static_cast<std::size_t>(body)];
  return block == nullptr ? std::vector<int>{body} : *block;
}

std::vector<std::vector<int>> Blocks::All() const {
  std::vector<std::vector<int>> all;
  for (int body = 0; body < std::ssize(of); ++body) {
    const auto& block = of[static_cast<std::size_t>(body)];
    if (block != nullptr && block->front() == body) all.push_back(*block);
  }
  return all;
}

void Blocks::Bind(const std::vector<int>& bodies) {
  std::set<int> all;
  for (const int body : bodies) {
    const std::vector<int> block = With(body);
    all.insert(block.begin(), block.end());
  }
  const auto block = std::make_shared<const std::vector<int>>(all.begin(), all.end());
  for (const int body : *block) of[static_cast<std::size_t>(body)] = block;
}

}  // namespace contact
