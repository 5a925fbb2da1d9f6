#include "simulation/episode/groups.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace contact {

double GroupSight::Miss() const { return std::sqrt(std::max(squared, 0.0)) / restitution_in - 1; }

double GroupSight::Missing() const {
  return std::abs(work_restitution + restitution_in * restitution_in * work_compression);
}

double GroupSight::SlopeOfSquare() const {
  const auto of = [&](const Eigen::ArrayXd& of_work) {
    return column < of_work.size() ? of_work[column] : 0;
  };
  return -(of(gradient_restitution) + squared * of(gradient_compression)) / work_compression;
}

const GroupSight* Sight::Find(const GroupId& id) const {
  for (const GroupSight& group : groups) {
    if (group.id == id) return &group;
  }
  return nullptr;
}

bool HasBegun(const State& state, const GroupId& id) {
  const ContactState& contact = state.contacts[static_cast<std::size_t>(id.contact)];
  const int encounter = contact.member.group.encounter;
  return id.encounter < std::max(contact.encounter, encounter) ||
         (id.encounter == encounter && id.place <= contact.member.place);
}

GroupId LastGroup(const ContactState& contact) {
  return {contact.cycle.contact, contact.member.group.encounter, contact.member.place};
}

Unknown& Groups::At(const GroupId& id) {
  Unknown& unknown = known_[id];
  unknown.id = id;
  return unknown;
}

Unknown* Groups::Find(const GroupId& id) {
  const auto found = known_.find(id);
  return found == known_.end() ? nullptr : &found->second;
}

const Unknown* Groups::Find(const GroupId& id) const {
  const auto found = known_.find(id);
  return found == known_.end() ? nullptr : &found->second;
}

bool Groups::Misses(const GroupSight& group, double tolerance) const {
  if (!group.sought || !group.ended || group.weak) return false;
  const Unknown* unknown = Find(group.id);
  if (unknown != nullptr && (unknown->Decided() || unknown->waits)) return false;
  return !(std::abs(group.Miss()) <= tolerance);
}

void Groups::Merge(const GroupSight& first, const GroupSight& next, Growth why) {
  Unknown& grown = At(first.id);
  // The turn of the last cycle is far from both troughs that may end it: the group's end is stable.
  grown.lasts = next.last_turn - first.start_time;
  grown.mu = grown.first_mu;
  grown.status = Cycle::Status::kNotConverged;
  grown.growth = why;
  grown.corrected = true;
  grown.weak = false;
  grown.too_much = grown.too_little = {};
  known_.erase(next.id);
  std::erase_if(rest_ends_, [&](const auto& entry) {  // Their places change.
    const GroupId& id = entry.first;
    return id.contact == first.id.contact && id.encounter == first.id.encounter &&
           id.place >= first.id.place;
  });
  for (GroupId id = next.id; known_.contains({id.contact, id.encounter, id.place + 1});
       ++id.place) {
    auto node = known_.extract({id.contact, id.encounter, id.place + 1});
    node.key() = node.mapped().id = id;
    known_.insert(std::move(node));
  }
}

void Groups::NoteRestEnd(const GroupId& before, double time) {
  const auto noted = rest_ends_.try_emplace(before, time).first;
  noted->second = std::min(noted->second, time);
}

double Groups::RestEnd(const GroupId& before) const {
  const auto noted = rest_ends_.find(before);
  return noted == rest_ends_.end() ? kNever : noted->second;
}

void Groups::NoteCut(const Sight& sight, double end) {
  const auto until = [](const GroupSight& g) { return g.ended ? g.end_time : kNever; };
  // What comes after a trough may join the group before it.
  const auto before_cut = [&](const GroupSight& g) {
    return until(g) < cut_since_ || (until(g) == cut_since_ && g.separated);
  };
  cut_since_ = kNever;
  for (const GroupSight& g : sight.groups) {
    if (g.sought && g.start_time < end && until(g) > end) {
      cut_since_ = std::min(cut_since_, g.start_time);
    }
  }
  for (bool earlier = true; earlier;) {
    earlier = false;
    for (const GroupSight& g : sight.groups) {
      if (!g.sought || g.start_time >= cut_since_ || before_cut(g)) continue;
      cut_since_ = g.start_time;
      earlier = true;
    }
  }
}

void Groups::ForgetBegun(const State& state) {
  std::erase_if(known_, [&](const auto& entry) { return HasBegun(state, entry.first); });
  std::erase_if(rest_ends_, [&](const auto& entry) {
    const ContactState& contact = state.contacts[static_cast<std::size_t>(entry.first.contact)];
    const bool rests = Rests(contact) && LastGroup(contact) == entry.first;
    return HasBegun(state, entry.first) && !rests;
  });
}

}  // namespace contact
