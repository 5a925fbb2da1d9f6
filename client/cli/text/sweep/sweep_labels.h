#pragma once

#include <string>

#include "contact/v1/job.pb.h"

namespace contact::cli {

/// The label of an axis of a sweep; without one what it varies, in words with its unit: `velocity
/// of B1 [m/s]` for `bodies[0].velocity_m_per_s`. A path that the contract does not know stays as
/// it is.
std::string AxisLabel(const v1::Sweep& sweep, int axis);

/// A metric of a sweep in words with its unit: `final velocity of B3 [m/s]` for
/// `final_bodies[B3].velocity_m_per_s`. A path that the contract does not know stays as it is.
std::string MetricLabel(const std::string& metric);

}  // namespace contact::cli
