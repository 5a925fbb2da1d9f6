#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <type_traits>

namespace contact {

/// N numbers of an array, to be computed with at once.
template <int N>
struct Rows {
  /// Holds values of N rows.
  using Array = Eigen::Array<double, N, 1>;
  /// The N numbers from `first` on, to read or to write; does not copy.
  auto operator()(const double* first) const { return Eigen::Map<const Array>(first); }
  auto operator()(double* first) const { return Eigen::Map<Array>(first); }
};

/// Calls f(rows, i) for all of n rows: four at a time, then two, then one. A few bodies have short
/// arrays, on which what compilers make of a loop over single rows costs more than the rows.
template <class F>
[[gnu::always_inline]] inline void InRows(std::ptrdiff_t n, F&& f) {
  std::ptrdiff_t i = 0;
  for (; i + 4 <= n; i += 4) f(Rows<4>(), i);
  if ((n & 2) != 0) f(Rows<2>(), i), i += 2;
  if ((n & 1) != 0) f(Rows<1>(), i);
}

/// Calls f(n) with a number that the compiler knows if n is one of those named, for loops over a
/// few bodies are mostly the counting; else with n.
template <std::ptrdiff_t... kKnown, class F>
[[gnu::always_inline]] inline void WithCount(std::ptrdiff_t n, F&& f) {
  const bool known =
      ((n == kKnown && (f(std::integral_constant<std::ptrdiff_t, kKnown>()), true)) || ...);
  if (!known) f(n);
}

}  // namespace contact
