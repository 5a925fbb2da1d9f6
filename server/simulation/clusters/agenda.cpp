#include "simulation/clusters/agenda.h"

#include <cstddef>
#include <numeric>
#include <tuple>

namespace contact {

void Agenda::Begin() {
  entries_ = {};
  std::vector<int> bodies(world_.scenario().bodies.size());
  std::iota(bodies.begin(), bodies.end(), 0);
  Note(bodies);
}

// By time, and by names where two come at once.
bool Agenda::Later::operator()(const Entry& a, const Entry& b) const {
  const auto rank = [](const Entry& e) {
    return std::tuple(e.time, e.group != nullptr,
                      e.group == nullptr ? e.contact : e.group->bodies.front());
  };
  return rank(a) > rank(b);
}

void Agenda::NoteTouch(int contact) {
  const Contact& c = world_.scenario().contacts[static_cast<std::size_t>(contact)];
  if (world_.Sides(contact).empty()) return;
  const double time = world_.NextTouch(contact);
  if (time >= world_.scenario().end_time) return;
  entries_.push({.time = time,
                 .contact = contact,
                 .left_changes = world_.Changes(c.left),
                 .right_changes = world_.Changes(c.right)});
}

void Agenda::Note(const std::vector<int>& bodies) {
  for (const int body : bodies) {
    const auto& group = world_.WaitingOf(body);
    if (group != nullptr && group->bodies.front() == body) {
      entries_.push({.time = group->time, .group = group});
    }
    if (group != nullptr) continue;
    for (const int contact : world_.ContactsOf(body)) NoteTouch(contact);
  }
}

bool Agenda::Holds(const Entry& entry) const {
  if (entry.group != nullptr) return world_.WaitingOf(entry.group->bodies.front()) == entry.group;
  const Contact& c = world_.scenario().contacts[static_cast<std::size_t>(entry.contact)];
  return world_.Changes(c.left) == entry.left_changes &&
         world_.Changes(c.right) == entry.right_changes;
}

Agenda::Entry Agenda::Next() {
  if (NextTime() == kNever) return {};
  Entry entry = entries_.top();
  entries_.pop();
  return entry;
}

double Agenda::NextTime() {
  while (!entries_.empty() && !Holds(entries_.top())) entries_.pop();
  return entries_.empty() ? kNever : entries_.top().time;
}

}  // namespace contact
