#include "simulation/proof/metamorphic.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "simulation/proof/ledger.h"
#include "simulation/proof/promises.h"

namespace contact::testing {
namespace {

// A counterpart has as many cycles, and begins and ends at the times of a group, to these parts of
// its duration. A contact in a row of touching balls begins when its deformation is more than
// round-off, which the tolerance decides; one that creeps ends when its speed is less than that.
constexpr double kSameStart = 0.1, kSameEnd = 0.25;

class Comparison {
 public:
  Comparison(const Scenario& scenario, const Record& run, const Restated& other,
             const Record& again)
      : s_(scenario), run_(run), other_(other), again_(again) {}

  Difference Result() {
    if (!other_.longer) {
      if (!IsFull(again_) && IsFull(run_)) Take(1, "not FULL");
      Velocities();
    }
    for (const Group& g : run_.groups) {
      if (IsAnswered(g) && !(other_.longer && g.beside_cut)) Compare(g);
    }
    return result_;
  }

 private:
  static bool IsFull(const Record& run) {
    return run.outcome.end == Outcome::End::kFinished && run.outcome.all_converged;
  }

  void Take(double value, const std::string& what) {
    result_.Take(value, what + ' ' + std::string(other_.how));
  }

  // Of contacts that the end cuts μ is not known, nor how their bodies move then, nor those with
  // which these touch.
  std::vector<bool> CutBodies() const {
    std::vector<bool> cut(s_.bodies.size());
    const auto join = [&](const Cycle& c, bool cuts) {
      const Contact& contact = s_.contacts[static_cast<std::size_t>(c.contact)];
      for (const int body : {contact.left, contact.right}) {
        cuts |= body != kNone && cut[static_cast<std::size_t>(body)];
      }
      for (const int body : {contact.left, contact.right}) {
        if (body != kNone) cut[static_cast<std::size_t>(body)] = cuts;
      }
    };
    for (std::size_t i = 0; i < s_.bodies.size(); ++i) {
      for (const Cycle& c : run_.cycles) {
        const bool open = c.status == Cycle::Status::kCut || c.status == Cycle::Status::kUnfinished;
        if (c.end == Cycle::End::kRunEnd) join(c, open);
      }
    }
    return cut;
  }

  double LargestSpeed() const {
    double largest = 1e-12;
    for (const Body& b : s_.bodies) largest = std::max(largest, std::abs(b.velocity));
    for (const double v : run_.outcome.velocities) largest = std::max(largest, std::abs(v));
    for (const Cycle& c : run_.cycles) {
      const Contact& contact = s_.contacts[static_cast<std::size_t>(c.contact)];
      const double swing = 2 * std::max(0.0, c.work_compression) / EffectiveMass(s_, contact);
      largest = std::max({largest, c.approach_velocity, std::sqrt(swing)});
    }
    return largest;
  }

  void Velocities() {
    const double largest = LargestSpeed();
    const std::vector<bool> cut = CutBodies();
    for (std::size_t i = 0; i < s_.bodies.size(); ++i) {
      if (cut[i]) continue;
      const auto there = static_cast<std::size_t>(other_.bodies[i]);
      const double v = other_.Velocity(again_.outcome.velocities[there]);
      Take(std::abs(v - run_.outcome.velocities[i]) / largest, "velocity of " + s_.bodies[i].name);
    }
  }

  void Compare(const Group& g) {
    const Contact& contact = s_.contacts[static_cast<std::size_t>(g.contact)];
    const std::string name = "of " + contact.name + " group " + std::to_string(g.number);
    const Group* counterpart = Counterpart(g);
    if (counterpart == nullptr) return Take(1, "no counterpart " + name);
    const double p = DampingExponent(contact.damping, contact.exponent);
    Take(Relative(g.mu, other_.Mu(counterpart->mu, p)), "μ " + name);
    Take(Relative(PeakForce(run_, g), other_.Force(PeakForce(again_, *counterpart))),
         "peak force " + name);
  }

  static double Relative(double a, double b) { return a == b ? 0 : std::abs(b / a - 1); }

  const Group* Counterpart(const Group& g) const {
    const double lasts = g.end_time - g.start_time;
    const auto found = std::ranges::find_if(again_.groups, [&](const Group& there) {
      return there.contact == other_.contacts[static_cast<std::size_t>(g.contact)] &&
             IsAnswered(there) && there.cycles == g.cycles &&
             std::abs(other_.Time(there.start_time) - g.start_time) <= kSameStart * lasts &&
             std::abs(other_.Time(there.end_time) - g.end_time) <= kSameEnd * lasts;
    });
    return found == again_.groups.end() ? nullptr : &*found;
  }

  static double PeakForce(const Record& run, const Group& g) {
    double force = 0;
    for (const Cycle& c : run.cycles) {
      if (c.contact == g.contact && c.group == g.number) force = std::max(force, c.peak_force);
    }
    return force;
  }

  const Scenario& s_;
  const Record& run_;
  const Restated& other_;
  const Record& again_;
  Difference result_;
};

}  // namespace

void Difference::Take(double value, const std::string& at) {
  if (value <= worst || std::isnan(worst)) return;
  worst = value;
  where = at;
}

Difference Compare(const Scenario& scenario, const Record& run, const Restated& other,
                   const Record& again) {
  return Comparison(scenario, run, other, again).Result();
}

Difference CompareWithOtherWords(const Scenario& scenario, const Record& run) {
  Difference worst;
  for (const Restated& other : Restate(scenario)) {
    const Difference found = Compare(scenario, run, other, RunForLedger(other.scenario));
    worst.Take(found.worst, found.where);
  }
  return worst;
}

}  // namespace contact::testing
