// Rules between the fields of a scenario, each with its words.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "wire/every_message.h"

namespace contact {
namespace {

struct Case {
  const char* name;
  std::function<void(v1::Scenario&)> change;
  std::vector<std::string> lines;
};

std::vector<Case> Cases() {
  using S = v1::Scenario;
  const auto contact = [](S& s) -> v1::Contact& { return *s.mutable_contacts(0); };
  const auto table = [](S& s) -> v1::ForceTable& {
    v1::Contact& c = *s.mutable_contacts(0);
    c.clear_stiffness(), c.clear_exponent(), c.clear_restitution();
    c.set_damping(v1::Contact::FORCE_TABLE);
    c.mutable_force_table()->add_deformations_m(1e-4), c.mutable_force_table()->add_forces_n(5);
    return *c.mutable_force_table();
  };
  return {
      {"TitleOf200Characters",
       [](S& s) {
         std::string title;
         for (int i = 0; i < 200; ++i) title += "μ";
         s.set_title(title);
       },
       {}},
      {"TitleThatSteersATerminal",
       // In pieces: clang-tidy refuses a literal that turns the direction of text.
       [](S& s) { s.set_title(std::string("ball\x1b]0;pwn\x07\xe2\x80") + "\xae"); },
       {"title: holds control characters: 'ball?]0;pwn\?\?' — remove them"}},
      {"TitleOf201Characters",
       [](S& s) { s.set_title(std::string(201, 'x')); },
       {"title: has 201 characters; must have at most 200"}},
      {"SupportOfOrder8",
       [](S& s) {
         for (int i = 0; i < 7; ++i) s.mutable_supports(0)->add_higher_stiffness(1);
       },
       {"supports[0].higher_stiffness: holds 7; must hold at most 6"}},
      {"SlipOfABentSpring",
       [](S& s) {
         s.mutable_supports(0)->add_higher_stiffness(1);
         s.mutable_supports(0)->set_slip_force_n(1);
       },
       {"supports[0].slip_force_n: is given beside higher_stiffness — only a linear spring slips"}},
      {"SlipOfNoSpring",
       [](S& s) { s.mutable_supports(0)->set_slip_force_n(1); },
       {"supports[0].slip_force_n: is given, but stiffness_n_per_m is 0 — give the stiffness up to "
        "that force, or remove it"}},
      {"SlipBeforeTheStart",
       [](S& s) {
         s.mutable_supports(0)->set_stiffness_n_per_m(2);
         s.mutable_supports(0)->set_rest_position_m(3);
         s.mutable_supports(0)->set_slip_force_n(5.5);
       },
       {"supports[0].slip_force_n: is 5.5, but the spring begins with 6 N — give it a "
        "rest_position_m with which it begins with less, or a larger force"}},
      {"NoBodies",
       [](S& s) { s.clear_bodies(), s.clear_contacts(), s.clear_supports(), s.clear_loads(); },
       {"bodies: is missing — a scenario needs at least one body"}},
      {"NameOf64Characters",
       [](S& s) { s.mutable_bodies(2)->set_name(std::string(64, 'x')), s.clear_contacts(); },
       {}},
      {"NameOf65Characters",
       [](S& s) { s.mutable_bodies(2)->set_name(std::string(65, 'x')), s.clear_contacts(); },
       {"bodies[2].name: is '" + std::string(64, 'x') +
        "…'; must be 1 to 64 letters, digits, '_', '.' or '-'"}},
      {"NameWithASpace",
       [](S& s) { s.mutable_bodies(2)->set_name("a b"), s.clear_contacts(); },
       {"bodies[2].name: is 'a b'; must be 1 to 64 letters, digits, '_', '.' or '-'"}},
      {"NoName",
       [](S& s) { s.mutable_bodies(2)->clear_name(), s.mutable_contacts()->RemoveLast(); },
       {"bodies[2].name: is missing — contacts refer to the body by its name"}},
      {"NameTwice",
       [](S& s) { s.mutable_bodies(1)->set_name("B1"), s.clear_contacts(); },
       {"bodies[1].name: is 'B1', which another body is called — names of bodies are unique"}},
      {"MassAndDensity",
       [](S& s) { s.mutable_bodies(0)->set_density_kg_per_m3(1); },
       {"bodies[0].density_kg_per_m3: is given beside mass_kg — give one of the two"}},
      {"NoMass",
       [](S& s) { s.mutable_bodies(0)->clear_mass_kg(); },
       {"bodies[0].mass_kg: is missing — give mass_kg, or density_kg_per_m3 and radius_m"}},
      {"DensityWithoutRadius",
       [](S& s) { s.mutable_bodies(1)->clear_radius_m(); },
       {"bodies[1].radius_m: is missing — density_kg_per_m3 needs a radius_m > 0"}},
      {"DensityWithRadiusZero",
       [](S& s) { s.mutable_bodies(1)->set_radius_m(0); },
       {"bodies[1].radius_m: is 0, which gives no mass — density_kg_per_m3 needs a radius_m > 0"}},
      {"DensityThatMakesTooMuchMass",
       [](S& s) {
         s.clear_contacts();
         s.mutable_bodies(1)->set_radius_m(1e6);
       },
       {"bodies[1].density_kg_per_m3: gives a mass of 4.1887902047863906e+21 kg; must be in (0, "
        "1e12]"}},
      {"FixedBodyThatMoves",
       [](S& s) {
         s.mutable_bodies(2)->set_fixed(true), s.mutable_bodies(2)->set_velocity_m_per_s(1);
         s.mutable_contacts()->RemoveLast();
       },
       {"bodies[2].velocity_m_per_s: is 1; must be 0 for a fixed body — motion: {uniform: "
        "{velocity_m_per_s: …}} moves it"}},

      {"NoBetween",
       [&](S& s) { contact(s).clear_between(); },
       {"contacts[0].between: is missing — name two bodies, or one body and give wall"}},
      {"OneNameWithoutAWall",
       [&](S& s) { contact(s).mutable_between()->RemoveLast(); },
       {"contacts[0].between: names one body — name two bodies, or give wall"}},
      {"TwoNamesAndAWall",
       [&](S& s) { contact(s).mutable_wall()->set_side(v1::Wall::LEFT); },
       {"contacts[0].between: names 2 bodies beside a wall; must name one — remove wall, or all "
        "names but one"}},
      {"WallAsTheSecondName",
       [](S& s) { s.mutable_contacts(1)->add_between("wall"); },
       {"contacts[1].between: names 'wall' beside 'B3'; must name the body alone — between: [B3] "
        "names the body; the wall is only in wall"}},
      {"WallAsAName",
       [&](S& s) { contact(s).set_between(0, "wall"); },
       {"contacts[0].between: names 'wall' beside 'B2'; must name the body alone — between: [B2] "
        "names the body; the wall is only in wall: {side: LEFT or RIGHT}"}},
      {"WallWithoutASide",
       [](S& s) { s.mutable_contacts(1)->mutable_wall()->clear_side(); },
       {"contacts[1].wall.side: is missing — LEFT or RIGHT of the body"}},
      {"WallOnASideThatIsNone",
       [](S& s) {
         s.mutable_contacts(1)->mutable_wall()->set_side(static_cast<v1::Wall::Side>(7));
       },
       {"contacts[1].wall.side: is 7, which is no value of Side"}},
      {"UnknownBody",
       [&](S& s) { contact(s).set_between(0, "ball"); },
       {"contacts[0].between[0]: is 'ball', which no body is called — bodies are B1, B2, B3"}},
      {"EmptyBodyName",
       [&](S& s) { contact(s).set_between(0, ""); },
       {"contacts[0].between[0]: is missing — give the name of a body"}},
      {"BodyWithItself",
       [&](S& s) { contact(s).set_between(1, "B1"); },
       {"contacts[0].between: names 'B1' twice in a row — a body cannot touch itself"}},
      {"PairTwice",
       [&](S& s) { *s.add_contacts() = contact(s), s.mutable_contacts(2)->set_name("again"); },
       {"contacts[2].between: repeats the contact of 'B1' and 'B2'"}},
      {"WallTwice",
       [](S& s) { *s.add_contacts() = s.contacts(1), s.mutable_contacts(2)->set_name("again"); },
       {"contacts[2].between: repeats another contact of this body and this wall"}},
      {"TwoWallsOnOneSide",
       [](S& s) {
         *s.add_contacts() = s.contacts(1), s.mutable_contacts(2)->set_name("stop");
         s.mutable_contacts(2)->mutable_wall()->set_position_m(4);
       },
       {}},
      {"ContactNameTwice",
       [&](S& s) { contact(s).set_name("B3-wall"); },
       {"contacts[1].name: is 'B3-wall', which another contact is called — give each contact a "
        "name of its own"}},
      {"ContactNameWithASpace",
       [&](S& s) { contact(s).set_name("a b"); },
       {"contacts[0].name: is 'a b'; must be 1 to 64 letters, digits, '_', '.' or '-'"}},
      {"RightBodyFirst",
       [&](S& s) { contact(s).set_between(0, "B2"), contact(s).set_between(1, "B1"); },
       {"contacts[0].between: names 'B2' first, which stands to the right of 'B1' (1 > 0 m) — left "
        "body first: [B1, B2]"}},
      {"BodiesThatOverlap",
       [](S& s) { s.mutable_bodies(1)->set_position_m(0.0625); },
       {"contacts[0].between: 'B1' and 'B2' overlap at the start: δ = 0.037500000000000006 m; must "
        "be ≤ 0 — move them apart, or set start: AS_GIVEN"}},
      {"BodyInsideAWall",
       [](S& s) { s.mutable_bodies(2)->set_position_m(3.5); },
       {"contacts[1].between: 'B3' and the wall overlap at the start: δ = 0.5 m; must be ≤ 0 — "
        "move them apart, or set start: AS_GIVEN"}},
      {"BodyBehindAWallToTheLeft",
       [](S& s) { s.mutable_contacts(1)->mutable_wall()->set_side(v1::Wall::LEFT); },
       {"contacts[1].between: 'B3' and the wall overlap at the start: δ = 1 m; must be ≤ 0 — move "
        "them apart, or set start: AS_GIVEN"}},
      {"StartThatIsNone",
       [](S& s) { s.set_start(static_cast<v1::Scenario::Start>(9)); },
       {"start: is 9, which is no value of Start"}},
      {"EquilibriumOfWhatNothingHolds",
       [](S& s) { s.set_start(v1::Scenario::AT_EQUILIBRIUM); },
       {"start: is AT_EQUILIBRIUM, but no positions were found at which all forces balance; in "
        "search of them 'B3' goes farthest — let a contact or support hold it, give it a velocity, "
        "or set start: AS_GIVEN"}},
      {"EquilibriumBesideWhatMoves",
       [](S& s) {
         s.set_start(v1::Scenario::AT_EQUILIBRIUM), s.clear_loads();
         s.mutable_bodies(1)->set_position_m(0.0625), s.mutable_bodies(1)->set_velocity_m_per_s(1);
       },
       {"start: is AT_EQUILIBRIUM, in which contact 'B1-B2', a side of which has a velocity, "
        "overlaps: δ = 0.037500000000000006 m — move that body away"}},
      {"BothBodiesFixed",
       [](S& s) {
         s.mutable_bodies(0)->set_fixed(true), s.mutable_bodies(1)->set_fixed(true);
         s.clear_supports(), s.clear_loads();
       },
       {"contacts[0].between: forces move neither 'B1' nor 'B2' — one side of a contact must be "
        "able to move"}},
      {"FixedBodyAtAWall",
       [](S& s) { s.mutable_bodies(2)->set_fixed(true); },
       {"contacts[1].between: forces do not move 'B3', nor the wall — one side of a contact must "
        "be able to move"}},
      {"NoStiffness",
       [&](S& s) { contact(s).clear_stiffness(); },
       {"contacts[0].stiffness: is missing — k, in N/m^exponent; or the material of both sides"}},
      {"Materials", [](S& s) { HertzPair(s), HertzWall(s); }, {}},
      {"MaterialBesideStiffness", [](S& s) { Glass(s.mutable_bodies(0)->mutable_material()); }, {}},
      {"MaterialOfOneSide",
       [](S& s) { HertzPair(s), s.mutable_bodies(1)->clear_material(); },
       {"contacts[0].stiffness: is missing, and 'B2' has no material — give stiffness, or the "
        "material of both sides"}},
      {"MaterialWithoutRadius",
       [](S& s) { HertzWall(s), s.mutable_bodies(2)->clear_radius_m(); },
       {"contacts[1].stiffness: is missing, and 'B3' has no radius — that of a Hertz contact needs "
        "radius_m > 0"}},
      {"MaterialWithAnotherExponent",
       [&](S& s) { HertzPair(s), contact(s).set_exponent(1); },
       {"contacts[0].exponent: is 1; must be 1.5 where stiffness is not given — materials make a "
        "Hertz contact"}},
      {"MaterialOfTheBodyAndNotOfTheWall",
       [](S& s) { HertzWall(s), s.mutable_contacts(1)->mutable_wall()->clear_material(); },
       {"contacts[1].wall.material: is missing, and so is stiffness — give one of the two"}},
      {"MaterialOfTheWallBesideStiffness",
       [](S& s) { HertzWall(s), s.mutable_contacts(1)->set_stiffness(1); },
       {"contacts[1].wall.material: is given beside stiffness — give one of the two"}},
      {"MaterialWithoutNumbers",
       [](S& s) { HertzPair(s), s.mutable_bodies(0)->mutable_material()->Clear(); },
       {"bodies[0].material.youngs_modulus_pa: is missing; must be in (0, 1e15] — steel has 2.1e11",
        "bodies[0].material.poisson_ratio: is missing — steel has 0.3"}},
      {"MaterialWithANegativeModulus",
       [](S& s) {
         HertzPair(s), s.mutable_bodies(0)->mutable_material()->set_youngs_modulus_pa(-1);
       },
       {"bodies[0].material.youngs_modulus_pa: is -1; must be in (0, 1e15]"}},
      {"MaterialsThatMakeTooMuchStiffness",
       [](S& s) {
         HertzWall(s);
         const double ratio = std::nextafter(-1, 0);
         s.mutable_bodies(2)->mutable_material()->set_youngs_modulus_pa(1e15);
         s.mutable_bodies(2)->mutable_material()->set_poisson_ratio(ratio);
         s.mutable_contacts(1)->mutable_wall()->mutable_material()->set_youngs_modulus_pa(1e15);
         s.mutable_contacts(1)->mutable_wall()->mutable_material()->set_poisson_ratio(ratio);
         s.mutable_contacts(1)->mutable_wall()->set_position_m(1e9);
         s.mutable_bodies(2)->set_radius_m(1e6);
       },
       {"contacts[1].stiffness: is missing, and follows as 3.0023997515803305e+33 from the "
        "materials; must be in (0, 1e30]"}},
      {"NoRestitution",
       [&](S& s) { contact(s).clear_restitution(); },
       {"contacts[0].restitution: is missing — 1 is elastic; damping MU with mu needs none"}},
      {"MuWithoutItsValue",
       [](S& s) { s.mutable_contacts(1)->clear_mu(); },
       {"contacts[1].mu: is missing; damping MU needs it"}},
      {"MuWithAnotherDamping",
       [&](S& s) { contact(s).set_mu(1); },
       {"contacts[0].mu: is given, but goes only with damping MU — remove mu, or set damping: MU"}},
      {"MuWithKelvinAndVoigt",
       [&](S& s) {
         contact(s).set_mu(1), contact(s).set_damping(v1::Contact::KELVIN_VOIGT);
         contact(s).set_exponent(1);
       },
       {"contacts[0].mu: is given, but goes only with damping MU — remove mu, or set damping: MU; "
        "for a damper c of your own damping: DASHPOT with damping_n_s_per_m"}},
      {"DashpotWithoutItsDamper",
       [&](S& s) { contact(s).set_damping(v1::Contact::DASHPOT), contact(s).set_exponent(1); },
       {"contacts[0].damping_n_s_per_m: is missing; damping DASHPOT needs it"}},
      {"DamperWithAnotherDamping",
       [&](S& s) { contact(s).set_damping_n_s_per_m(1); },
       {"contacts[0].damping_n_s_per_m: is given, but goes only with damping DASHPOT — remove "
        "damping_n_s_per_m, or set damping: DASHPOT"}},
      {"TableOfForces", [&](S& s) { table(s).set_unloading_stiffness_n_per_m(5e4); }, {}},
      {"TableThatIsMissing",
       [&](S& s) { table(s), contact(s).clear_force_table(); },
       {"contacts[0].force_table: is missing; damping FORCE_TABLE needs it"}},
      {"TableWithAnotherDamping",
       [&](S& s) { contact(s).mutable_force_table(); },
       {"contacts[0].force_table: is given, but goes only with damping FORCE_TABLE — remove "
        "force_table, or set damping: FORCE_TABLE"}},
      {"TableBesideOtherNumbers",
       [&](S& s) {
         table(s), contact(s).set_stiffness(1), contact(s).set_exponent(1);
         contact(s).set_restitution(1), contact(s).set_reference_velocity_m_per_s(1);
       },
       {"contacts[0].stiffness: is given beside damping FORCE_TABLE — remove it; force_table says "
        "all",
        "contacts[0].exponent: is given beside damping FORCE_TABLE — remove it; force_table says "
        "all",
        "contacts[0].restitution: is given beside damping FORCE_TABLE — remove it; force_table "
        "says all",
        "contacts[0].reference_velocity_m_per_s: is given beside damping FORCE_TABLE — remove it; "
        "force_table says all"}},
      {"TableWithoutPoints",
       [&](S& s) { table(s).Clear(); },
       {"contacts[0].force_table.deformations_m: is missing — one point is a straight line"}},
      {"TableWithTooFewForces",
       [&](S& s) { table(s).add_deformations_m(1e-5); },
       {"contacts[0].force_table.forces_n: has 1 entries; deformations_m has 2 — give a force for "
        "each deformation",
        "contacts[0].force_table.deformations_m[1]: is 1e-05; must be above 0.0001, the one "
        "before — a plateau is a slight slope"}},
      {"TableThatGoesBack",
       [&](S& s) {
         v1::ForceTable& t = table(s);
         t.add_deformations_m(1e-4), t.add_forces_n(6);
       },
       {"contacts[0].force_table.deformations_m[1]: is 0.0001; must be above 0.0001, the one "
        "before — a plateau is a slight slope"}},
      {"TableWithAPlateau",
       [&](S& s) {
         v1::ForceTable& t = table(s);
         t.add_deformations_m(2e-4), t.add_forces_n(5);
       },
       {"contacts[0].force_table.forces_n[1]: is 5; must be above 5, the one before — a plateau is "
        "a slight slope"}},
      {"TableFromBelowZero",
       [&](S& s) { table(s).set_forces_n(0, -5); },
       {"contacts[0].force_table.forces_n[0]: is -5; must be in (0, 1e15]"}},
      {"TableThatMakesEnergy",
       [&](S& s) { table(s).set_unloading_stiffness_n_per_m(4e4); },
       {"contacts[0].force_table.unloading_stiffness_n_per_m: is 40000; must be at least 50000, "
        "the steepest slope of the points — a way back above the way there would make energy"}},
      {"TableThatStiffensNoWayBack",
       [&](S& s) { table(s).set_unloading_stiffening_per_m(1); },
       {"contacts[0].force_table.unloading_stiffening_per_m: is given without "
        "unloading_stiffness_n_per_m — it adds to that stiffness"}},
      {"KelvinVoigt",
       [&](S& s) { contact(s).set_damping(v1::Contact::KELVIN_VOIGT); },
       {"contacts[0].exponent: is 1.5; damping KELVIN_VOIGT needs 1 — set exponent: 1"}},
      {"HertzQuarterPower",
       [&](S& s) {
         contact(s).set_damping(v1::Contact::HERTZ_QUARTER_POWER), contact(s).set_exponent(2);
       },
       {"contacts[0].exponent: is 2; damping HERTZ_QUARTER_POWER needs 1.5 — set exponent: 1.5"}},
      {"DampingThatIsNone",
       [&](S& s) { contact(s).set_damping(static_cast<v1::Contact::Damping>(99)); },
       {"contacts[0].damping: is 99, which is no value of Damping"}},

      {"SupportOfNobody",
       [](S& s) { s.mutable_supports(0)->clear_body(); },
       {"supports[0].body: is missing — give the name of a body"}},
      {"SupportOfAFixedBody",
       [](S& s) { s.mutable_bodies(0)->set_fixed(true), s.clear_loads(); },
       {"supports[0].body: is fixed; forces do not move it"}},
      {"SupportToItself",
       [](S& s) { s.mutable_supports(0)->set_other("B1"); },
       {"supports[0].other: is the body itself — leave it out for a support to the ground"}},
      {"SupportToNobodyKnown",
       [](S& s) { s.mutable_supports(0)->set_other("B4"); },
       {"supports[0].other: is 'B4', which no body is called — did you mean 'B1'?"}},
      {"LoadOfNobody",
       [](S& s) { s.mutable_loads(0)->clear_body(); },
       {"loads[0].body: is missing — give the name of a body"}},
      {"LoadOfNoKind",
       [](S& s) { s.mutable_loads(0)->clear_constant(); },
       {"loads[0]: has no kind — give one of constant, sine, gravity, step, rectangular_pulse, "
        "half_sine_pulse and table"}},
      {"LoadOnAFixedBody",
       [](S& s) {
         s.mutable_bodies(0)->set_fixed(true), s.clear_supports();
         s.mutable_loads()->DeleteSubrange(1, 2);
       },
       {"loads[0].body: is fixed; forces do not move it"}},
      {"PulseWithoutDuration",
       [](S& s) { Rectangular(s).clear_duration_s(); },
       {"loads[0].rectangular_pulse.duration_s: is missing; must be in [1e-12, 1e6]"}},
      {"HalfSineWithoutDuration",
       [](S& s) { HalfSine(s).clear_duration_s(); },
       {"loads[0].half_sine_pulse.duration_s: is missing; must be in [1e-12, 1e6]"}},
      {"TableOfOnePoint",
       [](S& s) { s.mutable_loads(0)->mutable_table()->add_points(); },
       {"loads[0].table.points: holds 1; must hold 2 to 10000"}},
      {"TableThatGoesBackInTime",
       [](S& s) { Table(s).mutable_points(2)->set_time_s(1); },
       {"loads[0].table.points[2].time_s: is 1, which is not after the 1 before — points follow "
        "one another in time"}},
      {"TableBeforeTheStart",
       [](S& s) { Table(s).mutable_points(0)->set_time_s(-1); },
       {"loads[0].table.points[0].time_s: is -1; must be in [0, 1e6]"}},
      {"GravityOfEveryBodyTwice",
       [](S& s) { s.add_loads()->mutable_gravity(); },
       {"loads[3].gravity: repeats the gravity of every body — give it once"}},

      {"StepTooLong",
       [](S& s) {
         s.mutable_solver()->set_method(v1::Solver::RK4), s.mutable_solver()->set_step_s(2);
       },
       {"solver.step_s: is 2; must be in (0, 1]"}},
      {"StepWithoutRk4",
       [](S& s) { s.mutable_solver()->set_step_s(1e-6); },
       {"solver.step_s: is given, but goes only with method RK4 — remove it"}},
      {"PeakForceSplitUnderNewton",
       [](S& s) { s.mutable_solver()->set_phase_split(v1::Solver::PEAK_FORCE); },
       {"solver.phase_split: is PEAK_FORCE, which update NEWTON_COUPLED cannot solve — take update "
        "PAPER_RATIO, or phase_split PEAK_DEFORMATION"}},
      {"ScopeThatIsNone",
       [](S& s) {
         s.mutable_solver()->set_restitution_scope(static_cast<v1::Solver::RestitutionScope>(4));
       },
       {"solver.restitution_scope: is 4, which is no value of RestitutionScope"}},
      {"EncounterCyclesZeroInAnotherScope",
       [](S& s) { s.mutable_solver()->set_encounter_cycles(0); },
       {"solver.encounter_cycles: is 0; must be in [1, 1000]",
        "solver.encounter_cycles: is given, but goes only with restitution_scope ENCOUNTER — "
        "remove it"}},
      {"EncounterCycles",
       [](S& s) {
         s.mutable_solver()->set_restitution_scope(v1::Solver::ENCOUNTER);
         s.mutable_solver()->set_encounter_cycles(1000);
       },
       {}},
      {"TensionClip", [](S& s) { s.mutable_solver()->set_tension(v1::Solver::CLIP); }, {}},
      {"OnNotConvergedThatIsNone",
       [](S& s) {
         s.mutable_solver()->set_on_not_converged(static_cast<v1::Solver::OnNotConverged>(3));
       },
       {"solver.on_not_converged: is 3, which is no value of OnNotConverged"}},
      {"SamplesPerContactNegative",
       [](S& s) { s.mutable_output()->set_samples_per_contact(-1); },
       {"output.samples_per_contact: is -1; must be in [0, 10000]"}},
      {"SamplesPerContactTooMany",
       [](S& s) { s.mutable_output()->set_samples_per_contact(10'001); },
       {"output.samples_per_contact: is 10001; must be in [0, 10000]"}},
      {"SamplesPerContactMost",
       [](S& s) { s.mutable_output()->set_samples_per_contact(10'000); },
       {}},
      {"SampleIntervalZero",
       [](S& s) { s.mutable_output()->set_sample_interval_s(0); },
       {"output.sample_interval_s: is 0; must be > 0"}},
      {"SampleIntervalNan",
       [](S& s) { s.mutable_output()->set_sample_interval_s(std::nan("")); },
       {"output.sample_interval_s: is nan; must be > 0"}},
      {"SampleIntervalSoSmallThatTheCountOverflows",
       [](S& s) { s.mutable_output()->set_sample_interval_s(5e-324); },
       {"output.sample_interval_s: is 5e-324, which makes inf samples; must make at most 10000000 "
        "— set output.ledger_only to record none"}},
  };
}

class ScenarioRuleTest : public testing::TestWithParam<Case> {};

TEST_P(ScenarioRuleTest, HasTheseWords) {
  v1::Scenario message = Everything();
  GetParam().change(message);
  EXPECT_EQ(LinesOf(message), GetParam().lines);
}

INSTANTIATE_TEST_SUITE_P(Scenario, ScenarioRuleTest, testing::ValuesIn(Cases()),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace contact
