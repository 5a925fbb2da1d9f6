#include "wire/sweep/sweep_codec.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "simulation/model/derived.h"
#include "wire/sweep/axis_words.h"
#include "wire/sweep/sweep_fields.h"

namespace contact {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

v1::Scenario Chain() {
  v1::Scenario scenario;
  for (int i = 0; i < 3; ++i) {
    v1::Body& body = *scenario.add_bodies();
    body.set_name("B" + std::to_string(i + 1));
    body.set_mass_kg(0.5);
    body.set_radius_m(0.05);
    body.set_position_m(0.1 * i);
  }
  v1::Contact& contact = *scenario.add_contacts();
  for (const auto* name : {"B1", "B2", "B3"}) contact.add_between(name);
  contact.set_stiffness(1e8);
  contact.set_restitution(0.8);
  contact.set_name("C");
  scenario.set_end_time_s(4e-3);
  return scenario;
}

v1::Sweep::Axis& AddAxis(v1::Sweep& sweep, const std::string& field,
                         const std::vector<double>& values = {}) {
  v1::Sweep::Axis& axis = *sweep.add_axes();
  axis.set_field(field);
  axis.mutable_values()->Add(values.begin(), values.end());
  return axis;
}

void SetRange(v1::Sweep::Range& range, double low, double high, int count = 0) {
  range.set_low(low);
  range.set_high(high);
  range.set_count(count);
}

v1::Sweep Grid() {
  v1::Sweep sweep;
  *sweep.mutable_base() = Chain();
  AddAxis(sweep, "contacts[0].restitution", {0.9, 0.5});
  AddAxis(sweep, "bodies[0].velocity_m_per_s", {0.1, 0.2, 0.3});
  sweep.add_metrics("iterations");
  return sweep;
}

std::vector<std::vector<double>> Cells(const v1::Sweep& sweep) {
  const DecodedSweep decoded = DecodeSweep(sweep);
  for (const Violation& violation : decoded.violations) {
    ADD_FAILURE() << violation.field << ": " << violation.description;
  }
  std::vector<std::vector<double>> cells;
  for (int i = 0; i < decoded.axes.cells(); ++i) cells.push_back(decoded.axes.Values(i));
  return cells;
}

std::vector<std::string> Mistakes(const v1::Sweep& sweep, const ScenarioLimits& limits = {}) {
  std::vector<std::string> mistakes;
  for (const Violation& violation : DecodeSweep(sweep, limits).violations) {
    mistakes.push_back(violation.field + ": " + violation.description +
                       (violation.hint.empty() ? "" : " — " + violation.hint));
  }
  return mistakes;
}

TEST(SweepAxes, GridVariesTheLastAxisFastest) {
  using Cell = std::vector<double>;
  EXPECT_THAT(Cells(Grid()), ElementsAre(Cell{0.9, 0.1}, Cell{0.9, 0.2}, Cell{0.9, 0.3},
                                         Cell{0.5, 0.1}, Cell{0.5, 0.2}, Cell{0.5, 0.3}));
}

TEST(SweepAxes, ZipTakesValuesTogether) {
  using Cell = std::vector<double>;
  v1::Sweep sweep = Grid();
  sweep.set_combination(v1::Sweep::ZIP);
  EXPECT_THAT(Mistakes(sweep), ElementsAre("axes[1]: has 3 values, but axes[0] has 2 — axes of a "
                                           "ZIP are equally long"));
  sweep.mutable_axes(0)->add_values(0.3);
  EXPECT_THAT(Cells(sweep), ElementsAre(Cell{0.9, 0.1}, Cell{0.5, 0.2}, Cell{0.3, 0.3}));
}

TEST(SweepAxes, RangesReachBothEndsExactly) {
  v1::Sweep sweep = Grid();
  sweep.mutable_axes()->DeleteSubrange(0, 2);
  SetRange(*AddAxis(sweep, "contacts[0].restitution").mutable_linear(), 0.1, 0.7, 3);
  SetRange(*AddAxis(sweep, "contacts[0].stiffness").mutable_log(), 1e6, 1e9, 4);
  const auto cells = Cells(sweep);
  ASSERT_EQ(cells.size(), 12U);
  EXPECT_EQ(cells.front(), (std::vector<double>{0.1, 1e6}));
  EXPECT_EQ(cells.back(), (std::vector<double>{0.7, 1e9}));
  EXPECT_DOUBLE_EQ(cells[4][0], 0.4);
  EXPECT_NEAR(cells[1][1], 1e7, 1e-7);
  EXPECT_NEAR(cells[2][1], 1e8, 1e-6);
}

TEST(SweepAxes, LatinHypercubeHasOneCellInEveryPartOfEveryAxis) {
  v1::Sweep sweep = Grid();
  sweep.mutable_axes()->DeleteSubrange(0, 2);
  SetRange(*AddAxis(sweep, "contacts[0].restitution").mutable_linear(), 0, 1);
  SetRange(*AddAxis(sweep, "contacts[0].stiffness").mutable_log(), 1e6, 1e9);
  AddAxis(sweep, "bodies[0].velocity_m_per_s", {0.1, 0.2, 0.3, 0.4});
  sweep.set_combination(v1::Sweep::LATIN_HYPERCUBE);
  sweep.set_count(100);
  sweep.set_seed(5);
  std::set<int> linear;
  std::set<int> log;
  std::multiset<double> listed;
  const auto cells = Cells(sweep);
  for (const auto& cell : cells) {
    linear.insert(static_cast<int>(cell[0] * 100));
    log.insert(static_cast<int>(std::log(cell[1] / 1e6) / std::log(1e3) * 100));
    listed.insert(cell[2]);
  }
  EXPECT_EQ(linear.size(), 100U);
  EXPECT_EQ(log.size(), 100U);
  for (const double value : {0.1, 0.2, 0.3, 0.4}) EXPECT_EQ(listed.count(value), 25U);
  // The axes are shuffled on their own.
  EXPECT_FALSE(std::ranges::is_sorted(cells, {}, [](const auto& cell) { return cell[0]; }));
  double correlation = 0;
  for (const auto& cell : cells) {
    correlation += (cell[0] - 0.5) * (std::log(cell[1] / 1e6) / std::log(1e3) - 0.5) * 12 / 100;
  }
  EXPECT_LT(std::abs(correlation), 0.3);
}

TEST(SweepAxes, SeedDecidesTheDraw) {
  v1::Sweep sweep = Grid();
  sweep.mutable_axes()->DeleteSubrange(0, 2);
  SetRange(*AddAxis(sweep, "contacts[0].restitution").mutable_linear(), 0.2, 0.8);
  AddAxis(sweep, "bodies[0].velocity_m_per_s", {0.1, 0.2});
  sweep.set_count(500);
  for (const auto combination : {v1::Sweep::RANDOM, v1::Sweep::LATIN_HYPERCUBE}) {
    sweep.set_combination(combination);
    sweep.set_seed(1);
    const auto first = Cells(sweep);
    EXPECT_EQ(Cells(sweep), first);
    for (const auto& cell : first) {
      EXPECT_TRUE(cell[0] >= 0.2 && cell[0] <= 0.8);
      EXPECT_TRUE(cell[1] == 0.1 || cell[1] == 0.2);
    }
    sweep.set_seed(2);
    EXPECT_NE(Cells(sweep), first);
  }
}

TEST(SweepAxes, CellsAreLimitedBeforeTheyAreMade) {
  v1::Sweep sweep = Grid();
  EXPECT_THAT(Mistakes(sweep, {.max_cells = 6}), IsEmpty());
  EXPECT_THAT(Mistakes(sweep, {.max_cells = 5}),
              ElementsAre("axes: make 6 cells; must make at most 5"));
  for (int i = 0; i < 6; ++i) {
    const std::string field = "bodies[" + std::to_string(i % 3) + "].";
    SetRange(*AddAxis(sweep, field + (i < 3 ? "position_m" : "mass_kg")).mutable_linear(), 1, 2,
             100'000);
  }
  EXPECT_THAT(Mistakes(sweep), ElementsAre("axes: make 6e+30 cells; must make at most 100000"));
}

TEST(SweepAxes, MistakesAreToldTogether) {
  v1::Sweep sweep = Grid();
  sweep.mutable_axes(0)->add_values(std::nan(""));
  sweep.mutable_axes(1)->set_field("bodies[0].velocity");
  SetRange(*AddAxis(sweep, "bodies[7].mass_kg").mutable_log(), 0, -1, 0);
  AddAxis(sweep, "contacts[0].name");
  AddAxis(sweep, "contacts[*].restitution", {0.5});
  AddAxis(sweep, "loads[0].sine.phase_rad", {0.5});
  sweep.set_seed(3);
  sweep.add_metrics("cycles.mu");
  sweep.add_metrics("final_bodies[B1].velocity_m_per_");
  sweep.add_metrics("title");
  EXPECT_THAT(
      Mistakes(sweep),
      ElementsAre(
          "seed: goes only with RANDOM and LATIN_HYPERCUBE", "axes[0].values[2]: is nan",
          "axes[2].log.low: is 0; must be in (0, 1.8e308)",
          "axes[2].log.high: is -1; must be in (0, 1.8e308)",
          "axes[2].log.high: is -1, which is below low, 0",
          "axes[2].log.count: is 0; must be in [1, 100000]",
          "axes[3]: has no values — give one of values, linear and log",
          "axes[1].field: 'bodies[0].velocity': unknown field — did you mean 'velocity_m_per_s'?",
          "axes[2].field: bodies: there are only 3",
          "axes[3].field: contacts[0].name is not a number, so it cannot vary",
          "axes[4].field: contacts[0].restitution has an axis already",
          "axes[5].field: loads: there are only 0",
          "metrics[1]: 'cycles.mu': cycles is a list — say which entry, by index or name, or "
          ".first, .last, .max, .min or .count of all",
          "metrics[2]: 'final_bodies[B1].velocity_m_per_': unknown field 'velocity_m_per_' — did "
          "you mean 'velocity_m_per_s'?",
          "metrics[3]: 'title': unknown field 'title' — fields are steps, evaluations, iterations, "
          "episodes, wall_time_s, worst_identity_residual, momentum_residual, energy_residual, "
          "kinetic_energy_j, time_reached_s, growths, growths_no_progress, cycles, "
          "cycles_not_converged, cycles_infeasible, "
          "cycles_cut"));
}

TEST(SweepCodecTest, NumberOfACycleOrBodyIsNamedWithItsList) {
  for (const auto& [metric, hint] : std::vector<std::pair<std::string, std::string>>{
           {"peak_force", "'cycles.max.peak_force_n', or cycles[NAME].last.peak_force_n of one?"},
           {"velocity", "'final_bodies.max.velocity_m_per_s', or final_bodies[NAME].last."},
           {"iteration", "'iterations'?"},
           {"contact", "fields are steps, "}}) {
    v1::Sweep sweep = Grid();
    sweep.set_metrics(0, metric);
    EXPECT_THAT(Mistakes(sweep), ElementsAre(HasSubstr(hint)));
  }
}

TEST(SweepBase, IsCheckedWithTheFirstCell) {
  v1::Sweep sweep = Grid();
  sweep.mutable_base()->mutable_contacts(0)->clear_restitution();  // The axis gives it.
  EXPECT_THAT(Mistakes(sweep), IsEmpty());
  sweep.mutable_axes(0)->set_values(0, 7);  // A cell that fails, no more.
  EXPECT_THAT(Mistakes(sweep), IsEmpty());
  sweep.mutable_base()->mutable_bodies(1)->set_mass_kg(-1);
  EXPECT_THAT(Mistakes(sweep), ElementsAre("base.bodies[1].mass_kg: is -1; must be in (0, 1e12]"));
}

TEST(SweepBase, MetricsNameWhatItHas) {
  v1::Sweep sweep = Grid();
  sweep.add_metrics("cycles[C-1].mu");
  sweep.add_metrics("final_bodies[B3].position_m");
  sweep.add_metrics("groups[C-1].restitution_out");
  EXPECT_THAT(Mistakes(sweep), IsEmpty());
  sweep.add_metrics("cycles[C-3].mu");
  sweep.add_metrics("groups[B3].mu");
  EXPECT_THAT(Mistakes(sweep),
              ElementsAre("metrics[4]: the base has no 'C-3' — did you mean 'C-1'?",
                          HasSubstr("metrics[5]: the base has no 'B3'")));
}

TEST(SweepFields, SetEveryEntryAndRoundWholeNumbers) {
  v1::Sweep sweep = Grid();
  sweep.mutable_axes(0)->set_field("bodies[*].mass_kg");
  sweep.mutable_axes(1)->set_field("solver.max_iterations");
  std::vector<Violation> violations;
  SweepFields fields(sweep, &violations);
  ASSERT_TRUE(violations.empty());
  std::vector<double> values = {2.5, 7.6};
  const v1::Scenario& scenario = fields.Set(values);
  for (const v1::Body& body : scenario.bodies()) EXPECT_EQ(body.mass_kg(), 2.5);
  EXPECT_EQ(scenario.solver().max_iterations(), 8);
  EXPECT_THAT(values, ElementsAre(2.5, 8));
  EXPECT_TRUE(fields.Sets("bodies[2].mass_kg"));
  EXPECT_FALSE(fields.Sets("bodies[2].radius_m"));
}

v1::Sweep OfFields(const std::vector<std::string>& fields) {
  v1::Sweep sweep;
  *sweep.mutable_base() = Chain();
  for (const std::string& field : fields) AddAxis(sweep, field, {0.5});
  return sweep;
}

TEST(SweepFields, AreFoundByTheNamesOfBodiesAndContacts) {
  v1::Sweep sweep = OfFields({"bodies[B2].velocity_m_per_s", "contacts[C].restitution"});
  v1::Contact& pair = *sweep.mutable_base()->add_contacts();
  for (const auto* name : {"B1", "B3"}) pair.add_between(name);
  v1::Contact& wall = *sweep.mutable_base()->add_contacts();
  wall.add_between("B3");
  wall.mutable_wall()->set_side(v1::Wall::RIGHT);
  AddAxis(sweep, "contacts[B1-B3].stiffness", {2e7});
  AddAxis(sweep, "contacts[B3-wall].exponent", {2});
  std::vector<Violation> violations;
  SweepFields fields(sweep, &violations);
  ASSERT_TRUE(violations.empty()) << violations.front().description;
  std::vector<double> values = {0.7, 0.6, 2e7, 2};
  const v1::Scenario& scenario = fields.Set(values);
  EXPECT_EQ(scenario.bodies(1).velocity_m_per_s(), 0.7);
  EXPECT_EQ(scenario.contacts(0).restitution(), 0.6);
  EXPECT_EQ(scenario.contacts(1).stiffness(), 2e7);
  EXPECT_EQ(scenario.contacts(2).exponent(), 2);
  EXPECT_TRUE(fields.Sets("contacts[0].restitution"));
}

TEST(SweepFields, NamesThatMeanNoEntryAreTold) {
  EXPECT_THAT(
      Mistakes(OfFields({"bodies[B4].mass_kg", "contacts[C-2].restitution",
                         "contacts[B1-B2].restitution", "supports[B1].stiffness_n_per_m"})),
      ElementsAre("axes[0].field: bodies: there is no body 'B4' — did you mean 'B1'?",
                  "axes[1].field: contacts: 'C-2' has its fields in common with the other contacts "
                  "of contacts[0] — contacts[0] sets them for all",
                  HasSubstr("axes[2].field: contacts: there is no contact 'B1-B2'"),
                  "axes[3].field: supports: its entries have no names — give an index, or [*] for "
                  "every entry"));
}

TEST(SweepFields, OneAxisSetsAllFieldsThatItNames) {
  v1::Sweep sweep = OfFields({"bodies[0].mass_kg"});
  sweep.mutable_axes(0)->add_also("bodies[B3].mass_kg");
  std::vector<Violation> violations;
  SweepFields fields(sweep, &violations);
  ASSERT_TRUE(violations.empty());
  std::vector<double> values = {3};
  const v1::Scenario& scenario = fields.Set(values);
  EXPECT_EQ(scenario.bodies(0).mass_kg(), 3);
  EXPECT_EQ(scenario.bodies(1).mass_kg(), 0.5);
  EXPECT_EQ(scenario.bodies(2).mass_kg(), 3);
  AddAxis(sweep, "bodies[2].mass_kg", {1});
  sweep.mutable_axes(0)->add_also("bodies[0].name");
  EXPECT_THAT(Mistakes(sweep),
              ElementsAre("axes[0].also[1]: bodies[0].name is not a number, so it cannot vary",
                          "axes[1].field: bodies[2].mass_kg has an axis already"));
}

TEST(SweepAxes, ALabelIsShort) {
  v1::Sweep sweep = Grid();
  sweep.mutable_axes(0)->set_label(std::string(101, 'x'));
  EXPECT_THAT(Mistakes(sweep),
              ElementsAre("axes[0].label: has 101 characters; must have at most 100"));
}

TEST(AxisWords, ValuesOfAnEnumHaveItsWords) {
  v1::Sweep::Axis axis;
  axis.set_field("contacts[C].damping");
  EXPECT_EQ(AxisWord(axis, v1::Contact::EXACT), "EXACT");
  EXPECT_EQ(AxisWord(axis, 99), "");
  EXPECT_EQ(AxisWord(axis, std::nan("")), "");
  EXPECT_EQ(AxisName(axis), "contacts[C].damping");
  axis.set_label("var:law");
  EXPECT_EQ(AxisName(axis), "var:law");
  axis.set_field("contacts[0].restitution");
  EXPECT_EQ(AxisWord(axis, 2), "");
}

TEST(SweepFields, DoNotChangeTheKindOfALoad) {
  v1::Sweep sweep = Grid();
  sweep.mutable_base()->add_loads()->mutable_gravity();
  sweep.mutable_axes(0)->set_field("loads[0].sine.amplitude_n");
  sweep.mutable_axes(1)->set_field("loads[0].gravity.acceleration_m_per_s2");
  EXPECT_THAT(Mistakes(sweep), ElementsAre("axes[0].field: the base has no loads[0].sine"));
}

TEST(SweepMetrics, ReadNumbersOfAResult) {
  v1::Sweep sweep;
  for (const auto* metric :
       {"iterations", "summary.energy_residual", "convergence", "cycles[1].mu",
        "cycles[C-2].number", "cycles[0].status", "groups[1].mu", "groups[C-2].too_much_mu",
        "groups[0].growth", "final_bodies[B.2].velocity_m_per_s", "cycles[9].mu"}) {
    sweep.add_metrics(metric);
  }
  std::vector<Violation> violations;
  const SweepMetrics metrics(sweep, &violations);
  ASSERT_TRUE(violations.empty());
  v1::Job job;
  job.mutable_summary()->set_iterations(12);
  job.mutable_summary()->set_energy_residual(1e-9);
  job.set_convergence(v1::Job::PARTIAL);
  for (const int number : {3, 4}) {
    v1::Cycle& cycle = *job.add_cycles();
    cycle.set_contact("C-" + std::to_string(number - 2));
    cycle.set_number(number);
    cycle.set_mu(number * 100);
    cycle.set_status(v1::Cycle::SETTLED);
  }
  for (const auto* contact : {"C-1", "C-2"}) {
    v1::Group& group = *job.add_groups();
    group.set_contact(contact);
    group.set_mu(10 * job.groups_size());
    group.set_too_much_mu(7);
    group.set_growth(v1::Group::TOO_MUCH);
  }
  job.add_final_bodies()->set_name("B1");
  v1::FinalBody& body = *job.add_final_bodies();
  body.set_name("B.2");
  body.set_velocity_m_per_s(0.25);
  std::vector<double> values;
  for (const auto& metric : metrics.Of(job)) values.push_back(metric.value);
  EXPECT_THAT(std::vector(values.begin(), values.end() - 1),
              ElementsAre(12, 1e-9, 2, 400, 4, 4, 20, 7, 3, 0.25));
  EXPECT_TRUE(std::isnan(values.back()));
}

TEST(SweepMetrics, OfSamplesAreTheirFirstLastAndExtremesWithTheirTimes) {
  v1::Sweep sweep;
  for (const auto* word : {"first", "last", "max", "min", "time_of_max", "time_of_min"}) {
    sweep.add_metrics(std::string("series[B.velocity].") + word);
  }
  sweep.add_metrics("iterations");
  std::vector<Violation> violations;
  const SweepMetrics metrics(sweep, &violations);
  ASSERT_TRUE(violations.empty());
  Scenario scenario;
  scenario.bodies = {{.name = "A"}, {.name = "B"}};
  SeriesTally series = metrics.Tally(scenario);
  const int columns = SampleColumns(scenario);
  for (const auto& [time, velocity] : {std::pair{0.0, 2.0}, {0.5, -3.0}, {1.0, 5.0}, {1.5, 5.0}}) {
    Samples samples{.columns = columns,
                    .values = std::vector<double>(static_cast<std::size_t>(columns))};
    samples.values[0] = time;
    samples.values[4] = velocity;
    series.See(samples);
  }
  v1::Job job;
  job.mutable_summary()->set_iterations(7);
  std::vector<double> values;
  for (const auto& metric : metrics.Of(job, series)) values.push_back(metric.value);
  EXPECT_THAT(values, ElementsAre(2, 5, 5, -3, 1.0, 0.5, 7));
  EXPECT_TRUE(std::isnan(metrics.Of({}).front().value));  // Of a cell without samples.
}

TEST(SweepMetrics, OfChannelsThatAreNotThereAreRefusedWithTheNearest) {
  v1::Sweep sweep = Grid();
  sweep.add_metrics("series[B1.velocty].max");
  sweep.add_metrics("series[B1.velocity].max");
  EXPECT_THAT(Mistakes(sweep),
              ElementsAre("metrics[1]: the base has no channel 'B1.velocty' — did you "
                          "mean 'B1.velocity'?"));
  sweep.mutable_base()->mutable_output()->set_ledger_only(true);
  sweep.set_metrics(1, "summary.steps");
  EXPECT_THAT(Mistakes(sweep),
              ElementsAre("metrics[2]: goes not with base.output.ledger_only, which makes no "
                          "samples"));
  v1::Sweep wrong;
  wrong.add_metrics("series[B1.velocity].largest");
  wrong.add_metrics("series.max");
  std::vector<Violation> violations;
  const SweepMetrics metrics(wrong, &violations);
  ASSERT_EQ(violations.size(), 2U);
  EXPECT_EQ(violations[0].description, "'series[B1.velocity].largest': unknown word 'largest'");
  EXPECT_EQ(violations[1].description, "'series.max' names no number of a channel");
}

// Four cycles of two contacts, the last of which was cut before its restitution was known.
v1::Job FourCycles() {
  v1::Job job;
  for (const auto& [contact, force, restitution] :
       std::vector<std::tuple<const char*, double, double>>{
           {"A-B", 5, 0.8}, {"B-C", 9, 0.7}, {"A-B", 7, 0.6}, {"B-C", 2, std::nan("")}}) {
    v1::Cycle& cycle = *job.add_cycles();
    cycle.set_contact(contact);
    cycle.set_peak_force_n(force);
    cycle.set_restitution_out(restitution);
  }
  return job;
}

SweepMetrics::Metric Of(const std::string& metric, const v1::Job& job) {
  v1::Sweep sweep;
  sweep.add_metrics(metric);
  std::vector<Violation> violations;
  const SweepMetrics metrics(sweep, &violations);
  EXPECT_TRUE(violations.empty()) << metric;
  return metrics.Of(job).front();
}

double MetricOf(const std::string& metric, const v1::Job& job) { return Of(metric, job).value; }
v1::SweepCell::Source SourceOf(const std::string& metric, const v1::Job& job) {
  return Of(metric, job).source;
}

TEST(SweepMetrics, ChooseAmongAllEntriesOrThoseOfAName) {
  const v1::Job job = FourCycles();
  EXPECT_EQ(MetricOf("cycles.count", job), 4);
  EXPECT_EQ(MetricOf("cycles[A-B].count", job), 2);
  EXPECT_EQ(MetricOf("cycles.first.peak_force_n", job), 5);
  EXPECT_EQ(MetricOf("cycles[B-C].first.peak_force_n", job), 9);
  EXPECT_EQ(MetricOf("cycles[A-B].last.restitution_out", job), 0.6);
  EXPECT_EQ(MetricOf("cycles.max.peak_force_n", job), 9);
  EXPECT_EQ(MetricOf("cycles[A-B].max.peak_force_n", job), 7);
  EXPECT_EQ(MetricOf("cycles.min.peak_force_n", job), 2);
}

TEST(SweepMetrics, ChooseAmongTheNumbersOfAList) {
  v1::Job job;
  for (const double mu : {7.0, 9.0, 8.0}) job.add_groups()->add_other_roots(mu);
  for (const double mu : {6.0, 5.0}) job.mutable_groups(1)->add_other_roots(mu);
  const auto of_group = [&](const std::string& pick) {
    return MetricOf("groups[1].other_roots" + pick, job);
  };
  EXPECT_EQ(of_group("[1]"), 6);
  EXPECT_EQ(of_group(".first"), 9);
  EXPECT_EQ(of_group(".last"), 5);
  EXPECT_EQ(of_group(".max"), 9);
  EXPECT_EQ(of_group(".min"), 5);
  EXPECT_EQ(of_group(".count"), 3);
  EXPECT_EQ(MetricOf("groups.last.other_roots.first", job), 8);
  EXPECT_TRUE(std::isnan(of_group("[3]")));
  EXPECT_TRUE(std::isnan(MetricOf("groups[3].other_roots.max", job)));
}

TEST(SweepMetrics, LargestAndSmallestLeaveOutWhatIsNoNumber) {
  const v1::Job job = FourCycles();
  EXPECT_EQ(MetricOf("cycles[B-C].min.restitution_out", job), 0.7);
  EXPECT_EQ(MetricOf("cycles[B-C].max.restitution_out", job), 0.7);
  EXPECT_TRUE(std::isnan(MetricOf("cycles.last.restitution_out", job)));
}

TEST(SweepMetrics, OfNoEntryCountIsZeroAndNumbersAreUnknown) {
  EXPECT_EQ(MetricOf("cycles.count", v1::Job()), 0);
  EXPECT_EQ(MetricOf("groups[A-B].count", FourCycles()), 0);
  for (const auto* metric : {"cycles.last.mu", "cycles.max.mu", "groups.min.mu"}) {
    EXPECT_TRUE(std::isnan(MetricOf(metric, v1::Job()))) << metric;
  }
}

// FourCycles, of which B-C's last is cut in compression: its force is not known.
v1::Job CutRun() {
  v1::Job job = FourCycles();
  v1::Cycle& last = *job.mutable_cycles(3);
  last.set_end(v1::Cycle::RUN_END);
  last.set_status(v1::Cycle::CUT);
  last.set_mu(4);
  last.set_peak_force_n(std::nan(""));
  return job;
}

TEST(SweepMetrics, OfACutCycleIsCutWhateverItsNumber) {
  const v1::Job job = CutRun();
  EXPECT_EQ(MetricOf("cycles[B-C].last.mu", job), 4);
  for (const auto* metric : {"cycles[B-C].last.mu", "cycles[3].peak_force_n", "cycles.last.number",
                             "cycles.max.peak_force_n", "cycles[B-C].min.restitution_out"}) {
    EXPECT_EQ(SourceOf(metric, job), v1::SweepCell::CUT) << metric;
  }
  for (const auto* metric : {"cycles[A-B].last.mu", "cycles[0].peak_force_n", "cycles.count",
                             "cycles[A-B].max.peak_force_n", "cycles.min.mu", "iterations"}) {
    EXPECT_EQ(SourceOf(metric, job), v1::SweepCell::RESULT) << metric;
  }
}

TEST(SweepMetrics, LargestIsCutOnlyIfACutCycleHasItOrMayExceedIt) {
  v1::Job job = CutRun();
  EXPECT_EQ(SourceOf("cycles.max.mu", job), v1::SweepCell::CUT);
  job.mutable_cycles(0)->set_mu(5);
  EXPECT_EQ(SourceOf("cycles.max.mu", job), v1::SweepCell::RESULT);
}

TEST(SweepMetrics, WhatTheEndCutsIsToldByStatusOrEnd) {
  v1::Job job = CutRun();
  v1::Cycle& last = *job.mutable_cycles(3);
  for (const auto& [status, end, source] :
       {std::tuple(v1::Cycle::UNFINISHED, v1::Cycle::NON_SEPARATION, v1::SweepCell::CUT),
        std::tuple(v1::Cycle::GIVEN_LAW, v1::Cycle::RUN_END, v1::SweepCell::CUT),
        std::tuple(v1::Cycle::SETTLED, v1::Cycle::RUN_END, v1::SweepCell::RESULT),
        std::tuple(v1::Cycle::RELEASED, v1::Cycle::SEPARATION, v1::SweepCell::RESULT)}) {
    last.set_status(status);
    last.set_end(end);
    EXPECT_EQ(SourceOf("cycles.last.mu", job), source) << last.ShortDebugString();
  }
}

TEST(SweepMetrics, OfASearchWithoutACycleSaySo) {
  for (const auto* metric : {"iterations", "convergence", "worst_identity_residual"}) {
    EXPECT_EQ(SourceOf(metric, v1::Job()), v1::SweepCell::NO_CONTACT) << metric;
    EXPECT_EQ(SourceOf(metric, FourCycles()), v1::SweepCell::RESULT) << metric;
  }
  EXPECT_EQ(SourceOf("kinetic_energy_j", v1::Job()), v1::SweepCell::RESULT);
}

TEST(SweepMetrics, OfAContactThatWasNotTouchedSaySo) {
  const v1::Job job = FourCycles();
  for (const auto* metric : {"cycles[C-D].mu", "groups[A-B].mu", "cycles[C-D].max.peak_force_n"}) {
    EXPECT_EQ(SourceOf(metric, job), v1::SweepCell::NO_CONTACT) << metric;
  }
  for (const auto* metric : {"cycles[9].mu", "cycles[C-D].count", "final_bodies[0].position_m"}) {
    EXPECT_EQ(SourceOf(metric, job), v1::SweepCell::RESULT) << metric;
  }
}

TEST(SweepMetrics, ChoicesAreOfListsAndEndWithANumber) {
  v1::Sweep sweep = Grid();
  for (const auto* metric :
       {"cycles[0].last.mu", "cycles.count.mu", "cycles.max", "cycles.mean.mu",
        "cycles.last.contact", "groups[0].other_roots[A-B]", "groups[0].other_roots"}) {
    sweep.add_metrics(metric);
  }
  EXPECT_THAT(Mistakes(sweep),
              ElementsAre(HasSubstr("metrics[1]: 'cycles[0].last.mu': unknown field 'last'"),
                          "metrics[2]: 'cycles.count.mu': unknown field 'mu'",
                          HasSubstr("metrics[3]: 'cycles.max' is not a number"),
                          HasSubstr("metrics[4]: 'cycles.mean.mu': cycles is a list"),
                          HasSubstr("metrics[5]: 'cycles.last.contact' is not a number"),
                          HasSubstr("metrics[6]: 'groups[0].other_roots[A-B]': other_roots is a"),
                          HasSubstr("metrics[7]: 'groups[0].other_roots': other_roots is a list")));
}

}  // namespace
}  // namespace contact
