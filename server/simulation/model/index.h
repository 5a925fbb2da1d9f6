#pragma once

#include <cstddef>

namespace contact {

/// The index of a body, contact, support or load as a container wants it; ≥ 0.
constexpr std::size_t At(std::ptrdiff_t index) { return static_cast<std::size_t>(index); }

}  // namespace contact
