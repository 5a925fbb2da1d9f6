#include "simulation/course/whereabouts.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <vector>

namespace contact {
namespace {

constexpr std::size_t kMostContacts = 3;

struct Place {
  int contact;
  double deformation, damping, work;
};

}  // namespace

std::string Whereabouts(const Scenario& scenario, const Motion& motion) {
  const double* y = motion.integrator().y0.data();
  std::vector<Place> places;
  for (const ActiveContact& active : motion.equations().active) {
    const double deformation = active.Relative(y) - active.gap;
    const double lambda =
        active.DampingAt(deformation) * (active.left_inverse + active.right_inverse);
    places.push_back({active.contact, deformation, lambda * motion.step(),
                      y[motion.equations().work(active.contact)]});
  }
  if (places.empty()) return "no contact active";
  std::ranges::stable_sort(places, std::ranges::greater(), &Place::damping);
  std::ostringstream text;
  text.precision(2);
  text << "in contact ";
  for (std::size_t i = 0; i < std::min(places.size(), kMostContacts); ++i) {
    const Place& place = places[i];
    text << (i > 0 ? ", " : "") << scenario.contacts[static_cast<std::size_t>(place.contact)].name
         << ": δ " << place.deformation << " m, λh " << place.damping << ", work " << place.work
         << " J";
  }
  if (places.size() > kMostContacts) text << " and " << places.size() - kMostContacts << " more";
  return text.str();
}

std::string BusyWith(const Scenario& scenario, const Motion& motion) {
  constexpr std::int64_t kManySteps = 1'000'000;
  return motion.steps() < kManySteps ? std::string() : Whereabouts(scenario, motion);
}

}  // namespace contact
