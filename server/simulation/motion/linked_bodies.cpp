#include "simulation/motion/linked_bodies.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "simulation/model/index.h"

namespace contact {
namespace {

// Bodies further apart, in places, are not coupled in linear systems: the band stays narrow.
constexpr std::ptrdiff_t kFar = 8;

}  // namespace

// A wall takes the place of the body that touches it, and adds nothing there: it counts 0.
void LinkedBodies::Connect(const Sides& sides, int column) {
  Link& link = links_.emplace_back(Link{sides, column});
  if (link.left_counts == 0) link.left = link.right;
  if (link.right_counts == 0) link.right = link.left;
}

void LinkedBodies::Count() {
  links_.clear();
  for (const ActiveContact& contact : equations_.active) Connect(contact, contact.column);
  for (const Support& support : scenario_.supports) {
    Connect(equations_.SidesOf(support.body, support.other), kNone);
  }
  places_.assign(scenario_.bodies.size(), kNone);
  bodies_.clear();
  for (const Link& link : links_) {
    for (const std::ptrdiff_t body : {link.left, link.right}) {
      if (std::exchange(places_[At(body)], 0) == kNone) bodies_.push_back(body);
    }
  }
  std::ranges::sort(bodies_, {}, [&](std::ptrdiff_t body) { return equations_.base()[At(body)]; });
  for (std::ptrdiff_t i = 0; i < std::ssize(bodies_); ++i) places_[At(bodies_[At(i)])] = i;
  reach_ = 0;
  for (Link& link : links_) {
    link.left = places_[At(link.left)];
    link.right = places_[At(link.right)];
    link.couples = std::abs(link.left - link.right) <= kFar;
    if (link.couples) reach_ = std::max(reach_, std::abs(link.left - link.right));
  }
}

}  // namespace contact
