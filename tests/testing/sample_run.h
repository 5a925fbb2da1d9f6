#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "cli/link/recording.h"

namespace contact::cli {

/// A run as a server would have recorded it: ball A hits ball B, which hits the wall W. Times are
/// 0 to 1 s in steps of 1/64 s; each contact has one cycle, of half a second.
inline Recording SampleRun(const std::string& title = "Two balls & a <wall>") {
  Recording run;
  v1::Job& job = run.job;
  job.set_name("jobs/sample");
  job.set_state(v1::Job::SUCCEEDED);
  job.set_convergence(v1::Job::FULL);
  job.set_spec_sha256("0123456789abcdef");
  job.set_server_version("0.1.0");
  v1::Scenario& scenario = *job.mutable_scenario();
  scenario.set_title(title);
  scenario.set_end_time_s(1);
  double position = 0;
  for (const char* name : {"A", "B"}) {
    v1::Body& body = *scenario.add_bodies();
    body.set_name(name);
    body.set_mass_kg(2);
    body.set_radius_m(0.5);
    body.set_position_m(position++);
  }
  scenario.mutable_bodies(0)->set_velocity_m_per_s(1);
  v1::Contact& pair = *scenario.add_contacts();
  pair.set_name("A-B");
  pair.add_between("A");
  pair.add_between("B");
  v1::Contact& wall = *scenario.add_contacts();
  wall.set_name("W");
  wall.add_between("B");
  wall.mutable_wall()->set_position_m(1.75);
  wall.mutable_wall()->set_side(v1::Wall::RIGHT);
  for (v1::Contact& contact : *scenario.mutable_contacts()) {
    contact.set_stiffness(1e8);
    contact.set_restitution(0.8);
    v1::Cycle& cycle = *job.add_cycles();
    cycle.set_contact(contact.name());
    cycle.set_number(1);
    cycle.set_kind(v1::Cycle::COLLISION);
    cycle.set_end(v1::Cycle::SEPARATION);
    cycle.set_status(v1::Cycle::CONVERGED);
    cycle.set_start_time_s(job.cycles_size() == 1 ? 0 : 0.5);
    cycle.set_turn_time_s(cycle.start_time_s() + 0.25);
    cycle.set_end_time_s(cycle.start_time_s() + 0.5);
    cycle.set_restitution_in(0.8);
    cycle.set_restitution_out(0.79);
    cycle.set_peak_force_n(100);
    cycle.set_mu_over_k_s_per_m(0.5);
  }
  std::vector<double> time;
  std::vector<double> ramp;
  std::vector<double> wave;
  for (int i = 0; i <= 64; ++i) {
    time.push_back(i / 64.0);
    ramp.push_back(2 * time.back());
    wave.push_back(100 * std::sin(time.back()));
  }
  run.columns = {{"time", "time", "s", time}};
  for (const char* body : {"A", "B"}) {
    run.columns.push_back({std::string(body) + ".position", "position", "m", ramp});
    run.columns.push_back({std::string(body) + ".velocity", "velocity", "m/s", ramp});
  }
  for (const char* contact : {"A-B", "W"}) {
    for (const auto& [quantity, unit] :
         {std::pair("deformation", "m"), std::pair("deformation_velocity", "m/s"),
          std::pair("contact_force", "N"), std::pair("external_force", "N")}) {
      run.columns.push_back({std::string(contact) + "." + quantity, quantity, unit, wave});
    }
  }
  for (int pass = 0; pass < 3; ++pass) {
    v1::Iteration& iteration = run.iterations.emplace_back();
    iteration.set_episode(1);
    iteration.set_number(pass);
    v1::Iteration::Unknown& unknown = *iteration.add_unknowns();
    unknown.set_contact("A-B");
    unknown.set_number(1);
    unknown.set_mu(1e6 * (pass + 1));
    unknown.set_residual(pass == 2 ? 0 : -0.1 / (pass + 1));
    unknown.set_restitution_in(0.8);
    unknown.set_restitution_out(0.79);
  }
  return run;
}

}  // namespace contact::cli
