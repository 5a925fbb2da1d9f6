#include "cli/verbs/laws/law_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string/case_conv.hpp>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/spelling.h"
#include "cli/base/number.h"
#include "cli/link/connect.h"
#include "cli/link/jobs.h"
#include "cli/verbs/job/follow.h"

namespace contact::cli {
namespace {

// A ball of 1 kg at 1 m/s: contacts last some milliseconds, the balls come 0.2 s apart.
constexpr double kGap = 0.2;
constexpr double kHertzStiffness = 1e8, kLinearStiffness = 1e6;

std::string NameOf(std::size_t point) { return fmt::format("P{}", point); }

// Runs the scenario as a job and deletes the job. Throws Failure unless the run succeeds.
v1::Job RunToItsEnd(Client& client, const v1::Scenario& scenario, const Settings& settings) {
  v1::CreateJobRequest create;
  *create.mutable_job()->mutable_scenario() = scenario;
  create.set_request_id(RandomRequestId());
  const std::string name = client.Call(&Client::Stub::CreateJob, create).name();
  const WatchEnd end = AwaitEnd(client, name, settings);
  if (end != WatchEnd::kFinished) {
    throw Failure(Detach(end, name), "the comparison is not complete");
  }
  v1::Job result = GetJob(client, name);
  if (result.state() != v1::Job::SUCCEEDED) {
    throw Failure(ExitCode::kRunFailed,
                  fmt::format("{} did not succeed: contactctl describe {}", name, ShortName(name)));
  }
  DeleteJob(client, name);
  return result;
}

using Json = nlohmann::ordered_json;

Json JsonOf(const LawEntry& law) {
  return {{"law", law.name},
          {"formula", law.formula},
          {"source", law.source},
          {"range", law.range},
          {"closed_form", law.closed_form()}};
}

Json JsonOf(const LawPoint& point) {
  return {{"law", point.law->name},
          {"requested", point.requested},
          {"delivered", point.delivered},
          {"miss", point.miss()},
          {"method", point.method()}};
}

template <class Items>
std::string JsonList(const Items& items) {
  Json list = Json::array();
  for (const auto& item : items) list.push_back(JsonOf(item));
  return list.dump(2) + "\n";
}

Tone ToneOf(const LawPoint& point, Tone otherwise) {
  return std::abs(point.miss()) > 0.01 ? Tone::kWarning : otherwise;
}

}  // namespace

LawPoint PointOf(const LawEntry& law, double requested) {
  return {.law = &law,
          .requested = requested,
          .delivered = law.closed_form() ? law.Delivered(requested) : 0};
}

const LawEntry& FindLaw(const std::string& text) {
  std::string name = boost::to_upper_copy(text);
  std::ranges::replace(name, '-', '_');
  std::vector<std::string_view> names;
  for (const LawEntry& law : LawCatalogue()) {
    if (law.name == name) return law;
    names.push_back(law.name);
  }
  throw Failure(ExitCode::kUsage, WithHint(fmt::format("there is no law {}", Quoted(text)),
                                           DidYouMean(name, names, "see contactctl model list")));
}

std::vector<const LawEntry*> ChooseLaws(const std::vector<std::string>& names, bool closed_form) {
  std::vector<const LawEntry*> laws;
  for (const std::string& name : names) laws.push_back(&FindLaw(name));
  if (!laws.empty()) return laws;
  for (const LawEntry& law : LawCatalogue()) {
    if (law.closed_form() || !closed_form) laws.push_back(&law);
  }
  return laws;
}

v1::Scenario CollisionsOf(const std::vector<LawPoint>& points) {
  v1::Scenario scenario;
  scenario.set_title("What damping laws deliver in isolated collisions");
  for (std::size_t i = 0; i < points.size(); ++i) {
    v1::Body& body = *scenario.add_bodies();
    body.set_name(NameOf(i));
    body.set_mass_kg(1);
    body.set_velocity_m_per_s(1);
    v1::Contact& contact = *scenario.add_contacts();
    contact.set_name(NameOf(i));
    contact.add_between(NameOf(i));
    contact.mutable_wall()->set_side(v1::Wall::RIGHT);
    contact.mutable_wall()->set_position_m(kGap * static_cast<double>(i + 1));
    const bool linear = points[i].law->contact_exponent == 1;
    contact.set_exponent(linear ? 1 : 1.5);
    contact.set_stiffness(linear ? kLinearStiffness : kHertzStiffness);
    contact.set_restitution(points[i].requested);
    contact.set_damping(DampingOf(points[i].law->law));
  }
  scenario.mutable_output()->set_ledger_only(true);
  scenario.set_end_time_s(kGap * static_cast<double>(points.size() + 1));
  return scenario;
}

void Simulate(std::vector<LawPoint>* points, const Settings& settings) {
  std::vector<LawPoint> simulated;
  for (const LawPoint& point : *points) {
    if (!point.law->closed_form()) simulated.push_back(point);
  }
  if (simulated.empty()) return;
  Client client = Connect(settings);
  const v1::Job job = RunToItsEnd(client, CollisionsOf(simulated), settings);
  std::size_t next = 0;
  for (LawPoint& point : *points) {
    if (point.law->closed_form()) continue;
    const std::string name = NameOf(next++);
    for (const v1::Cycle& cycle : job.cycles()) {
      if (cycle.contact() == name) point.delivered = cycle.restitution_out();
    }
    if (point.delivered == 0) {
      throw Failure(ExitCode::kRunFailed, fmt::format("{} has no cycle of {}", job.name(), name));
    }
  }
}

std::string LawJson(const LawEntry& law) { return JsonOf(law).dump(2) + "\n"; }

std::string LawsJson(const std::vector<LawEntry>& laws) { return JsonList(laws); }

std::string PointsJson(const std::vector<LawPoint>& points) { return JsonList(points); }

Table DeliveryTable(const LawEntry& law, const std::vector<double>& restitutions) {
  Table table({{"ε ASKED", true}, {"α", true}, {"ε DELIVERED", true}, {"MISS", true}});
  for (const double e : restitutions) {
    const LawPoint point = PointOf(law, e);
    table.Add({Digits(e, 6),
               Digits(law.alpha(e), 8),
               Digits(point.delivered, 8),
               {fmt::format("{:+.2f} %", 100 * point.miss()), ToneOf(point, Tone::kPlain)}});
  }
  return table;
}

std::vector<Table::Column> PointColumns() {
  return {{"law"}, {"requested"}, {"delivered"}, {"miss"}, {"method"}};
}

Table PointTable(const std::vector<LawPoint>& points) {
  Table table(PointColumns());
  for (const LawPoint& p : points) {
    table.Add({std::string(p.law->name), fmt::to_string(p.requested), fmt::to_string(p.delivered),
               fmt::to_string(p.miss()), std::string(p.method())});
  }
  return table;
}

std::vector<Table::Column> ComparisonColumns(const std::vector<double>& restitutions) {
  std::vector<Table::Column> columns = {{"LAW"}};
  for (const double e : restitutions) columns.push_back({fmt::to_string(e), true});
  return columns;
}

Table ComparisonTable(const std::vector<LawPoint>& points,
                      const std::vector<double>& restitutions) {
  Table table(ComparisonColumns(restitutions));
  for (auto point = points.begin(); point != points.end();) {
    std::vector<Table::Cell> row = {std::string(point->law->name)};
    for (std::size_t i = 0; i < restitutions.size(); ++i, ++point) {
      row.emplace_back(fmt::format("{:.5f}", point->delivered), ToneOf(*point, Tone::kGood));
    }
    table.Add(std::move(row));
  }
  return table;
}

}  // namespace contact::cli
