#include "simulation/episode/bisection.h"

#include <algorithm>
#include <cmath>

#include "simulation/episode/search_options.h"
#include "simulation/laws/isolated_collision.h"

namespace contact {
namespace {

// A root is as near as Newton needs it to go on, and as a coarse pass can tell.
constexpr double kRoot = 1e-4;
// In brackets wider than this part of μ passes look as coarsely as the march: a pass moves a jump
// by some times its error. Those that decide are as exact as the scenario asks. In narrower ones
// ends that are so far apart, in durations of the group, are those of two troughs: with a
// thousandth a ball that hardly bounces takes in 109 cycles.
// Machines.AreSolvedWhereTheyHardlyBounce.
constexpr double kWide = 1e-3, kElsewhere = 0.05;
// Where the group was nearer than this its root is looked for nearby, so much further off than an
// isolated collision has it, as a power.
constexpr double kClose = 0.5, kBeyondRoot = 1.5;
constexpr double kGrow = 4;  // Factor between two μ in search of a bracket.
// Of a scan, of a search of a bracket, and of the search in one: a guard.
constexpr int kMostPasses = 120;
// A scan begins at this part of the first guess, or of the root, and goes on by this factor.
constexpr double kLowest = 1e-3, kFine = 1.25;
// A scan below a root goes by this factor, up to this part of the root: eight passes. A larger
// factor misses narrow troughs, a smaller one costs more. SmallestRoot.IsTheAnswer.
constexpr double kCoarse = 3, kBelow = 0.9;
// A group that lasts at μ = 0 between these parts of what it lasts at its root ends alike, and is
// not scanned. Of 3,845 groups of random scenarios that begin at rest or compressed 84 have a
// smaller root, 77 of which last less or more; so do 20 % of the others.
constexpr double kShortest = 0.6, kLongest = 1.5;
// After so many μ with which the group does not end there is none with which it does: 9 times more.
constexpr int kMostOpen = 10;
// A bracket holds a jump if it is so narrow, relative, in units of what a root may miss by: ε²
// would have to change a thousand times as fast as μ. At 1e-11 always two of 100 presses take 1.4
// times the steps. NoRoot.*.
constexpr double kNarrow = 1e-3;
// One whose other side does not end holds none if it is so narrow, and if what is left would have
// to fall so many times as fast as it did.
constexpr double kCreeps = 0.05, kSteeper = 4;
// How much longer than before a trial may last, in durations of the group.
constexpr double kLongerPass = 10;

}  // namespace

Bisection::Point Bisection::At(double mu, bool slope) {
  Unknown& unknown = problem_.groups.At(group_.id);
  unknown.mu = mu;
  unknown.corrected = true;
  const Sight sight = problem_.Evaluate({group_.id}, slope, until_, error_);
  const GroupSight* seen = sight.Find(group_.id);
  Point point{.mu = mu, .excess = -1, .there = seen != nullptr};
  if (seen != nullptr && seen->ended && std::isfinite(seen->squared)) {
    const double square = group_.restitution_in * group_.restitution_in;
    point.excess = seen->squared / square - 1;
    if (seen->column != kNone) point.slope = seen->SlopeOfSquare() / square;
    point.most = seen->weak ? mu : problem_.MostMu(*seen);  // Of next to nothing noise is left.
    point.end = seen->end_time;
  } else {
    point.ended = false;
  }
  return point;
}

Root Bisection::Finish(Root root) {
  Unknown& unknown = problem_.groups.At(group_.id);
  const auto reached = [&](const Point& p) {
    return Group::Reached{
        .mu = p.mu, .restitution = group_.restitution_in * std::sqrt(1 + std::max(p.excess, -1.0))};
  };
  if (root != Root::kFound && root != Root::kJump) unknown.mu = group_.mu;
  unknown.tried = until_ - group_.start_time;
  unknown.too_much = more_.there ? reached(more_) : Group::Reached{};
  unknown.too_little = less_.there ? reached(less_) : Group::Reached{};
  return root;
}

Root Bisection::Solve(const GroupSight& group, double near) {
  group_ = group;
  near_ = std::min(near, kRoot);
  until_ = group.end_time + kLongerPass * (group.end_time - group.start_time);
  error_ = kSearch.ahead_tolerance;
  const Root root = Exactly(Look());
  return root == Root::kFound || root == Root::kAborted ? root : Finish(root);
}

// What coarse passes have found, if exact ones confirm it; else they go on, or look anew.
Root Bisection::Exactly(Root root) {
  error_ = 0;
  if (!problem_.Aborted() && !Confirmed(root)) {
    root = more_.there && less_.there && Holds() ? Narrow() : Look();
  }
  return problem_.Aborted() ? Root::kAborted : root;
}

bool Bisection::Scan(const GroupSight& group) {
  group_ = group;
  near_ = kRoot;
  until_ = kForever;
  error_ = kSearch.ahead_tolerance;
  below_ = kForever;
  const Unknown kept = problem_.groups.At(group.id);
  Point last = At(0);
  double mu = kLowest * (kept.first_mu > 0 ? kept.first_mu : group.mu);
  int open = 0;
  for (int i = 0; i < kMostPasses && open < kMostOpen && !problem_.Aborted(); ++i, mu *= kFine) {
    const Point point = At(mu, true);
    open = point.ended ? 0 : open + 1;
    if (!point.there || (point.ended && mu >= point.most)) break;
    if (HasRoot(last, point)) return true;
    last = point;
  }
  problem_.groups.At(group.id) = kept;
  return false;
}

bool Bisection::ScanBelow(const GroupSight& group) {
  group_ = group;
  near_ = kRoot;
  until_ = group.end_time + kLongerPass * (group.end_time - group.start_time);
  error_ = kSearch.ahead_tolerance;
  below_ = kBelow * group.mu;
  const Groups kept = problem_.groups;
  Point last = At(0);
  bool found = false, goes_on = !Falls(last);
  for (double part = kLowest; goes_on; part *= kCoarse) {
    const Point point = At(std::min(part, kBelow) * group.mu, true);
    goes_on = part < kBelow && !problem_.Aborted();
    found = !IsRoot(point) && HasRoot(last, point);
    goes_on &= !found;
    last = point;
  }
  if (!found) problem_.groups = kept;
  return found;
}

// Whether ε(μ) seems to fall all the way from μ = 0 to the root: the group ends there at the same
// trough or separation, for it lasts about as long.
bool Bisection::Falls(const Point& undamped) const {
  const double lasts = (undamped.end - group_.start_time) / (group_.end_time - group_.start_time);
  return undamped.excess > 0 && lasts > kShortest && lasts < kLongest;
}

// Whether there is a root between two points of a scan. Where both are on the same side there may
// be two, or one and a jump, if a tangent at one of them leads to the other side before the other.
bool Bisection::HasRoot(const Point& from, const Point& to) {
  if ((from.excess > 0) != (to.excess > 0)) return HasRootIn(from, to);
  for (const Point& end : {from, to}) {
    const double mu = end.mu - end.excess / end.slope;
    if (!end.ended || !(mu > from.mu && mu < to.mu) || problem_.Aborted()) continue;
    const Point between = At(mu);
    const bool crosses = between.there && (between.excess > 0) != (from.excess > 0);
    return crosses && (HasRootIn(from, between) || HasRootIn(between, to));
  }
  return false;
}

// Whether there is a root, below what a scan asks for, between two points on different sides.
bool Bisection::HasRootIn(const Point& from, const Point& to) {
  Keep(from), Keep(to);
  const bool found = Exactly(Narrow()) == Root::kFound;
  error_ = kSearch.ahead_tolerance;
  return found && problem_.groups.At(group_.id).mu < below_;
}

Root Bisection::Look() {
  more_ = less_ = {.there = false};
  const Point first = At(group_.mu);
  if (problem_.Aborted()) return Root::kAborted;
  if (IsRoot(first)) return Root::kFound;
  Keep(first);
  Approach(first);
  if (problem_.Aborted()) return Root::kAborted;
  const Root bracket = more_.there && less_.there ? Root::kFound : Bracket();
  return bracket == Root::kFound && more_.there && less_.there ? Narrow() : bracket;
}

// Whether exact passes see what the coarse ones saw: the root, or that there is none.
bool Bisection::Confirmed(Root root) {
  const double mu = problem_.groups.At(group_.id).mu;
  if (root == Root::kFound) return IsRoot(At(mu));
  const bool confirmed = Holds();
  problem_.groups.At(group_.id).mu = mu;
  return confirmed;
}

// Coarse passes tell no less than what Newton needs to go on.
bool Bisection::IsRoot(const Point& point) const {
  return std::abs(point.excess) < (error_ > 0 ? kRoot : near_);
}

// Whether both sides of the bracket are what they were; takes them as they are now.
bool Bisection::Holds() {
  for (Point* side : {&more_, &less_}) {
    if (!side->there) continue;
    const Point now = At(side->mu);
    const bool holds = now.there && now.ended == side->ended &&
                       (now.excess > 0) == (side == &more_) && !IsRoot(now);
    *side = now;
    if (!holds) return false;
  }
  return true;
}

void Bisection::Keep(const Point& point) {
  if (point.excess > 0 && more_.there) {
    fall_ = (more_.excess - point.excess) / std::abs(point.mu - more_.mu);
  }
  (point.excess > 0 ? more_ : less_) = point;
}

// Whether the bracket is so narrow that no root can be in it.
bool Bisection::HasNone() const {
  const double width = std::abs(less_.mu - more_.mu), mu = std::max(less_.mu, more_.mu);
  if (!less_.ended && width <= kCreeps * mu) return more_.excess > kSteeper * fall_ * width;
  if (width <= kWide * mu && PartsTroughs()) return true;
  return width <= kNarrow * near_ * mu;
}

// Whether the group ends at different troughs on the two sides, so that what is between is a jump.
bool Bisection::PartsTroughs() const {
  const double end = std::max(less_.end, more_.end);
  return less_.ended && std::abs(less_.end - more_.end) > kElsewhere * (end - group_.start_time);
}

// Looks beyond a root that is near, where an isolated collision would have it: A(ε) falls as 1/μ.
void Bisection::Approach(const Point& first) {
  if (!first.ended || first.mu == 0 || std::abs(first.excess) > kClose) return;
  const double in = group_.restitution_in, out = in * std::sqrt(1 + first.excess);
  if (out >= 1) return;
  const double ratio = ExactCoefficient(in) / ExactCoefficient(out);
  const Point beyond = At(first.mu * std::pow(ratio, kBeyondRoot));
  if (beyond.there) Keep(beyond);
}

// Looks for what the first point lacks: more at μ = 0, less at ever larger μ.
Root Bisection::Bracket() {
  if (less_.there) {
    if (less_.mu == 0) return Root::kTooLittle;
    const Point first = less_;
    Keep(At(0));
    double mu = first.mu;
    for (int i = 0; i < kMostPasses && !first.ended && !more_.there; ++i) Keep(At(mu /= kGrow));
    if (problem_.Aborted()) return Root::kAborted;
    return more_.there ? Root::kFound : Root::kTooLittle;
  }
  const Contact& contact =
      problem_.scenario().contacts[static_cast<std::size_t>(group_.id.contact)];
  double mu = more_.mu > 0 ? more_.mu : 1e-3 * contact.stiffness;
  for (int i = 0; i < kMostPasses && mu < more_.most && !less_.there; ++i) {
    mu *= kGrow;
    const Point point = At(mu);
    if (problem_.Aborted()) return Root::kAborted;
    if (!point.there) break;
    Keep(point);
  }
  return less_.there ? Root::kFound : Root::kTooMuch;
}

// Regula falsi, with ever less weight for a side that stays, and halving every third time.
Root Bisection::Narrow() {
  double weight_of_less = 1;
  bool was_more = false;
  for (int i = 0; i < kMostPasses && !HasNone(); ++i) {
    const double width = less_.mu - more_.mu;
    const double wide = std::abs(width) / (kWide * std::max(less_.mu, more_.mu));
    if (error_ > 0) error_ = kSearch.ahead_tolerance * std::min(1.0, wide);
    const double weight = more_.excess / (more_.excess - weight_of_less * less_.excess);
    const bool far = more_.mu > 0 && less_.mu > 10 * more_.mu;
    const double half = far ? std::sqrt(more_.mu * less_.mu) : more_.mu + 0.5 * width;
    const bool linear = i % 3 != 2 && !far && less_.ended;
    const Point point = At(linear ? more_.mu + weight * width : half);
    if (problem_.Aborted()) return Root::kAborted;
    if (IsRoot(point)) return Root::kFound;
    const bool more = point.excess > 0;
    weight_of_less = i == 0 || more != was_more ? 1 : weight_of_less * (more ? 0.5 : 2);
    was_more = more;
    Keep(point);
  }
  const bool more_is_nearer = !less_.ended || more_.excess < -less_.excess;
  problem_.groups.At(group_.id).mu = more_is_nearer ? more_.mu : less_.mu;
  return less_.ended ? Root::kJump : Root::kTooMuch;
}

}  // namespace contact
