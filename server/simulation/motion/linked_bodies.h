#pragma once

#include <cstddef>
#include <vector>

#include "simulation/model/scenario.h"
#include "simulation/motion/equations.h"

namespace contact {

/// The bodies that a contact or a support moves, counted in their order on the line. Neighbours
/// touch there, so that the linear system of an implicit step has a narrow band.
class LinkedBodies {
 public:
  /// A contact or support, between bodies as they are counted here.
  struct Link : Sides {
    /// The sensitivity column of a contact, or kNone.
    int column = kNone;
    /// Whether it is part of linear systems; not if it joins bodies far apart, as a spring between
    /// the ends of a long row.
    bool couples = true;

    /// Calls add(row, column, factor) for the entries of a linear system of accelerations in which
    /// a force pushes both bodies apart, linear in the difference left − right of their motions.
    template <class Add>
    void ForEntries(Add&& add) const {
      add(left, left, left_inverse * left_counts);
      add(left, right, -left_inverse * right_counts);
      add(right, left, -right_inverse * left_counts);
      add(right, right, right_inverse * right_counts);
    }
  };

  /// Both must outlive this.
  LinkedBodies(const Scenario& scenario, const Equations& equations)
      : scenario_(scenario), equations_(equations) {}

  /// Call when the active contacts have changed.
  void Count();

  /// The active contacts, then the supports.
  const std::vector<Link>& links() const { return links_; }
  /// How many bodies are counted.
  std::ptrdiff_t size() const { return std::ssize(bodies_); }
  /// Index in Scenario::bodies of the body at a place.
  std::ptrdiff_t body(std::ptrdiff_t place) const {
    return bodies_[static_cast<std::size_t>(place)];
  }
  /// The place of a body of the scenario; kNone if no link moves it.
  std::ptrdiff_t place(std::ptrdiff_t body) const {
    return places_[static_cast<std::size_t>(body)];
  }
  /// How many places apart the bodies of a link that couples are at most.
  std::ptrdiff_t reach() const { return reach_; }

 private:
  /// Adds a link between the bodies of `sides`.
  void Connect(const Sides& sides, int column);

  const Scenario& scenario_;
  const Equations& equations_;
  std::vector<Link> links_;
  // The body at each place, and the place of each body or kNone.
  std::vector<std::ptrdiff_t> bodies_, places_;
  std::ptrdiff_t reach_ = 0;
};

}  // namespace contact
