// Numbers of a scenario: both ends of each range, one step past them, NaN and infinity.
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <limits>

#include "wire/every_message.h"

namespace contact {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

struct NumberRule {
  const char* field;
  double low;
  double high;
  const char* range;
  std::function<void(v1::Scenario&, double)> set;
};

std::vector<NumberRule> NumberRules() {
  using S = v1::Scenario;
  return {
      {"bodies[2].mass_kg", 0, 1e12, "(0, 1e12]",
       [](S& s, double v) { s.mutable_bodies(2)->set_mass_kg(v); }},
      {"bodies[2].radius_m", 0, 1e6, "[0, 1e6]",
       [](S& s, double v) {
         s.mutable_contacts(1)->mutable_wall()->set_position_m(1e9);
         s.mutable_bodies(2)->set_radius_m(v);
       }},
      {"bodies[1].density_kg_per_m3", 0, 1e9, "(0, 1e9]",
       [](S& s, double v) { s.mutable_bodies(1)->set_density_kg_per_m3(v); }},
      {"bodies[2].position_m", -1e9, 1e9, "[-1e9, 1e9]",
       [](S& s, double v) {
         s.mutable_contacts()->RemoveLast();
         s.mutable_bodies(2)->set_position_m(v);
       }},
      {"bodies[2].velocity_m_per_s", -1e6, 1e6, "[-1e6, 1e6]",
       [](S& s, double v) { s.mutable_bodies(2)->set_velocity_m_per_s(v); }},
      {"contacts[0].stiffness", 0, 1e30, "(0, 1e30]",
       [](S& s, double v) { s.mutable_contacts(0)->set_stiffness(v); }},
      {"contacts[0].exponent", 1, 5, "[1, 5]",
       [](S& s, double v) { s.mutable_contacts(0)->set_exponent(v); }},
      {"contacts[0].restitution", 0, 1, "(0, 1]",
       [](S& s, double v) { s.mutable_contacts(0)->set_restitution(v); }},
      {"contacts[1].mu", 0, 1e30, "[0, 1e30]",
       [](S& s, double v) { s.mutable_contacts(1)->set_mu(v); }},
      {"contacts[0].reference_velocity_m_per_s", 0, 1e6, "(0, 1e6]",
       [](S& s, double v) { s.mutable_contacts(0)->set_reference_velocity_m_per_s(v); }},
      {"contacts[1].wall.position_m", -1e9, 1e9, "[-1e9, 1e9]",
       [](S& s, double v) {
         s.mutable_contacts(1)->mutable_wall()->set_side(v < 0 ? v1::Wall::LEFT : v1::Wall::RIGHT);
         s.mutable_contacts(1)->mutable_wall()->set_position_m(v);
       }},
      {"supports[0].stiffness_n_per_m", 0, 1e30, "[0, 1e30]",
       [](S& s, double v) { s.mutable_supports(0)->set_stiffness_n_per_m(v); }},
      {"supports[0].damping_n_s_per_m", 0, 1e30, "[0, 1e30]",
       [](S& s, double v) { s.mutable_supports(0)->set_damping_n_s_per_m(v); }},
      {"supports[0].rest_position_m", -1e9, 1e9, "[-1e9, 1e9]",
       [](S& s, double v) { s.mutable_supports(0)->set_rest_position_m(v); }},
      {"supports[0].slip_force_n", 0, 1e15, "(0, 1e15]",
       [](S& s, double v) {
         s.mutable_supports(0)->set_stiffness_n_per_m(1);
         s.mutable_supports(0)->set_slip_force_n(v);
       }},
      {"supports[0].higher_stiffness[1]", -1e30, 1e30, "[-1e30, 1e30]",
       [](S& s, double v) {
         for (const double k : {0.0, v}) s.mutable_supports(0)->add_higher_stiffness(k);
       }},
      {"loads[0].constant.force_n", -1e15, 1e15, "[-1e15, 1e15]",
       [](S& s, double v) { s.mutable_loads(0)->mutable_constant()->set_force_n(v); }},
      {"loads[1].sine.amplitude_n", -1e15, 1e15, "[-1e15, 1e15]",
       [](S& s, double v) { s.mutable_loads(1)->mutable_sine()->set_amplitude_n(v); }},
      {"loads[1].sine.angular_frequency_rad_per_s", 0, 1e9, "[0, 1e9]",
       [](S& s, double v) {
         s.mutable_loads(1)->mutable_sine()->set_angular_frequency_rad_per_s(v);
       }},
      {"loads[1].sine.phase_rad", -1e3, 1e3, "[-1e3, 1e3]",
       [](S& s, double v) { s.mutable_loads(1)->mutable_sine()->set_phase_rad(v); }},
      {"loads[2].gravity.acceleration_m_per_s2", -1e9, 1e9, "[-1e9, 1e9]",
       [](S& s, double v) { s.mutable_loads(2)->mutable_gravity()->set_acceleration_m_per_s2(v); }},
      {"loads[0].step.force_n", -1e15, 1e15, "[-1e15, 1e15]",
       [](S& s, double v) { s.mutable_loads(0)->mutable_step()->set_force_n(v); }},
      {"loads[0].step.start_time_s", 0, 1e6, "[0, 1e6]",
       [](S& s, double v) { s.mutable_loads(0)->mutable_step()->set_start_time_s(v); }},
      {"loads[0].rectangular_pulse.force_n", -1e15, 1e15, "[-1e15, 1e15]",
       [](S& s, double v) { Rectangular(s).set_force_n(v); }},
      {"loads[0].rectangular_pulse.start_time_s", 0, 1e6, "[0, 1e6]",
       [](S& s, double v) { Rectangular(s).set_start_time_s(v); }},
      {"loads[0].rectangular_pulse.duration_s", 1e-12, 1e6, "[1e-12, 1e6]",
       [](S& s, double v) { Rectangular(s).set_duration_s(v); }},
      {"loads[0].half_sine_pulse.amplitude_n", -1e15, 1e15, "[-1e15, 1e15]",
       [](S& s, double v) { HalfSine(s).set_amplitude_n(v); }},
      {"loads[0].half_sine_pulse.start_time_s", 0, 1e6, "[0, 1e6]",
       [](S& s, double v) { HalfSine(s).set_start_time_s(v); }},
      {"loads[0].half_sine_pulse.duration_s", 1e-12, 1e6, "[1e-12, 1e6]",
       [](S& s, double v) { HalfSine(s).set_duration_s(v); }},
      {"loads[0].table.points[0].force_n", -1e15, 1e15, "[-1e15, 1e15]",
       [](S& s, double v) { Table(s).mutable_points(0)->set_force_n(v); }},
      {"bodies[0].material.poisson_ratio", -1, 0.5, "(-1, 0.5]",
       [](S& s, double v) {
         Glass(s.mutable_bodies(0)->mutable_material())->set_poisson_ratio(v);
       }},
      {"contacts[1].wall.material.poisson_ratio", -1, 0.5, "(-1, 0.5]",
       [](S& s, double v) {
         HertzWall(s);
         s.mutable_contacts(1)->mutable_wall()->mutable_material()->set_poisson_ratio(v);
       }},
      {"solver.relative_tolerance", 1e-13, 1e-3, "[1e-13, 1e-3]",
       [](S& s, double v) { s.mutable_solver()->set_relative_tolerance(v); }},
      {"solver.restitution_tolerance", 1e-12, 0.1, "[1e-12, 0.1]",
       [](S& s, double v) { s.mutable_solver()->set_restitution_tolerance(v); }},
      {"solver.settled_fraction", 0, 0.1, "[0, 0.1]",
       [](S& s, double v) { s.mutable_solver()->set_settled_fraction(v); }},
      {"end_time_s", 0, 1e6, "(0, 1e6]", [](S& s, double v) { s.set_end_time_s(v); }},
  };
}

// The hint to who asks for a restitution of 0.
constexpr char kOfZero[] = " — no finite μ takes all energy; 0.01 leaves 1e-4 of it";

class NumberRuleTest : public testing::TestWithParam<NumberRule> {
 protected:
  static std::vector<std::string> With(double value) {
    v1::Scenario message = Everything();
    GetParam().set(message, value);
    return LinesOf(message);
  }
  static void ExpectRefused(double value) {
    const NumberRule& rule = GetParam();
    std::string line = fmt::format("{}: is {}; must be in {}", rule.field, value, rule.range);
    if (value == 0 && std::string(rule.field) == "contacts[0].restitution") line += kOfZero;
    EXPECT_THAT(With(value), ElementsAre(line));
  }
  static bool open() { return GetParam().range[0] == '('; }
};

TEST_P(NumberRuleTest, HoldsUpToBothEndsAndNotPastThem) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double low = GetParam().low;
  EXPECT_THAT(With(GetParam().high), IsEmpty());
  ExpectRefused(std::nextafter(GetParam().high, kInfinity));
  if (!open()) {
    EXPECT_THAT(With(low), IsEmpty());
    ExpectRefused(std::nextafter(low, -kInfinity));
  } else if (std::string(GetParam().field) == "end_time_s") {
    EXPECT_THAT(With(low), ElementsAre("end_time_s: is missing; must be in (0, 1e6]"));
    ExpectRefused(-1);
  } else {
    ExpectRefused(low);
  }
}

TEST_P(NumberRuleTest, RefusesNanAndInfinity) {
  ExpectRefused(std::numeric_limits<double>::quiet_NaN());
  ExpectRefused(std::numeric_limits<double>::infinity());
  ExpectRefused(-std::numeric_limits<double>::infinity());
}

INSTANTIATE_TEST_SUITE_P(Scenario, NumberRuleTest, testing::ValuesIn(NumberRules()),
                         [](const auto& test) {
                           std::string name = test.param.field;
                           std::ranges::replace_if(
                               name, [](char c) { return std::isalnum(c) == 0; }, '_');
                           return name;
                         });

TEST(CountRules, HoldUpToBothEndsAndNotPastThem) {
  v1::Scenario message = Everything();
  for (const int right : {1, 1000}) {
    message.mutable_solver()->set_max_iterations(right);
    EXPECT_THAT(LinesOf(message), IsEmpty());
  }
  for (const int wrong : {0, 1001}) {
    message.mutable_solver()->set_max_iterations(wrong);
    EXPECT_THAT(
        LinesOf(message),
        ElementsAre(fmt::format("solver.max_iterations: is {}; must be in [1, 1000]", wrong)));
  }
  message = Everything();
  for (const std::int64_t right : {std::int64_t{1}, std::int64_t{1'000'000'000'000}}) {
    message.mutable_solver()->set_max_steps(right);
    EXPECT_THAT(LinesOf(message), IsEmpty());
  }
  message.mutable_solver()->set_max_steps(0);
  EXPECT_THAT(LinesOf(message), ElementsAre("solver.max_steps: is 0; must be in [1, 1e12]"));
}

}  // namespace
}  // namespace contact
