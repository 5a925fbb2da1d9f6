#include "simulation/proof/independent.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "simulation/proof/plain_motion.h"
#include "simulation/proof/promises.h"

namespace contact::testing {
namespace {

using Status = Cycle::Status;

// Works and velocities are stationary at instants, where F δ̇ = 0: what is off there by a hundred
// times as much changes nothing else. Of a weak collision a part of its own speed is ten times that
// of the bodies' at least, and cancels in ε.
constexpr double kInstants = 0.01, kWorks = 0.1;
// Local error of a step, relative to the scales; less is lost in round-off.
constexpr double kTolerance = 1e-14;
// From which disagreement on it is asked what is due to the errors of steps: it is less than five
// times what an integration changes by that is as coarse as the run.
constexpr double kDoubtful = 1e-9, kOwn = 5, kLost = 0.01;

// A relative difference, by its weight, and where it is.
struct Finding {
  double value;
  std::string where;
};

// The largest deformation that a row tells; of one that the end cuts, where it is cut.
double Deepest(const Cycle& c) {
  return std::isnan(c.max_deformation) ? std::max(c.start_deformation, c.end_deformation)
                                       : c.max_deformation;
}

double WeightOf(double Disagreement::*which) {
  if (which == &Disagreement::time || which == &Disagreement::overlap) return kInstants;
  if (which == &Disagreement::work || which == &Disagreement::approach) return kWorks;
  return 1;
}

class Independent {
 public:
  Independent(const Scenario& scenario, const Record& run, double tolerance)
      : s_(scenario), run_(run), motion_(scenario, LargestSpeed(), tolerance) {
    for (const Cycle& c : run.cycles) {
      deepest_ = std::max(deepest_, Deepest(c));
      double& deepest = depths_[c.contact];
      deepest = std::max(deepest, Deepest(c));
      Note(c);
    }
    for (const Group& g : run.groups) groups_[{g.contact, g.number}] = &g;
    std::ranges::stable_sort(marks_, {}, [](const Mark& m) { return std::pair(m.time, m.kind); });
  }

  Disagreement Compare(int most_steps) {
    bool arrived = true;
    for (const Mark& mark : marks_) {
      arrived = arrived && motion_.Advance(mark.time, most_steps);
      if (arrived) Apply(mark);
    }
    arrived = arrived && motion_.Advance(run_.outcome.time, most_steps);
    miss_.checked_until = arrived ? run_.outcome.time : motion_.time();
    miss_.steps = motion_.steps();
    if (!arrived) return miss_;
    Overlaps();
    Velocities();
    return miss_;
  }

  const std::vector<Finding>& findings() const { return findings_; }

 private:
  // In this order where they are at one instant.
  struct Mark {
    enum class Kind { kTurn, kEnd, kStart } kind;
    double time;
    const Cycle* cycle;
  };
  struct Works {
    double compression = 0, restitution = 0;
    int cycles = 0;
  };

  const Contact& Of(const Cycle& c) const {
    return s_.contacts[static_cast<std::size_t>(c.contact)];
  }
  // Whether it is an answer of a cycle that moves.
  static bool Counts(const Cycle& c) {
    return c.status != Status::kSettled && c.status != Status::kNotConverged &&
           c.status != Status::kInfeasible && c.status != Status::kUnfinished;
  }
  // Whether the run begins with it: it may have any velocity then.
  static bool StartsPressed(const Cycle& c) { return c.start_time == 0 && c.start_deformation > 0; }
  // Else the run shows too little of its swing for a measure of what it begins with.
  static bool HasTurned(const Cycle& c) { return !std::isnan(c.max_deformation); }
  // The largest change of its deformation.
  static double Swing(const Cycle& c) {
    return Deepest(c) - std::min(c.start_deformation, c.end_deformation);
  }

  void Note(const Cycle& c) {
    marks_.push_back({Mark::Kind::kStart, c.start_time, &c});
    const bool compresses =
        c.turn_time > c.start_time && c.status != Status::kReleased && c.work_compression > 0;
    if (compresses) marks_.push_back({Mark::Kind::kTurn, c.turn_time, &c});
    if (c.end != Cycle::End::kRunEnd) marks_.push_back({Mark::Kind::kEnd, c.end_time, &c});
  }

  void Miss(double Disagreement::*which, double value, const std::string& where) {
    if (std::isnan(value)) value = std::numeric_limits<double>::infinity();
    miss_.*which = std::max(miss_.*which, value);
    findings_.push_back({WeightOf(which) * value, where});
  }
  void Miss(double Disagreement::*which, double value, const Cycle& c, const char* what) {
    Miss(which, value, std::string(what) + " of " + Of(c).name + ' ' + std::to_string(c.number));
  }

  double LargestSpeed() const {
    double largest = 1e-12;  // Of what never moves.
    for (const Body& b : s_.bodies) largest = std::max(largest, std::abs(b.velocity));
    for (const double v : run_.outcome.velocities) largest = std::max(largest, std::abs(v));
    for (const Cycle& c : run_.cycles) {
      const double swing = Frequency(Of(c), Deepest(c)) * Swing(c);
      largest = std::max({largest, c.approach_velocity, swing});
    }
    return largest;
  }

  // ω of the linear swing about a deformation [rad/s].
  double Frequency(const Contact& contact, double depth) const {
    const double n = contact.exponent;
    return std::sqrt(n * contact.stiffness * std::pow(depth, n - 1) / EffectiveMass(s_, contact));
  }

  // Of a cycle; but not of round-off where it hardly swings, nor where its row tells next to
  // nothing of its swing.
  PlainMotion::Scale ScaleOf(const Cycle& c) const {
    const Contact& contact = Of(c);
    const double depth = Counts(c) ? Deepest(c) : std::max(Deepest(c), 0.1 * depths_.at(c.contact));
    const double least = (Counts(c) ? 1e-6 : 1e-4) * depth;
    const double swing = std::max({Swing(c), least, 1e-9 * deepest_});
    const double force = contact.stiffness * std::pow(depth, contact.exponent);
    return {swing, std::max(c.approach_velocity, Frequency(contact, depth) * swing),
            std::fmax(c.work_compression, force * swing)};
  }

  void Apply(const Mark& mark) {
    const Cycle& c = *mark.cycle;
    const PlainMotion::Scale scale = ScaleOf(c);
    if (mark.kind == Mark::Kind::kStart) return Start(c, scale);
    if (mark.kind == Mark::Kind::kTurn) return Turn(c, scale);
    const double rate = std::abs(motion_.Rate(c.contact)) / scale.speed;
    const double depth = std::abs(motion_.Deformation(c.contact)) / scale.deformation;
    if (Counts(c)) {
      Miss(&Disagreement::time, c.end == Cycle::End::kSeparation ? depth : rate, c, "end");
    }
    Works& works = works_[{c.contact, c.group}];
    works.restitution += motion_.Work(c.contact) - compression_[c.contact];
    ++works.cycles;
    ended_[c.contact] = {c.end_time, scale.speed};
    motion_.Disengage(c.contact);
    const auto group = groups_.find({c.contact, c.group});
    if (group != groups_.end() && works.cycles == group->second->cycles) {
      Restitution(*group->second, works, c);
    }
  }

  void Start(const Cycle& c, const PlainMotion::Scale& scale) {
    if (Counts(c)) {
      const double deepest = HasTurned(c) ? Deepest(c) : depths_[c.contact];
      const double path = std::max(deepest, c.approach_velocity * c.start_time);
      Miss(&Disagreement::time,
           std::abs(motion_.Deformation(c.contact) - c.start_deformation) / path, c,
           "deformation at the start");
    }
    const double rate = motion_.Rate(c.contact);
    if (Counts(c) && c.kind == Cycle::Kind::kCollision) {
      Miss(&Disagreement::approach, std::abs(rate - c.approach_velocity) / scale.speed, c, "δ̇⁻");
    } else if (Counts(c) && !StartsPressed(c) && HasTurned(c)) {
      const Ended& before = ended_[c.contact];
      const double speed = std::max(scale.speed, before.at == c.start_time ? before.speed : 0.0);
      Miss(&Disagreement::rest, StartEnergy(c, rate) / (speed * speed), c, "motion at the start");
    }
    Law(c, rate);
    if (c.status == Status::kSettled) rests_[c.contact] = &c;
    compression_[c.contact] = 0;
    motion_.Engage(c.contact, c.mu, scale);
  }

  // What a NIRV cycle begins with, twice over m_e; but not the rest of a swing that lets it settle.
  double StartEnergy(const Cycle& c, double rate) {
    const auto before = rests_.find(c.contact);
    if (before == rests_.end() || before->second->number + 1 != c.number) return rate * rate;
    double largest = 0;
    for (const Cycle& other : run_.cycles) {
      if (other.contact == c.contact && other.number < c.number) {
        largest = std::max(largest, other.work_compression);
      }
    }
    // A rest ends when it is disturbed by four times what settles (rest.cpp).
    const double rest = 4 * s_.solver.settled_nirv_fraction * largest;
    return std::max(0.0, rate * rate - 2 * rest / EffectiveMass(s_, Of(c)));
  }

  void Law(const Cycle& c, double rate) {
    const Contact& contact = Of(c);
    if (contact.damping == DampingLaw::kEnergyRestitution || !Counts(c)) return;
    double mu = contact.mu;
    if (NeedsNoVelocity(contact.damping)) {
      mu = DampingFactor(contact.damping, contact.restitution, contact.stiffness,
                         EffectiveMass(s_, contact));
    } else if (!IsGiven(contact.damping)) {
      const bool collides = c.kind == Cycle::Kind::kCollision;
      if (!collides && contact.reference_velocity == 0) return;  // It keeps its last μ.
      const double v = contact.reference_velocity > 0 ? contact.reference_velocity : rate;
      mu = DampingCoefficient(contact.damping, contact.restitution) * contact.stiffness / v;
    }
    Miss(&Disagreement::law, mu == c.mu ? 0 : std::abs(c.mu / mu - 1), c, "μ of the law");
  }

  void Turn(const Cycle& c, const PlainMotion::Scale& scale) {
    if (Counts(c)) {
      Miss(&Disagreement::time, std::abs(motion_.Rate(c.contact)) / scale.speed, c, "turn");
    }
    compression_[c.contact] = motion_.Work(c.contact);
    works_[{c.contact, c.group}].compression += compression_[c.contact];
  }

  // Of a group of which all cycles were integrated, to the end of its last.
  void Restitution(const Group& g, const Works& works, const Cycle& last) {
    const bool answered = g.status == Status::kConverged || g.status == Status::kGivenLaw;
    if (!answered || !(g.work_compression > 0)) return;
    Miss(&Disagreement::work, std::abs(works.compression / g.work_compression - 1), last, "W_c");
    if (g.status == Status::kGivenLaw && !(g.restitution_out > 0)) return;  // It may pull.
    const double out = std::sqrt(-works.restitution / works.compression);
    Miss(&Disagreement::restitution, std::abs(out / g.restitution_out - 1), last, "ε");
  }

  void Overlaps() {
    double size = 0;
    for (const Body& b : s_.bodies) size = std::max(size, std::abs(b.position) + b.radius);
    for (int c = 0; c < std::ssize(s_.contacts); ++c) {
      const double depth = depths_[c] > 0 ? depths_[c] : deepest_ > 0 ? deepest_ : 1e-6 * size;
      if (motion_.Overlap(c) <= 0) continue;
      const Contact& contact = s_.contacts[static_cast<std::size_t>(c)];
      Miss(&Disagreement::overlap, std::pow(motion_.Overlap(c) / depth, contact.exponent),
           "overlap outside cycles of " + contact.name);
    }
  }

  void Velocities() {
    const double largest = std::max(motion_.fastest(), 1e-12);
    for (int i = 0; i < std::ssize(s_.bodies); ++i) {
      const double v = run_.outcome.velocities[static_cast<std::size_t>(i)];
      Miss(&Disagreement::velocity, std::abs(motion_.Velocity(i) - v) / largest,
           "velocity of " + s_.bodies[static_cast<std::size_t>(i)].name);
    }
  }

  const Scenario& s_;
  const Record& run_;
  PlainMotion motion_;
  std::vector<Mark> marks_;
  std::map<int, double> depths_, compression_;  // Of contacts: δ_m of all; W_c of the cycle.
  // The instant at which the last cycle of a contact ended, and the largest speed of its swing.
  // What begins there has its start from there, as exactly as that swing is known.
  struct Ended {
    double at = -1, speed = 0;
  };
  std::map<int, Ended> ended_;
  std::map<int, const Cycle*> rests_;  // The last row of a contact that is SETTLED.
  double deepest_ = 0;
  std::map<std::pair<int, int>, Works> works_;  // Of the group of a contact.
  std::map<std::pair<int, int>, const Group*> groups_;
  Disagreement miss_;
  std::vector<Finding> findings_;
};

// Errors of steps grow with time, in what rattles ten times with each blow: what is found is so
// much less than it says, and nothing once the way is lost.
void Judge(const std::vector<Finding>& fine, const std::vector<Finding>& coarse,
           Disagreement& miss) {
  double own = 0;
  for (std::size_t i = 0; i < fine.size(); ++i) {
    if (!(fine[i].value <= miss.worst)) miss.worst = fine[i].value;
    if (i >= coarse.size() || own > kLost) continue;
    if (fine[i].value != coarse[i].value) {
      own = std::max(own, std::abs(fine[i].value - coarse[i].value));
    }
    const double sure = fine[i].value - kOwn * own;
    if (sure > miss.sure) miss.sure = sure, miss.where = fine[i].where;
  }
}

}  // namespace

Disagreement CompareWithIndependent(const Scenario& scenario, const Record& run, int most_steps) {
  Independent fine(scenario, run, kTolerance),
      coarse(scenario, run, scenario.solver.relative_tolerance);
  Disagreement miss = fine.Compare(most_steps);
  const bool doubtful = std::ranges::any_of(
      fine.findings(), [](const Finding& f) { return !(f.value <= kDoubtful); });
  if (doubtful) coarse.Compare(most_steps);
  Judge(fine.findings(), doubtful ? coarse.findings() : fine.findings(), miss);
  return miss;
}

}  // namespace contact::testing
