#include "simulation/motion/force_watch.h"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cstddef>

#include "simulation/model/index.h"

namespace contact {

void ForceWatch::Observe(const ActiveContact& active) {
  const int n = system_.equations.bodies();
  Cycle& cycle = system_.contacts[At(active.contact)].cycle;
  ActiveContact law = active;
  law.clipped = false;
  struct End {
    double force, growth;  // F, dF/dt.
  };
  const auto end = [&](const Eigen::ArrayXd& y, const Eigen::ArrayXd& slope) {
    const double rate = law.Relative(y.data() + n);
    const ActiveContact::Force f = law.At(law.Relative(y.data()) - law.gap, rate);
    return End{f.force, f.by_deformation * rate + f.by_rate * law.Relative(slope.data() + n)};
  };
  const End first = end(system_.rk.y0, system_.rk.slope0),
            last = end(system_.rk.y1, system_.rk.slope1);
  const bool pulls = first.force < 0 || last.force < 0;  // Nowhere else in a step does it pull.
  const bool peaks = first.growth >= 0 && last.growth < 0;
  double where = last.force > first.force ? 1 : 0;
  double largest = std::max(first.force, last.force);
  if (pulls || peaks) {
    if (system_.implicit) system_.PrepareInterpolation();
    const auto ends = system_.PathEnds(active.contact);
    const DeformationPath path(ends.first, ends.second);
    const auto force = [&](double theta) {
      if (system_.implicit) {  // The path of such a step is a cubic, too coarse for its force.
        system_.Interpolate(theta, &inside_);
        return law.At(law.Relative(inside_.data()) - law.gap, law.Relative(inside_.data() + n))
            .force;
      }
      const double dt = system_.step.h * system_.step.Rate(theta);
      return law.At(path.Value(theta), dt > 0 ? path.Slope(theta) / dt : 0).force;
    };
    for (int i = 0; pulls && i < 8; ++i) {
      if (force((i + 0.5) / 8) < 0) {
        cycle.tension_time += system_.step.At((i + 1) / 8.0) - system_.step.At(i / 8.0);
      }
    }
    if (peaks) {
      const auto peak = boost::math::tools::brent_find_minima(
          [&](double theta) { return -force(theta); }, 0.0, 1.0, 40);
      if (-peak.second > largest) where = peak.first, largest = -peak.second;
    }
  }
  if (largest <= cycle.peak_force) return;
  cycle.peak_force = largest;
  if (system_.splits_at_force()) KeepPeak(active.contact, where);
}

void ForceWatch::KeepPeak(int contact, double theta) {
  const int n = system_.equations.bodies();
  system_.PrepareInterpolation();
  system_.Interpolate(theta, &inside_);
  system_.contacts[At(contact)].peak = {
      .time = system_.step.At(theta),
      .deformation = system_.Deformation(contact, inside_.data()),
      .velocity = system_.equations.Relative(contact, inside_.data() + n),
      .work = inside_[system_.equations.work(contact)],
      .external_work = system_.ExternalWork(contact, inside_)};
}

}  // namespace contact
