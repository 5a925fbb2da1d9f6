#include "cli/text/comparison/verification.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <utility>

#include "cli/input/no_limits.h"
#include "cli/text/render_ledger.h"
#include "wire/rules/field_rule.h"

namespace contact::cli {
namespace {

// Below it differences shrink so slowly that the sum of those to come is a guess.
constexpr double kLeastOrder = 0.5;

using Number = Verification::Number;

constexpr double kRoundOff = 1e-13;  // Of a number after thousands of steps, relative.
constexpr double kPeakWeight = 10;   // A peak lies between steps, where motion is interpolated.
constexpr double kOrderOfRk4 = 4;
constexpr double kOrderBand = 0.5;  // How far from its order a method may seem to be.

// A number as people write it: 1e-10 / 10 is 1e-11 to all digits.
double Rounded(double value) { return std::strtod(fmt::format("{:.12g}", value).c_str(), nullptr); }

double OrderWith(double power) {
  return power == std::trunc(power) ? kOrderOfRk4 : std::min(kOrderOfRk4, power + 1);
}

double OrderOf(const Scenario& scenario) {
  double order = kOrderOfRk4;
  for (const Contact& contact : scenario.contacts) {
    const double damping = DampingExponent(contact.damping, contact.exponent);
    order = std::min({order, OrderWith(contact.exponent), OrderWith(damping)});
  }
  return order;
}

// A cycle by its contact and its place there.
using CycleKey = std::pair<std::string, int>;
using CycleMap = std::map<CycleKey, const v1::Cycle*>;

CycleMap CyclesOf(const v1::Job& job) {
  CycleMap cycles;
  for (const v1::Cycle& cycle : job.cycles()) {
    cycles.emplace(CycleKey(cycle.contact(), cycle.number()), &cycle);
  }
  return cycles;
}

double LargestSpeed(const v1::Job& job) {
  double speed = 0;
  const auto see = [&speed](double v) { speed = std::max(speed, std::abs(v)); };
  for (const v1::Body& body : job.scenario().bodies()) see(body.velocity_m_per_s());
  for (const v1::FinalBody& body : job.final_bodies()) see(body.velocity_m_per_s());
  for (const v1::Cycle& cycle : job.cycles()) see(cycle.approach_velocity_m_per_s());
  return speed;
}

std::map<std::string, double> LargestForces(const v1::Job& job) {
  std::map<std::string, double> forces;
  for (const v1::Cycle& cycle : job.cycles()) {
    double& force = forces[cycle.contact()];
    force = std::max(force, cycle.peak_force_n());
  }
  return forces;
}

// How much larger the error of μ is, relative, than that of ε and that of a force relative to the
// largest of the contact: α(ε) grows from 0 at ε = 1.
double Sensitivity(const v1::Cycle& cycle, double largest_force) {
  const double e = cycle.restitution_in();
  return (e < 1 ? 1 / (1 - e) : 1) + largest_force / cycle.peak_force_n();
}

// Whether the texts are all the same.
bool Same(const std::vector<std::string>& texts) {
  return std::ranges::count(texts, texts.front()) == std::ssize(texts);
}

// Gathers numbers and differences.
class Verifier {
 public:
  explicit Verifier(Verification* result) : result_(*result) {
    all_.push_back(&result_.job);
    for (const v1::Job& run : result_.runs) all_.push_back(&run);
    for (const v1::Job* job : all_) cycles_.push_back(CyclesOf(*job));
    for (const v1::Job& run : result_.runs) SeeResiduals(run);
  }

  void Gather() {
    CountCycles();
    AddBodies();
    const auto forces = LargestForces(result_.job);
    for (const v1::Cycle& cycle : result_.job.cycles()) {
      AddCycle(cycle, forces.at(cycle.contact()));
    }
  }

 private:
  // What the iteration of μ leaves is no difference between steps.
  void SeeResiduals(const v1::Job& run) {
    for (const v1::Group& group : run.groups()) {
      const double error = RestitutionError(group.restitution_out(), group.restitution_in());
      if (error <= result_.plan.claim) floor_ = std::max(floor_, error);
    }
  }

  void CountCycles() {
    std::map<std::string, std::vector<std::string>> counts;
    for (const CycleMap& cycles : cycles_) {
      for (const auto& [key, cycle] : cycles) counts[key.first];
    }
    for (auto& [contact, texts] : counts) {
      for (const CycleMap& cycles : cycles_) {
        texts.push_back(fmt::to_string(std::ranges::count(
            cycles, contact, [](const auto& entry) { return entry.first.first; })));
      }
      if (Same(texts)) continue;
      result_.differences.push_back(
          fmt::format("{} has {} cycles", contact, fmt::join(texts, ", ")));
    }
  }

  void AddBodies() {
    const double speed = LargestSpeed(result_.job);
    for (int i = 0; i < result_.job.final_bodies_size(); ++i) {
      std::vector<double> values;
      for (const v1::Job* job : all_) {
        if (i < job->final_bodies_size()) values.push_back(job->final_bodies(i).velocity_m_per_s());
      }
      Add(result_.job.final_bodies(i).name() + " final velocity", "m/s", values, speed);
    }
  }

  void AddCycle(const v1::Cycle& cycle, double largest_force) {
    std::vector<std::string> words;
    std::vector<double> forces, factors;
    bool solved = cycle.mu() > 0;
    for (const CycleMap& cycles : cycles_) {
      const auto found = cycles.find({cycle.contact(), cycle.number()});
      if (found == cycles.end()) return;
      const v1::Cycle& one = *found->second;
      forces.push_back(one.peak_force_n());
      factors.push_back(one.mu());
      words.push_back(v1::Cycle::End_Name(one.end()) + " " + v1::Cycle::Status_Name(one.status()));
      solved = solved && one.status() == v1::Cycle::CONVERGED;
    }
    const std::string name = fmt::format("{} #{} ", cycle.contact(), cycle.number());
    if (!Same(words)) {
      result_.differences.push_back(fmt::format("{}is {}", name, fmt::join(words, ", ")));
    }
    Add(name + "peak force", "N", forces, largest_force, kPeakWeight);
    if (!solved) return;  // μ is given, kept, or not found.
    Add(name + "μ", "N·s/m^(n+1)", factors, cycle.mu(), Sensitivity(cycle, largest_force));
  }

  // `all`: of job and runs. `scale`: what errors are relative to. `weight`: how many times the
  // tolerance they may be.
  void Add(std::string name, std::string unit, std::vector<double> all, double scale,
           double weight = 1) {
    if (all.size() != all_.size()) return;
    if (std::ranges::count(all, 0) == std::ssize(all)) return;  // Such as a fixed body.
    const double size = scale > 0 ? scale : 1;
    Number number{.name = std::move(name), .unit = std::move(unit), .own = all[0]};
    number.values.assign(all.begin() + 1, all.end());
    number.refinement = Refine(all[1], all[2], all[3], result_.plan.ratio, floor_ * weight * size);
    number.distance = Distance(number) / size;
    number.scale = size;
    number.allowed = weight * result_.tolerance;
    result_.numbers.push_back(std::move(number));
  }

  static double Distance(const Number& number) {
    if (number.refinement.settles) return std::abs(number.own - number.refinement.limit);
    const double middle = std::abs(number.own - number.values[1]);
    const double fine = std::abs(number.own - number.values[2]);
    return fine >= middle ? fine : middle + 0 * fine;  // NaN if one of them is.
  }

  Verification& result_;
  std::vector<const v1::Job*> all_;  // The job and its runs.
  std::vector<CycleMap> cycles_;
  double floor_ = kRoundOff;
};

}  // namespace

double ObservedOrder(double coarse, double middle, double fine, double ratio) {
  const double order = std::log(std::abs((coarse - middle) / (middle - fine))) / std::log(ratio);
  return std::isfinite(order) ? order : std::numeric_limits<double>::quiet_NaN();
}

double Richardson(double middle, double fine, double ratio, double order) {
  return fine + (fine - middle) / (std::pow(ratio, order) - 1);
}

Refinement Refine(double coarse, double middle, double fine, double ratio, double floor) {
  const double first = middle - coarse, second = fine - middle;
  Refinement refinement{.limit = fine, .settles = std::abs(second) <= floor};
  if (refinement.settles || !(std::abs(first) > floor)) return refinement;
  if (std::signbit(first) != std::signbit(second)) return refinement;
  refinement.order = ObservedOrder(coarse, middle, fine, ratio);
  if (!(refinement.order >= kLeastOrder)) return refinement;
  refinement.limit = Richardson(middle, fine, ratio, refinement.order);
  refinement.settles = true;
  return refinement;
}

std::string RefinementPlan::Field() const {
  return adaptive ? "solver.relative_tolerance" : "solver.step_s";
}

v1::Scenario RefinementPlan::At(double resolution, v1::Scenario scenario) const {
  v1::Solver& solver = *scenario.mutable_solver();
  if (adaptive) {
    solver.set_relative_tolerance(resolution);
  } else {
    solver.set_step_s(resolution);
  }
  const Range& tolerances =
      NumberOf<v1::Solver>(v1::Solver::kRestitutionToleranceFieldNumber).range;
  solver.set_restitution_tolerance(std::max(tolerances.low, Rounded(claim / 1000)));
  const NumberField& steps = NumberOf<v1::Solver>(v1::Solver::kMaxStepsFieldNumber);
  const double allowed = steps.Find(solver).value_or(steps.default_value);
  const double more = std::max(1.0, own / resolution);
  solver.set_max_steps(static_cast<std::int64_t>(std::min(steps.range.high, more * allowed)));
  return scenario;
}

RefinementPlan PlanOf(const v1::Scenario& message) {
  const Scenario scenario = DecodeScenario(message, kNoLimits).scenario;
  const SolverOptions& solver = scenario.solver;
  RefinementPlan plan{.adaptive = solver.fixed_step == 0, .claim = solver.restitution_tolerance};
  double finest = 0;
  if (plan.adaptive) {
    plan.ratio = 10;
    plan.own = solver.relative_tolerance;
    const Range& range = NumberOf<v1::Solver>(v1::Solver::kRelativeToleranceFieldNumber).range;
    finest = std::max(range.low, plan.own / 1000);
  } else {
    plan.own = solver.fixed_step;
    plan.order = OrderOf(scenario);
    finest = plan.own / 8;
  }
  for (const int power : {2, 1, 0}) {
    plan.resolutions.push_back(Rounded(finest * std::pow(plan.ratio, power)));
  }
  return plan;
}

bool Verification::Holds() const { return std::ranges::all_of(numbers, &Number::Holds); }

bool Verification::ShowsOrder(const Number& number) const {
  return plan.order > 0 && std::abs(number.refinement.order - plan.order) <= kOrderBand;
}

Verification Verify(const RefinementPlan& plan, v1::Job job, std::vector<v1::Job> runs,
                    double tolerance) {
  Verification result{
      .plan = plan, .job = std::move(job), .runs = std::move(runs), .tolerance = tolerance};
  Verifier(&result).Gather();
  return result;
}

}  // namespace contact::cli
