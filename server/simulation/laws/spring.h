#pragma once

#include <cstddef>
#include <vector>

namespace contact {

/// A spring that is longer by d [m] than without force, (M4). `higher` are k₂, k₃, …
struct Spring {
  /// k d + k₂ d² + k₃ d³ + … [N].
  double force = 0;
  /// Its derivative by d [N/m].
  double slope = 0;
  /// Its integral from 0 to d [J].
  double energy = 0;

  Spring(double stiffness, const std::vector<double>& higher, double d) {
    double share = 0;  // Energy over d².
    // Horner's scheme, from the highest order.
    const auto add = [&](double order, double factor) {
      force = force * d + factor;
      slope = slope * d + order * factor;
      share = share * d + factor / (order + 1);
    };
    for (std::size_t i = higher.size(); i-- > 0;) add(static_cast<double>(i + 2), higher[i]);
    add(1, stiffness);
    force *= d;
    energy = share * d * d;
  }

  /// A linear spring that slips with this force, of either sign.
  static Spring Slipping(double stiffness, double force) {
    Spring spring(stiffness, {}, force / stiffness);
    spring.force = force;
    spring.slope = 0;
    return spring;
  }
};

}  // namespace contact
