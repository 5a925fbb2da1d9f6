#include "simulation/proof/promises.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <sstream>

namespace contact::testing {
namespace {

class Judge {
 public:
  Judge(const Scenario& scenario, const Record& run, const Promised& promised)
      : s_(scenario), run_(run), promised_(promised) {}

  std::vector<std::string> Judgement() {
    Ending();
    for (const Cycle& c : run_.cycles) {
      Instants(c);
      Values(c);
    }
    for (const Group& g : run_.groups) {
      Restitution(g);
      Unfinished(g);
    }
    return broken_;
  }

 private:
  bool full() const {
    return run_.outcome.end == Outcome::End::kFinished && run_.outcome.all_converged;
  }

  // One word a promise: with the first of what breaks it, or the worst.
  template <class... Parts>
  void Break(const Parts&... parts) {
    std::ostringstream text;
    (text << ... << parts);
    broken_.push_back(text.str());
  }
  template <class... Parts>
  void BreakOnce(const char* promise, const Parts&... parts) {
    if (told_[promise]++ == 0) Break(promise, ' ', parts...);
  }

  void Ending() {
    const Outcome& o = run_.outcome;
    if (o.end == Outcome::End::kNumeric || o.end == Outcome::End::kNotConverged) {
      Break("failed ", o.message);
    }
    for (const auto* values : {&o.positions, &o.velocities}) {
      for (const double x : *values) {
        if (!std::isfinite(x)) BreakOnce("finite", "a body at the end");
      }
    }
    if (o.end != Outcome::End::kFinished) return;
    if (!(std::abs(o.time - s_.end_time) <= 1e-12 * s_.end_time))
      Break("end time ", o.time, " of ", s_.end_time);
    if (!(o.energy_residual <= promised_.balance)) Break("energy ", o.energy_residual);
    if (!(o.momentum_residual <= promised_.balance)) Break("momentum ", o.momentum_residual);
    if (full() && !(o.worst_identity_residual <= promised_.identity)) {
      Break("identity ", o.worst_identity_residual);
    }
  }

  // t_s ≤ t_m ≤ t_o ≤ end, cycles of a contact one after the other, rows by their ends.
  void Instants(const Cycle& c) {
    const auto at = static_cast<std::size_t>(c.contact);
    if (c.end_time > s_.end_time) BreakOnce("beyond the end", c.end_time);
    if (!(c.start_time <= c.end_time) || c.turn_time < c.start_time || c.turn_time > c.end_time) {
      BreakOnce("instants", "of ", s_.contacts[at].name, ' ', c.number);
    }
    if (c.end_time < last_end_) BreakOnce("order", "of rows, at ", c.end_time);
    last_end_ = std::max(last_end_, c.end_time);
    auto& [end, number] = last_[c.contact];
    if (c.start_time < end) BreakOnce("overlap", s_.contacts[at].name, ' ', c.number);
    if (c.number != number + 1) BreakOnce("number", s_.contacts[at].name, ' ', c.number);
    end = c.end_time, number = c.number;
  }

  void Values(const Cycle& c) {
    const auto name = [&] { return s_.contacts[static_cast<std::size_t>(c.contact)].name; };
    const std::array values = {c.start_time, c.end_time, c.start_deformation, c.mu};
    if (!std::ranges::all_of(values, [](double x) { return std::isfinite(x) && x >= 0; })) {
      BreakOnce("values", "of ", name(), ' ', c.number);
    }
    if (c.status != Cycle::Status::kConverged) return;
    const bool compresses = c.max_deformation >= c.start_deformation && c.work_compression > 0;
    if (!compresses && !IsRoundOffOfAGroup(c)) {
      BreakOnce("compression", "of ", name(), ' ', c.number);
    }
  }

  // Of a cycle of next to nothing, which a group of several has taken in, round-off is left.
  bool IsRoundOffOfAGroup(const Cycle& c) const {
    const auto holds = [&](const Group& g) {
      return g.contact == c.contact && g.number == c.group && g.cycles > 1;
    };
    return std::abs(c.work_compression) <= 1e-9 * HardestWork() &&
           std::ranges::any_of(run_.groups, holds);
  }

  void Restitution(const Group& g) {
    if (!full() || !IsAnswered(g)) return;
    const double bound = s_.solver.clip_tension ? 1e-6 : promised_.restitution;
    const double miss = MissOf(g);
    if (miss <= bound) return;
    BreakOnce("restitution", s_.contacts[static_cast<std::size_t>(g.contact)].name, " group ",
              g.number, " misses by ", miss);
  }

  // A guess may stay where the end of the run cuts its group, if it is one that lets go.
  void Unfinished(const Group& g) {
    const bool unfinished = g.status == Cycle::Status::kUnfinished;
    if (!full() || !(unfinished || g.status == Cycle::Status::kCut)) return;
    const Contact& contact = s_.contacts[static_cast<std::size_t>(g.contact)];
    const double most = HardestWork();
    if (unfinished && g.end != Cycle::End::kRunEnd &&
        g.work_compression > promised_.negligible * most) {
      BreakOnce("unfinished", contact.name, " group ", g.number);
    }
    const double blow = MuOfBlow(contact, Hardest(g));
    if (blow > 0 && g.mu > promised_.glue * blow) {
      BreakOnce("glued", contact.name, " group ", g.number, ": ", g.mu / blow, " times");
    }
  }

  // The largest W_c of a group of the run.
  double HardestWork() const {
    const auto hardest = std::ranges::max_element(run_.groups, {}, &Group::work_compression);
    return hardest == run_.groups.end() ? 0 : hardest->work_compression;
  }

  double Hardest(const Group& g) const {
    double force = 0;
    for (const Cycle& c : run_.cycles) {
      if (c.contact == g.contact && c.group == g.number) force = std::max(force, c.peak_force);
    }
    return force;
  }

  // Of an isolated collision that needs the force in an elastic contact.
  double MuOfBlow(const Contact& contact, double force) const {
    const double n = contact.exponent, k = contact.stiffness;
    const double work = force * std::pow(force / k, 1 / n) / (n + 1);
    const double v = std::sqrt(2 * work / EffectiveMass(s_, contact));
    return DampingCoefficient(DampingLaw::kExact, contact.restitution) * k / v;
  }

  const Scenario& s_;
  const Record& run_;
  Promised promised_;
  std::map<std::string, int> told_;
  std::map<int, std::pair<double, int>> last_;  // End and number of the last cycle of a contact.
  double last_end_ = 0;
  std::vector<std::string> broken_;
};

}  // namespace

std::vector<std::string> BrokenPromises(const Scenario& scenario, const Record& run,
                                        const Promised& promised) {
  return Judge(scenario, run, promised).Judgement();
}

double EffectiveMass(const Scenario& scenario, const Contact& contact) {
  double inverse = 0;
  for (const int body : {contact.left, contact.right}) {
    if (body == kNone) continue;
    const Body& b = scenario.bodies[static_cast<std::size_t>(body)];
    if (!b.fixed) inverse += 1 / b.mass;
  }
  return 1 / inverse;
}

double MissOf(const Group& group) {
  const double out = std::sqrt(-group.work_restitution / group.work_compression);
  return std::abs(out / group.restitution_in - 1);
}

bool IsAnswered(const Group& group) {
  return group.status == Cycle::Status::kConverged && group.end != Cycle::End::kRunEnd;
}

}  // namespace contact::testing
