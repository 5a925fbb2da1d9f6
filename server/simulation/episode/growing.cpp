#include "simulation/episode/growing.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "simulation/episode/search_options.h"

namespace contact {
namespace {

// A neighbour whose work is less than this part of the works that a group misses its balance by
// cannot settle it: of a contact that a ramp presses groups would take in one swing after another.
// More refuses what helps: 0.3 leaves wall 152 and support 429 of simulation_campaign unsolved; 0
// eleven of 40 presses. Loads.WhatTheyHoldIsLimited….
constexpr double kShare = 0.1;
// A group lasts so much longer at least when it takes in the next. With μ on the other side of a
// trough it may take in the same again and again: 6 of 125 clamped rods spend 3 million steps.
// LongRowSearch.AGroupLastsLongerWhenItGrows.
constexpr double kLonger = 1.01;
// A change of what is around a group by less than this gives it no root that it had not. Scanned
// again for every change, 2 more of 40 stacks of the machines spend a million steps.
constexpr double kSame = 1e-3;
// A cycle that jumps alone has a μ so far, relative, beside its jump: on its very edge the least
// change of a neighbour's μ makes it jump, so that the neighbour has no root either.
// Episode.ACycleThatJumpsPastItsRestitutionIsInfeasibleAlone.
constexpr double kBeside = 1e-3;

GroupId Neighbour(GroupId id, int places) {
  id.place += places;
  return id;
}

}  // namespace

// Whether the balance of a group, which misses for every μ, can be settled with this neighbour.
// Jumps may follow each other from trough to trough, 430 of them in damper 13 of the machines, so a
// group has no more cycles than a block has groups; the longest of 3,000 scenarios has ten.
bool Growing::Settles(const GroupSight& group, const GroupSight& neighbour, Growth why) {
  if (std::cmp_greater(group.cycles + neighbour.cycles, kSearch.block)) return false;
  if (why != Growth::kTooLittle && why != Growth::kTooMuch) return true;
  const double in = group.restitution_in;
  const double work = why == Growth::kTooMuch  // What comes back of the one before can only go.
                          ? in * in * neighbour.work_compression
                          : std::max(neighbour.work_compression, -neighbour.work_restitution);
  return neighbour.cycles == 0 || work >= kShare * group.Missing();
}

bool Growing::TakeNext(const GroupId& id, Growth why) {
  const GroupId next = Neighbour(id, 1);
  const Sight sight = problem_.Evaluate({id, next}, false, kForever);
  const GroupSight* here = sight.Find(id);
  const GroupSight* there = sight.Find(next);
  if (here == nullptr || !here->ended || here->separated) return false;
  if (there == nullptr || there->after_rest || !Settles(*here, *there, why)) return false;
  GroupSight taken = *there;
  // Of one that does not end in sight the group takes what there is: it is unfinished then.
  if (taken.cycles == 0) taken.last_turn = (taken.start_time + sight.time) / 2;
  const double lasts = taken.last_turn - here->start_time;
  if (lasts < kLonger * problem_.groups.At(id).lasts) return false;
  problem_.groups.Merge(*here, taken, why);
  log_.Grow(sight, id, problem_.groups.At(id));
  return true;
}

bool Growing::JoinPrevious(const GroupId& id, Growth why) {
  const GroupId before = Neighbour(id, -1);
  if (problem_.groups.Find(before) == nullptr) return false;  // It was recorded already.
  const Sight sight = problem_.Evaluate({before, id}, false, kForever);
  const GroupSight* here = sight.Find(id);
  const GroupSight* there = sight.Find(before);
  if (here == nullptr || here->cycles == 0 || there == nullptr || !there->sought) return false;
  if (here->after_rest || !Settles(*here, *there, why)) return false;
  problem_.groups.Merge(*there, *here, why);
  log_.Grow(sight, before, problem_.groups.At(before));
  return true;
}

bool Growing::Grow(const GroupId& id, Growth why) {
  if (problem_.scenario().solver.restitution_scope == RestitutionScope::kCycle) return false;
  if (why == Growth::kTooMuch && JoinPrevious(id, why)) return true;
  if (why == Growth::kTooMuch && id.place > 1) return false;  // What is before it is final.
  // The trough that ends the group may be there on one side of what was sought only.
  Unknown& unknown = problem_.groups.At(id);
  const double here = unknown.mu;
  for (const double mu : {here, unknown.too_little.mu, unknown.too_much.mu}) {
    if (std::isnan(mu)) continue;
    unknown.mu = mu;
    if (TakeNext(id, why)) return true;
  }
  unknown.mu = here;
  return why != Growth::kTooMuch && JoinPrevious(id, why);
}

// Whether the run ends before a group does, with its first guess; it then has that.
bool Growing::IsCut(const GroupId& id) {
  Unknown& unknown = problem_.groups.At(id);
  const double mu = std::exchange(unknown.mu, unknown.first_mu);
  const Sight sight = problem_.Evaluate({id}, false, kForever);
  const GroupSight* g = sight.Find(id);
  const bool ends = g != nullptr && g->ended && g->end_time <= problem_.end();
  if (ends) unknown.mu = mu;
  return !ends;
}

bool Growing::Answer(const GroupSight& group, Root root) {
  const Growth why = root == Root::kTooLittle ? Growth::kTooLittle
                     : root == Root::kTooMuch ? Growth::kTooMuch
                                              : Growth::kJump;
  const bool ends = root == Root::kTooLittle && group.ended && group.end_time <= problem_.end();
  // One that was found to be cut, and ended after all, might be found so again and again.
  const bool again = problem_.groups.At(group.id).reopened > 0;
  if ((ends || again || !IsCut(group.id)) && Grow(group.id, why)) return true;
  if (problem_.Aborted() || !IsCut(group.id)) return problem_.Aborted();
  problem_.groups.At(group.id).status = Cycle::Status::kUnfinished;
  return true;
}

// A group that has no solution keeps what comes nearest. One that loads drive, whose μ hardly
// matters, keeps its first guess: what gives back too much for every μ, and what a rest follows in
// which loads hold what it has stored.
void Growing::Decide(const GroupId& id, Root root) const {
  Unknown& unknown = problem_.groups.At(id);
  const bool alone = problem_.scenario().solver.restitution_scope == RestitutionScope::kCycle;
  const bool opens = root == Root::kTooMuch && !std::isnan(unknown.too_little.mu);  // Does not end.
  const bool jumps = !alone && (root == Root::kJump || opens);
  const bool limited = !alone && root != Root::kJump && !opens;
  unknown.status = jumps     ? Cycle::Status::kJump
                   : limited ? Cycle::Status::kLimited
                             : Cycle::Status::kInfeasible;
  if (root == Root::kTooLittle) unknown.mu = alone ? 0 : unknown.first_mu;
  if (root == Root::kTooMuch) unknown.mu = opens ? unknown.too_much.mu : unknown.first_mu;
  if (root == Root::kJump && alone) {
    const bool falls = unknown.too_much.mu < unknown.too_little.mu;
    unknown.mu = unknown.too_much.mu * (falls ? 1 - kBeside : 1 + kBeside);
  }
}

void Growing::Force(const GroupId& id) {
  if (Grow(id, Growth::kNoProgress) || problem_.Aborted()) return;
  problem_.groups.At(id).given_up = true;
}

// Whether with the μ of one side still too much, by the sign, or too little comes back.
bool Growing::Holds(const GroupSight& group, const Group::Reached& side, double sign) {
  if (std::isnan(side.mu)) return true;
  Unknown& unknown = problem_.groups.At(group.id);
  const double kept = std::exchange(unknown.mu, side.mu);
  const double until = side.restitution > 0 ? kForever : group.start_time + unknown.tried;
  const Sight sight = problem_.Evaluate({group.id}, false, until);
  unknown.mu = kept;
  const GroupSight* seen = sight.Find(group.id);
  const bool ended = seen != nullptr && seen->ended;
  return sign * (ended ? seen->Miss() : -1) > 0;
}

// Whether a group was not scanned with what is now around it.
bool Growing::IsNew(const GroupSight& group, const Sight& scan, Scanned* scanned) {
  double sum = 0;
  for (const GroupSight& g : scan.groups) sum += g.start_time < group.end_time ? g.mu : 0;
  const auto known = scanned->try_emplace(group.id, kNaN).first;
  if (!group.ended || std::abs(known->second - sum) <= kSame * sum) return false;
  known->second = sum;
  return true;
}

// Whether a solved group is to be scanned for a smaller root.
bool Growing::MayHaveLess(const GroupSight& group) const {
  const Unknown& unknown = problem_.groups.At(group.id);
  return group.sought && !group.weak && unknown.status == Cycle::Status::kConverged &&
         std::ssize(unknown.other_roots) < kSearch.revisions;
}

// How many groups a pass has seen overlap this one in time; the group itself counts.
std::ptrdiff_t Growing::Overlapping(const GroupSight& group, const Sight& scan) {
  return std::ranges::count_if(scan.groups, [&](const GroupSight& g) {
    return g.start_time < group.end_time && (!g.ended || g.end_time > group.start_time);
  });
}

// Whether a group has a smaller root than the one found, and is to be sought from there. A cycle
// that is solved alone stays: what it leaves to the next may have no root. So does a group that
// many overlap: in a row of 40 balls scans take more steps than all else
// (LongRowGuess.APoorOneIsMadeAgain).
bool Growing::HasLess(const GroupSight& group, const Sight& scan) {
  if (problem_.scenario().solver.restitution_scope == RestitutionScope::kCycle) return false;
  if (!MayHaveLess(group)) return false;
  const bool many = std::cmp_greater(Overlapping(group, scan), kSearch.at_once);
  if (many || !IsNew(group, scan, &scanned_below_)) return false;
  Unknown& unknown = problem_.groups.At(group.id);
  const double root = unknown.mu;
  if (!bisection_.ScanBelow(group)) return false;
  unknown.other_roots.push_back(root);
  return true;
}

bool Growing::Reopen(const Sight& scan, double before) {
  for (const GroupSight& g : scan.groups) {
    if (g.start_time >= before) break;
    Unknown& unknown = problem_.groups.At(g.id);
    const bool without = unknown.status == Cycle::Status::kJump ||
                         unknown.status == Cycle::Status::kLimited ||
                         unknown.status == Cycle::Status::kInfeasible;
    // One that was given up may have its answer now: what overlaps it has been solved since.
    if (unknown.given_up && unknown.reopened == 0 && g.ended && !g.weak &&
        !(std::abs(g.Miss()) <= problem_.tolerance())) {
      ++unknown.reopened;
      unknown.given_up = false;
      return true;
    }
    if (problem_.Aborted()) break;
    if (HasLess(g, scan)) return true;
    if (!without) continue;
    // What loads limit may have a root while all else is held, and none with all else solved.
    const bool refuted =
        unknown.status == Cycle::Status::kLimited && unknown.reopened == kSearch.revisions;
    if (refuted) continue;
    const bool found = IsNew(g, scan, &scanned_) && bisection_.Scan(g);
    if (!found && Holds(g, unknown.too_much, 1) && Holds(g, unknown.too_little, -1)) continue;
    unknown.given_up = unknown.reopened == kSearch.revisions;
    if (!unknown.given_up) ++unknown.reopened;
    unknown.status = Cycle::Status::kNotConverged;
    return true;
  }
  return false;
}

bool Growing::Close(const Sight& scan) {
  for (const GroupSight& g : scan.groups) {
    // What went on beyond the end of the run need not end.
    if (g.ended || !g.sought || g.start_time >= problem_.end()) continue;
    Unknown& unknown = problem_.groups.At(g.id);
    if (unknown.Decided()) continue;
    unknown.mu = unknown.first_mu;
    unknown.status = Cycle::Status::kUnfinished;
    return true;
  }
  return false;
}

}  // namespace contact
