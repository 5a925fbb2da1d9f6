#include "wire/scenario_advice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>

#include "simulation/forecast/first_meeting.h"
#include "simulation/forecast/missing_contacts.h"
#include "simulation/model/derived.h"
#include "simulation/model/index.h"
#include "simulation/statics/equilibrium.h"
#include "wire/scenario/contact_codec.h"
#include "wire/scenario/law_catalogue.h"
#include "wire/sweep/sweep_fields.h"

namespace contact {
namespace {

constexpr double kGoodResolution = 200;  // Steps, or samples, in a contact.
constexpr double kFewestSteps = 200;     // Steps in a contact, below which there is advice.
constexpr double kFewestSamples = 20;    // Samples in a contact, below which there is advice.
constexpr double kManySteps = 1e9;       // Steps of a run, above which there is advice.
constexpr double kManySamples = 1e6;     // Most samples that advice asks for.
constexpr double kLowRestitution = 0.3;  // Restitution below which laws and updates may fail.
constexpr double kShallow = 0.1;         // δ/R that advice asks for.
constexpr double kMiss = 0.01;           // Relative error of the restitution that a run warns of.

// The contact of shortest duration, among those whose duration is known.
struct Shortest {
  const Contact* contact = nullptr;
  FirstMeeting meeting;
};

Shortest FindShortest(const Scenario& scenario) {
  Shortest shortest;
  const auto meetings = ForecastFirstMeetings(scenario);
  for (std::size_t i = 0; i < meetings.size(); ++i) {
    if (!meetings[i]) continue;
    if (shortest.contact != nullptr && shortest.meeting.duration <= meetings[i]->duration) {
      continue;
    }
    shortest = {&scenario.contacts[i], *meetings[i]};
  }
  return shortest;
}

// Rounded down to one significant digit.
double Rounded(double value) {
  const double power = std::pow(10, std::floor(std::log10(value)));
  return std::floor(value / power * (1 + 1e-12)) * power;
}

std::string Cause(const FirstMeeting& meeting) {
  return meeting.speed > 0 ? fmt::format("at {:.3g} m/s", meeting.speed) : "under its load";
}

std::string Describe(const Shortest& shortest, double interval, const char* what) {
  const FirstMeeting& meeting = shortest.meeting;
  return fmt::format("gives a contact of {} {:.3g} {}; it lasts about {:.2g} s {}",
                     shortest.contact->name, meeting.duration / interval, what, meeting.duration,
                     Cause(meeting));
}

void AdviseOnStep(const Scenario& scenario, const Shortest& shortest,
                  std::vector<Violation>* advice) {
  const double step = scenario.solver.fixed_step;
  if (step == 0) return;
  const double steps = scenario.end_time / step;
  if (steps > static_cast<double>(scenario.solver.max_steps)) {
    advice->push_back({"solver.step_s",
                       fmt::format("makes {:.2g} steps, more than max_steps, {:.2g}: the run will "
                                   "fail with BUDGET_STEPS",
                                   steps, static_cast<double>(scenario.solver.max_steps)),
                       "take method ADAPTIVE, or a longer step"});
  } else if (steps > kManySteps) {
    advice->push_back({"solver.step_s", fmt::format("makes {:.2g} steps", steps),
                       "take method ADAPTIVE, or a longer step"});
  }
  if (shortest.contact == nullptr || shortest.meeting.duration >= kFewestSteps * step) return;
  advice->push_back(
      {"solver.step_s", Describe(shortest, step, "steps"),
       fmt::format("{:g} gives it {:g}", Rounded(shortest.meeting.duration / kGoodResolution),
                   kGoodResolution)});
}

void AdviseOnSamples(const Scenario& scenario, const Shortest& shortest,
                     std::vector<Violation>* advice) {
  const double interval = scenario.sample_interval;
  if (interval == 0 || shortest.contact == nullptr) return;
  if (scenario.samples_per_contact >= kFewestSamples) return;
  const double duration = shortest.meeting.duration;
  if (duration >= kFewestSamples * interval) return;
  const double good = Rounded(duration / kGoodResolution);
  advice->push_back({"output.sample_interval_s", Describe(shortest, interval, "samples"),
                     scenario.end_time / good <= kManySamples
                         ? fmt::format("{:g} gives it {:g}", good, kGoodResolution)
                         : "set output.samples_per_contact, or output.ledger_only if its cycles "
                           "are enough"});
}

// Advises once for each law, as the warnings of a run do.
void AdviseOnNamedLaws(const v1::Scenario& message, std::vector<Violation>* advice) {
  std::set<int> told;
  for (int i = 0; i < message.contacts_size(); ++i) {
    const v1::Contact& contact = message.contacts(i);
    if (contact.restitution() >= kLowRestitution) continue;
    const bool named = contact.damping() != v1::Contact::DAMPING_UNSPECIFIED &&
                       v1::Contact::Damping_IsValid(contact.damping());
    if (!named) continue;
    const LawEntry& law = RowOf(static_cast<DampingLaw>(contact.damping()));
    if (!law.closed_form()) continue;
    if (contact.has_reference_velocity_m_per_s()) continue;  // Then it depends on the speed.
    const double delivered = law.Delivered(contact.restitution());
    if (std::abs(delivered - contact.restitution()) <= kMiss * contact.restitution()) continue;
    if (!told.insert(contact.damping()).second) continue;
    advice->push_back({fmt::format("contacts[{}].restitution", i),
                       fmt::format("is {}; with {} an isolated collision has {:.4f}",
                                   contact.restitution(), law.name, delivered),
                       "ENERGY_RESTITUTION and EXACT deliver what is asked for"});
  }
}

bool IsIterated(const v1::Contact& contact) {
  return contact.damping() == v1::Contact::DAMPING_UNSPECIFIED ||
         contact.damping() == v1::Contact::ENERGY_RESTITUTION;
}

bool IsIteratedLow(const v1::Contact& contact) {
  return IsIterated(contact) && contact.restitution() < kLowRestitution;
}

bool HasPaperUpdate(const v1::Solver& solver) {
  return solver.update() != v1::Solver::UPDATE_UNSPECIFIED &&
         solver.update() != v1::Solver::NEWTON_COUPLED;
}

// The paper's process corrects every μ on its own. It starts from (23), which is a poor
// approximation for low restitution.
void AdviseOnPaperProcess(const v1::Scenario& message, std::vector<Violation>* advice) {
  const v1::Solver::Update update = message.solver().update();
  if (!HasPaperUpdate(message.solver())) return;
  if (CountContacts(message) < 2 || std::ranges::none_of(message.contacts(), IsIteratedLow)) return;
  advice->push_back({"solver.update",
                     fmt::format("is {}, which often does not converge where contacts with a "
                                 "restitution below {} act together",
                                 v1::Solver::Update_Name(update), kLowRestitution),
                     "NEWTON_COUPLED does"});
}

// Only what others do to a contact makes it turn before it separates.
bool MayTurnTwice(const v1::Scenario& message) {
  return CountContacts(message) > 1 || message.supports_size() > 0 || message.loads_size() > 0;
}

// The paper's process knows only cycles.
void AdviseOnPaperScope(const v1::Solver& solver, std::vector<Violation>* advice) {
  if (!HasPaperUpdate(solver) || solver.restitution_scope() != v1::Solver::AUTO) return;
  advice->push_back({"solver.restitution_scope",
                     fmt::format("is AUTO, but no group grows with update {}",
                                 v1::Solver::Update_Name(solver.update())),
                     "take update NEWTON_COUPLED, or leave it out"});
}

// One μ a cycle is not always enough.
void AdviseOnCycleScope(const v1::Scenario& message, std::vector<Violation>* advice) {
  const v1::Solver& solver = message.solver();
  if (HasPaperUpdate(solver) || solver.restitution_scope() != v1::Solver::CYCLE) return;
  if (!MayTurnTwice(message) || std::ranges::none_of(message.contacts(), IsIterated)) return;
  advice->push_back({"solver.restitution_scope",
                     "is CYCLE; a cycle that begins or ends compressed may then have no μ that "
                     "gives its restitution",
                     "AUTO lets such cycles share one μ"});
}

// Two neighbours that meet without a contact, `pair` being the one that they lack.
Violation Describe(const Scenario& scenario, const Contact& pair, const FirstMeeting& meeting) {
  const auto name = [&scenario](int body) { return scenario.bodies[At(body)].name; };
  return {"contacts",
          fmt::format("have none between {} and {}, which meet after {:.3g} s{} and pass through "
                      "each other",
                      name(pair.left), name(pair.right), meeting.start,
                      meeting.speed > 0 ? fmt::format(" at {:.3g} m/s", meeting.speed) : ""),
          fmt::format("add one with between: [{}, {}]", name(pair.left), name(pair.right))};
}

// A contact whose first meeting goes deep for the radius of a body.
struct DeepMeeting {
  std::size_t contact = 0;  // In Scenario::contacts.
  const Body* body = nullptr;
  FirstMeeting meeting;
  double share() const { return body == nullptr ? 0 : meeting.deformation / body->radius; }
};

DeepMeeting FindDeepest(const Scenario& scenario) {
  DeepMeeting deepest;
  const auto meetings = ForecastFirstMeetings(scenario);
  for (std::size_t i = 0; i < meetings.size(); ++i) {
    if (!meetings[i]) continue;
    const DeepMeeting deep{i, SmallerSphere(scenario, scenario.contacts[i]), *meetings[i]};
    if (deep.share() > deepest.share()) deepest = deep;
  }
  return deepest;
}

// The stiffness that brings the deformation of an impact to a share of what it is, rounded up;
// k δⁿ⁺¹ stays. Under a load less is enough.
double StiffnessFor(const Contact& contact, double share) {
  const double stiffness = contact.stiffness * std::pow(share, -contact.exponent - 1);
  const double power = std::pow(10, std::floor(std::log10(stiffness)));
  return std::ceil(stiffness / power * (1 - 1e-12)) * power;
}

// The field that says how stiff a contact of the scenario is.
std::string StiffnessField(const v1::Scenario& message, std::size_t contact) {
  int entry = 0;
  for (auto left = static_cast<int>(contact); left >= ContactsOf(message.contacts(entry));) {
    left -= ContactsOf(message.contacts(entry++));
  }
  return fmt::format("contacts[{}]{}", entry,
                     message.contacts(entry).has_stiffness() ? ".stiffness" : "");
}

// Advice on the base with paths from the sweep, without the fields that axes set.
std::vector<Violation> OfBase(const v1::Sweep& sweep, std::vector<Violation> advice) {
  std::vector<Violation> broken;
  const SweepFields fields(sweep, &broken);
  std::erase_if(advice, [&fields](const Violation& a) { return fields.Sets(a.field); });
  for (Violation& a : advice) a.field = "base." + a.field;
  return advice;
}

}  // namespace

std::vector<Violation> AdviseOnTime(const Scenario& scenario) {
  std::vector<Violation> advice;
  const Shortest shortest = FindShortest(scenario);
  AdviseOnStep(scenario, shortest, &advice);
  AdviseOnSamples(scenario, shortest, &advice);
  return advice;
}

std::vector<Violation> AdviseOnLaws(const v1::Scenario& message) {
  std::vector<Violation> advice;
  AdviseOnNamedLaws(message, &advice);
  AdviseOnPaperProcess(message, &advice);
  AdviseOnPaperScope(message.solver(), &advice);
  AdviseOnCycleScope(message, &advice);
  return advice;
}

std::vector<Violation> AdviseOnPlaces(const Scenario& scenario) {
  // The forecast is asked as if the contacts were there.
  Scenario touching = scenario;
  touching.contacts = MissingContacts(scenario);
  const Contact* first = nullptr;
  std::optional<FirstMeeting> soonest;
  const auto meetings = ForecastFirstMeetings(touching);
  for (std::size_t i = 0; i < meetings.size(); ++i) {
    if (!meetings[i] || (soonest && soonest->start <= meetings[i]->start)) continue;
    soonest = meetings[i];
    first = &touching.contacts[i];
  }
  if (first == nullptr) return {};
  return {Describe(touching, *first, *soonest)};
}

std::vector<Violation> AdviseOnStart(const Scenario& scenario) {
  if (!scenario.starts_at_rest) return {};
  const std::vector<int> loose = FindLoose(scenario);
  if (loose.empty()) return {};
  return {
      {"start",
       fmt::format("is AT_EQUILIBRIUM, which holds {}{} at no one place: it rests near where it "
                   "was given",
                   scenario.bodies[At(loose[0])].name,
                   loose.size() > 1 ? fmt::format(" and {} more", loose.size() - 1) : ""),
       "a support, or a contact that a load presses, fixes the place"}};
}

std::vector<Violation> AdviseOnDepth(const v1::Scenario& message, const Scenario& scenario) {
  const DeepMeeting deep = FindDeepest(scenario);
  if (!(deep.share() > 1)) return {};
  const Contact& contact = scenario.contacts[deep.contact];
  return {{StiffnessField(message, deep.contact),
           fmt::format("makes {} about {:.2g} m deep {}, more than the radius of {}, {:g} m",
                       contact.name, deep.meeting.deformation, Cause(deep.meeting), deep.body->name,
                       deep.body->radius),
           fmt::format("a stiffness of {:g} keeps it below a tenth of the radius",
                       StiffnessFor(contact, kShallow / deep.share()))}};
}

std::vector<Violation> Advise(const v1::Scenario& message, const Scenario& scenario) {
  std::vector<Violation> advice = AdviseOnLaws(message);
  std::ranges::move(AdviseOnDepth(message, scenario), std::back_inserter(advice));
  std::ranges::move(AdviseOnStart(scenario), std::back_inserter(advice));
  std::ranges::move(AdviseOnPlaces(scenario), std::back_inserter(advice));
  std::ranges::move(AdviseOnTime(scenario), std::back_inserter(advice));
  return advice;
}

std::vector<Violation> AdviseOnTime(const v1::Sweep& sweep, const DecodedSweep& plan) {
  Scenario first = plan.first;
  if (sweep.keep_trajectories().empty()) first.sample_interval = 0;
  return OfBase(sweep, AdviseOnTime(first));
}

std::vector<Violation> Advise(const v1::Sweep& sweep, const DecodedSweep& plan) {
  std::vector<Violation> advice = OfBase(sweep, AdviseOnLaws(sweep.base()));
  std::ranges::move(OfBase(sweep, AdviseOnDepth(sweep.base(), plan.first)),
                    std::back_inserter(advice));
  std::ranges::move(OfBase(sweep, AdviseOnStart(plan.first)), std::back_inserter(advice));
  std::ranges::move(OfBase(sweep, AdviseOnPlaces(plan.first)), std::back_inserter(advice));
  std::ranges::move(AdviseOnTime(sweep, plan), std::back_inserter(advice));
  return advice;
}

std::string Text(const Violation& advice) {
  return fmt::format("{}: {}{}{}", advice.field, advice.description,
                     advice.hint.empty() ? "" : " — ", advice.hint);
}

}  // namespace contact
