#pragma once

#include <numbers>

#include "wire/rules/rules.h"

namespace contact {

/// ω of a sine of a load or a motion [rad/s], which either of two fields gives.
template <class Sine>
double DecodeAngularFrequency(const Sine& sine, const Rules& rules) {
  const double angular = rules.Read(sine, Sine::kAngularFrequencyRadPerSFieldNumber);
  if (!sine.has_frequency_hz()) return angular;
  if (angular != 0) {
    rules.Break("frequency_hz", "is given beside angular_frequency_rad_per_s",
                "give one of the two");
  }
  return 2 * std::numbers::pi * rules.Read(sine, Sine::kFrequencyHzFieldNumber);
}

}  // namespace contact
