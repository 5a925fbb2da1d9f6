#include "simulation/campaign/contract_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace contact::campaign {
namespace {

using Json = nlohmann::ordered_json;

Json JsonOf(const Body& b) {
  Json json = {{"name", b.name}, {"mass_kg", b.mass}, {"radius_m", b.radius}};
  json.update({{"position_m", b.position}, {"velocity_m_per_s", b.velocity}});
  if (b.fixed) json["fixed"] = true;
  return json;
}

// A motion of one piece as it is; one of several, whose accelerations are constant, by velocities.
Json MotionOf(const Scenario& s, int body) {
  Json points = Json::array();
  for (const Drive& d : s.drives) {
    if (d.body != body) continue;
    if (d.amplitude != 0) {
      return {{"sine",
               {{"amplitude_m", d.amplitude},
                {"angular_frequency_rad_per_s", d.angular_frequency},
                {"phase_rad", d.phase}}}};
    }
    points.push_back({{"time_s", d.begin}, {"velocity_m_per_s", d.velocity}});
  }
  return {{"velocity_table", {{"points", points}}}};
}

void AddMotions(const Scenario& s, Json& bodies) {
  for (const Drive& d : s.drives) {
    Json& json = bodies[static_cast<std::size_t>(d.body)];
    if (d.begin > 0) continue;
    json.erase("fixed");
    json.erase("velocity_m_per_s");
    json["position_m"] = d.position;
    json["motion"] = MotionOf(s, d.body);
  }
}

// Of a play the contact on the left, which stands for both.
Json JsonOf(const Scenario& s, const Contact& c) {
  Json json = {{"name", c.name}, {"between", Json::array()}, {"stiffness", c.stiffness}};
  const int first = c.play > 0 ? c.right : c.left, second = c.play > 0 ? c.left : c.right;
  for (const int body : {first, second}) {
    if (body != kNone) json["between"].push_back(s.bodies[static_cast<std::size_t>(body)].name);
  }
  if (c.left == kNone || c.right == kNone) json["wall"] = {{"position_m", c.wall_position}};
  if (c.play > 0) {
    json["name"] = c.name.substr(0, c.name.rfind('-'));
    json["clearance_m"] = c.play;
  } else if (json.contains("wall")) {
    json["wall"]["side"] = c.left == kNone ? "LEFT" : "RIGHT";
  }
  json["exponent"] = c.exponent;
  if (IsGiven(c.damping)) {
    json[c.damping == DampingLaw::kGiven ? "mu" : "damping_n_s_per_m"] = c.mu;
  } else {
    json["restitution"] = c.restitution;
  }
  if (c.damping != DampingLaw::kEnergyRestitution) json["damping"] = RowOf(c.damping).name;
  if (c.reference_velocity > 0) json["reference_velocity_m_per_s"] = c.reference_velocity;
  return json;
}

Json JsonOf(const Scenario& s, const Support& p) {
  const auto name = [&](int body) { return s.bodies[static_cast<std::size_t>(body)].name; };
  Json json = {{"body", name(p.body)}, {"stiffness_n_per_m", p.stiffness}};
  if (p.other != kNone) json["other"] = name(p.other);
  json.update({{"damping_n_s_per_m", p.damping}, {"rest_position_m", p.rest_position}});
  if (!p.higher.empty()) json["higher_stiffness"] = p.higher;
  if (!std::isinf(p.slip_force)) json["slip_force_n"] = p.slip_force;
  return json;
}

// A smooth piece as the contract has it: a sine with others has a line of its own, see Add.
Json Straight(const Load& l) {
  if (l.slope != 0) {
    const double end = l.constant + l.slope * (l.end - l.begin);
    const Json from = {{"time_s", l.begin}, {"force_n", l.constant}};
    return {{"table", {{"points", {from, {{"time_s", l.end}, {"force_n", end}}}}}}};
  }
  if (!std::isinf(l.end)) {
    return {
        {"rectangular_pulse",
         {{"force_n", l.constant}, {"start_time_s", l.begin}, {"duration_s", l.end - l.begin}}}};
  }
  if (l.begin > 0) return {{"step", {{"force_n", l.constant}, {"start_time_s", l.begin}}}};
  return {{"constant", {{"force_n", l.constant}}}};
}

Json Swinging(const Load& l) {
  if (!std::isinf(l.end)) {
    return {{"half_sine_pulse",
             {{"amplitude_n", l.amplitude},
              {"start_time_s", l.begin},
              {"duration_s", l.end - l.begin}}}};
  }
  return {{"sine",
           {{"amplitude_n", l.amplitude},
            {"angular_frequency_rad_per_s", l.angular_frequency},
            {"phase_rad", l.phase}}}};
}

void Add(const Scenario& s, const Load& l, Json& loads) {
  const std::string& body = s.bodies[static_cast<std::size_t>(l.body)].name;
  for (Json load : {Straight(l), Swinging(l)}) {
    const bool swings = load.contains("sine") || load.contains("half_sine_pulse");
    if (swings ? l.amplitude == 0 : l.constant == 0 && l.slope == 0) continue;
    load["body"] = body;
    loads.push_back(load);
  }
}

}  // namespace

std::string ContractJson(const Scenario& s, const std::string& title) {
  Json json = {{"title", title}};
  for (const char* list : {"bodies", "contacts", "supports", "loads"}) json[list] = Json::array();
  for (const Body& b : s.bodies) json["bodies"].push_back(JsonOf(b));
  AddMotions(s, json["bodies"]);
  for (const Contact& c : s.contacts) {
    if (c.play == 0 || c.name.ends_with("-left")) json["contacts"].push_back(JsonOf(s, c));
  }
  if (s.starts_at_rest) json["start"] = "AT_EQUILIBRIUM";
  for (const Support& p : s.supports) json["supports"].push_back(JsonOf(s, p));
  for (const Load& l : s.loads) Add(s, l, json["loads"]);
  constexpr const char* kScopes[] = {"AUTO", "CYCLE", "ENCOUNTER"};
  json["solver"] = {{"restitution_scope", kScopes[static_cast<int>(s.solver.restitution_scope)]},
                    {"max_steps", s.solver.max_steps}};
  if (s.solver.clip_tension) json["solver"]["tension"] = "CLIP";
  json["end_time_s"] = s.end_time;
  json["output"] = {{"ledger_only", true}};
  return json.dump();
}

}  // namespace contact::campaign
