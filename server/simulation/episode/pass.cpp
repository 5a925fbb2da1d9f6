#include "simulation/episode/pass.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulation/episode/search_options.h"
#include "simulation/episode/timeline.h"
#include "simulation/model/columns.h"
#include "simulation/model/index.h"

namespace contact {
namespace {

// A contact creeps if it has not turned in so many of the times in which it swings, or in which
// what its damping holds back fades: e⁻⁴⁰ is round-off.
constexpr double kPatience = 40;
// Periods of a sine that may turn a contact.
constexpr double kPeriods = 2;
// Cycles after the end of the run that may begin until a pass far beyond it sees no more: one
// contact that creeps may be followed to its end, many that rattle would cost more than they tell.
// Under ENCOUNTER as many for each cycle of a group.
constexpr int kMostLate = 10;
// Steps between two looks at these times; and the steps after which one that an adaptive method
// takes is stuck. With 50,000 settling 88 of the machines takes over a million steps in all, with
// 10,000 press 11 is not solved.
constexpr int kStride = 200, kStuck = 20'000;
// A(ε_in) to which residuals are relative at least, for ε_in near 1.
constexpr double kLeastGoal = 1e-6;
// ε_out below this part of ε_in counts as this: A(0) is infinite.
constexpr double kLeastRestitution = 0.05;

// A group that was negligible is so until its work is this many times what is: its μ, which depends
// on that, changes its work.
constexpr double kStillWeak = 10;

void Add(Eigen::ArrayXd& sum, const Eigen::ArrayXd& gradient) {
  const Eigen::Index known = sum.size();
  sum.conservativeResize(gradient.size());
  sum.tail(gradient.size() - known).setZero();
  sum += gradient;
}

// Paper (30): df/dμ along the trajectory as it is. S_c and S_r, the integrals of δⁿ δ̇ over the
// phases, are what is dissipated in them over μ.
double FrozenSlope(const Cycle& cycle) {
  const double compression = cycle.dissipated_compression / cycle.mu;
  const double restitution = cycle.dissipated_restitution / cycle.mu;
  return (cycle.work_compression * restitution - cycle.work_restitution * compression) /
         (cycle.work_compression * cycle.work_compression);
}

}  // namespace

Pass::Pass(const Scenario& scenario, Motion& motion, Observer& observer, Groups& groups)
    : scenario_(scenario),
      motion_(motion),
      observer_(observer),
      groups_(groups),
      membership_(scenario, motion, groups),
      most_late_(kMostLate) {
  const SolverOptions& options = scenario.solver;
  if (options.restitution_scope == RestitutionScope::kEncounter) {
    most_late_ *= options.encounter_cycles;
  }
  const auto see = [this](const auto& pieces) {
    for (const auto& piece : pieces) {
      if (piece.amplitude == 0 || piece.angular_frequency == 0) continue;
      const double period = 2 * std::numbers::pi / piece.angular_frequency;
      longest_period_ = std::max(longest_period_, std::min(period, piece.end - piece.begin));
    }
  };
  see(scenario.loads);
  see(scenario.drives);
}

Sight Pass::Look(const State& start, const Plan& plan, const std::stop_token& stop,
                 std::int64_t step_limit) {
  plan_ = plan;
  cycles_ = late_cycles_ = running_ = columns_ = 0;
  sight_ = {};
  if (plan.before != nullptr) Continue(*plan.before);
  Stir(start.time);
  enough_ = false;
  membership_.Begin(plan.guess_from);
  motion_.Begin(start, false, plan.tolerance);
  do {
    sight_.pause = motion_.Advance(plan.until, *this, nullptr, stop, step_limit);
    if (sight_.pause == Motion::Pause::kQuiet) sight_.quiet.push_back(motion_.time());
  } while (sight_.pause == Motion::Pause::kQuiet && !plan.first_quiet && !IsOpen() && !enough_ &&
           (motion_.time() < plan.end || running_ > 0 || !plan.block.empty()));
  sight_.time = motion_.time();
  const bool parts = plan.to_miss > 0 && motion_.time() < plan.end && IsLong();
  sight_.crowded = (cycles_ >= plan.most_cycles || parts) && sight_.pause == Motion::Pause::kEnough;
  return std::move(sight_);
}

// The pass sees on from where another one has ended, without slopes by the μ of what had begun.
void Pass::Continue(const Sight& before) {
  sight_.groups = before.groups;
  sight_.quiet = before.quiet;
  for (GroupSight& g : sight_.groups) {
    g.column = kNone;
    g.gradient = {};
    if (!g.ended && Matters(groups_.At(g.id))) ++running_;
  }
}

bool Pass::IsOpen() const {
  return std::ranges::none_of(motion_.contacts(), [](const ContactState& c) {
    return c.phase == Phase::kStarting && !c.settled;
  });
}

// Cycles after the end of the run only show how those before it end.
bool Pass::Counts(const Cycle& cycle) const { return cycle.start_time < plan_.end; }

bool Pass::Matters(const Unknown& unknown) const {
  return unknown.start_time < plan_.end && !unknown.Decided() &&
         IsSought(scenario_, unknown.id.contact);
}

GroupSight* Pass::Seen(const ContactState& state) {
  const GroupId id = Membership::IdOf(state);
  for (auto group = sight_.groups.rbegin(); group != sight_.groups.rend(); ++group) {
    if (group->id == id) return &*group;
  }
  return nullptr;  // It began before the pass.
}

bool Pass::WantsColumn(const GroupId& id) const {
  return plan_.sensitive && columns_ < kMostColumns &&
         (plan_.wide || plan_.block.empty() ||
          std::ranges::find(plan_.block, id) != plan_.block.end());
}

CycleHost::Factor Pass::OnStart(ContactState& state, double effective_mass, double external_force) {
  Stir(state.cycle.start_time);
  const bool opens = !state.member.open && !state.settled;
  const double mu = membership_.Start(state, effective_mass, external_force);
  if (state.settled) return {.mu = mu, .column = state.column};
  const Cycle& cycle = state.cycle;
  ++(Counts(cycle) ? cycles_ : late_cycles_);
  if (cycles_ >= plan_.most_cycles) enough_ = true;
  if (opens) {
    const Contact& contact = scenario_.contacts[At(cycle.contact)];
    const Unknown& unknown = *groups_.Find(Membership::IdOf(state));
    GroupSight& made = sight_.groups.emplace_back();
    made.id = unknown.id;
    made.mu = mu;
    made.sought = IsSought(scenario_, cycle.contact);
    if (!IsGiven(contact.damping)) made.restitution_in = contact.restitution;
    made.first_cycle = cycle.number;
    made.start_time = cycle.start_time;
    made.after_rest = state.member.after_rest;
    if (unknown.weak && mu == state.last_mu) {  // It keeps that μ, and so its column.
      made.column = state.column;
    } else if (made.sought && mu > 0 && WantsColumn(made.id)) {
      made.column = columns_++;
    }
    if (Matters(unknown)) ++running_;
  }
  const GroupSight* seen = Seen(state);
  if (seen == nullptr) return {.mu = mu};
  const Unknown& unknown = *groups_.Find(seen->id);
  return {.mu = mu, .column = seen->column, .length = unknown.length, .speed = unknown.speed};
}

double Pass::OnRelease(ContactState& state, double effective_mass) {
  const double mu = membership_.Release(state, effective_mass);
  if (GroupSight* seen = Seen(state); seen != nullptr) {
    seen->mu = mu;
    seen->released = true;
    seen->sought = false;
    seen->column = kNone;
  }
  return mu;
}

double Pass::RestEnds(const ContactState& state) { return membership_.RestEnd(state); }

// Notes when the rest ends: the pass shows nothing, and is to begin anew.
bool Pass::OnDisturbed(const ContactState& state, double cause) {
  if (!plan_.retries) return true;
  groups_.NoteRestEnd(LastGroup(state), cause);
  enough_ = sight_.disturbed = true;
  return false;
}

void Pass::OnCancel(ContactState& state) {
  --(Counts(state.cycle) ? cycles_ : late_cycles_);
  const GroupId id = Membership::IdOf(state);
  const Unknown* unknown = groups_.Find(id);
  if (!membership_.Cancel(state) || unknown == nullptr) return;
  if (Matters(*unknown)) --running_;
  std::erase_if(sight_.groups, [&](const GroupSight& g) { return g.id == id; });
}

void Pass::OnEnd(ContactState& state, const Eigen::ArrayXd& compression_gradient,
                 const Eigen::ArrayXd& restitution_gradient, double length, double speed) {
  const Cycle& cycle = state.cycle;
  idle_steps_ = 0;
  GroupSight* seen = state.member.open ? Seen(state) : nullptr;
  const bool ended = membership_.End(state);
  if (seen == nullptr) return;
  ++seen->cycles;
  seen->last_turn = cycle.turn_time;
  seen->end_time = cycle.end_time;
  seen->work_compression = state.member.group.work_compression;
  seen->work_restitution = state.member.group.work_restitution;
  seen->frozen_slope = FrozenSlope(cycle);
  seen->depth = std::max(seen->depth, cycle.max_deformation);
  if (seen->cycles == 1) seen->length = length, seen->speed = speed;
  Add(seen->gradient_compression, compression_gradient);
  Add(seen->gradient_restitution, restitution_gradient);
  if (!ended) return;
  seen->ended = true;
  seen->separated = cycle.end == Cycle::End::kSeparation;
  const Unknown& known = *groups_.Find(seen->id);
  // With the μ of the cycle before a group may last for two cycles, which are not negligible, and
  // with its own μ for one, which is: without a bound it changes without end.
  seen->weak = known.flips > kSearch.revisions
                   ? known.weak
                   : seen->cycles == 1 && membership_.IsWeak(state, known.weak ? kStillWeak : 1);
  Measure(*seen);
  if (Matters(*groups_.Find(seen->id))) --running_;
  enough_ = enough_ || Enough();
}

// A(ε), the coefficient of the isolated collision with that restitution, is the coordinate in
// which the problem is solved: for a collision without external forces μ ↦ A(ε_out) is a straight
// line, and Newton is at its root in one step.
void Pass::Measure(GroupSight& group) const {
  group.squared = -group.work_restitution / group.work_compression;
  if (!group.sought || !std::isfinite(group.squared)) return;  // Infinite: no work was stored.
  const double in = group.restitution_in;
  const double wanted = ExactCoefficient(in), scale = std::max(wanted, kLeastGoal);
  const double e = std::max(std::sqrt(std::max(group.squared, 0.0)), kLeastRestitution * in);
  const double a = ExactCoefficient(e);
  const double denominator = (1 - a * e) - e * e * (1 + a);
  const double slope = std::abs(1 - e) < 1e-5 ? -1.5 : a * e * (1 + a) / denominator;  // dA/dε
  group.residual = (a - wanted) / scale;
  group.gradient = -slope / (2 * e) / scale / group.work_compression *
                   (group.gradient_restitution + group.squared * group.gradient_compression);
}

bool Pass::BlockHasEnded() const {
  return std::ranges::all_of(plan_.block, [&](const GroupId& id) {
    const GroupSight* seen = sight_.Find(id);
    return seen != nullptr && seen->ended;
  });
}

// Whether the next group that misses has ended, with all that overlap it where these are few.
bool Pass::ShowsMiss() const {
  const auto of_block = [&](const GroupSight& g) {
    return g.start_time < plan_.end && groups_.Misses(g, plan_.to_miss) &&
           std::ranges::find(plan_.block, g.id) != plan_.block.end();
  };
  if (std::ranges::any_of(sight_.groups, of_block)) return true;
  const Timeline timeline(sight_, groups_, plan_.end, [](const GroupId&) { return false; });
  return timeline.ShowsMiss(plan_.to_miss, kSearch.at_once);
}

bool Pass::Enough() const {
  const bool seen = BlockHasEnded();
  if (!plan_.block.empty() && (!seen || plan_.to_miss == 0)) return seen;
  if (running_ == 0 && motion_.time() >= plan_.end) return true;
  return plan_.to_miss > 0 && (IsLong() || ShowsMiss());
}

// Whether the pass has seen a block's worth of groups, and none of them runs any more: what loads
// press may make one cycle after the other for ever. Fewer are recorded before a later group can
// join them: with eight, five more of 500 driven runs are PARTIAL. Fixed steps may be very many:
// with 30 groups the first NIRV cycles of spring-wall at 1e-7 s are told after 4 to 8 million.
bool Pass::IsLong() const {
  const std::size_t most = scenario_.solver.fixed_step > 0 ? kSearch.at_once : kSearch.block;
  return running_ == 0 && sight_.groups.size() >= most;
}

// A cycle begins or ends.
void Pass::Stir(double time) {
  idle_since_ = time;
  idle_steps_ = 0;
}

// The longest of the times in which the contacts whose cycles run would turn alone.
double Pass::SlowestTurn() const {
  double slowest = 0;
  const double* y = motion_.integrator().y0.data();
  for (const ActiveContact& active : motion_.equations().active) {
    if (!IsRunning(motion_.contacts()[At(active.contact)])) continue;
    const double deformation = active.Relative(y) - active.gap;
    const double stiffness = active.StiffnessAt(deformation);
    const double inverse_mass = active.left_inverse + active.right_inverse;
    const double swing = 2 * std::numbers::pi / std::sqrt(stiffness * inverse_mass);
    slowest = std::max({slowest, swing, active.DampingAt(deformation) / stiffness});
  }
  return slowest;
}

// Whether nothing has begun or ended for longer than the contacts would take to turn. A ramp may
// turn them where it ends.
bool Pass::Creeps() const {
  double since = idle_since_;
  const auto see = [&](const auto& pieces, auto slope) {
    for (const auto& row : pieces.rows()) {
      const auto begun = pieces.Begun(row, motion_.time());
      const auto ramp = std::find_if(begun.rbegin(), begun.rend(), [slope](const auto& piece) {
        return piece.*slope != 0 && piece.end != kNever;
      });
      if (ramp != begun.rend()) since = std::max(since, ramp->end);
    }
  };
  see(motion_.equations().loads(), &Load::slope);
  see(motion_.equations().drives(), &Drive::jerk);
  return motion_.time() - since > kPatience * SlowestTurn() + kPeriods * longest_period_;
}

// Far beyond the end of the run a pass has seen enough of it, or nothing for long.
bool Pass::SeesFar() const {
  if (motion_.time() <= plan_.far) return false;
  return late_cycles_ >= most_late_ || motion_.time() - idle_since_ > plan_.far - plan_.end;
}

bool Pass::OnStep() {
  observer_.OnStep();
  enough_ = enough_ || SeesFar() || (motion_.time() > plan_.block_until && !BlockHasEnded());
  if (++idle_steps_ % kStride != 0 || plan_.patient) return !enough_;
  const bool stuck = scenario_.solver.fixed_step == 0 && idle_steps_ > kStuck;
  enough_ = enough_ || stuck || Creeps();
  return !enough_;
}

}  // namespace contact
