#include "cli/text/comparison/job_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "cli/text/render_groups.h"
#include "cli/text/render_json.h"
#include "cli/text/render_ledger.h"

namespace contact::cli {
namespace {

// A JSON pointer as scenario files write paths: `/bodies/0/mass_kg` is `bodies[0].mass_kg`.
std::string PathOf(const std::string& pointer) {
  std::string path;
  for (std::size_t begin = 1; begin <= pointer.size();) {
    const std::size_t end = std::min(pointer.find('/', begin), pointer.size());
    const std::string part = pointer.substr(begin, end - begin);
    const bool index = std::isdigit(static_cast<unsigned char>(part.front())) != 0;
    path += index ? fmt::format("[{}]", part) : (path.empty() ? "" : ".") + part;
    begin = end + 1;
  }
  return path;
}

std::string TextOf(const nlohmann::json& value) {
  if (value.is_string()) return value.get<std::string>();
  return value.is_number_float() ? fmt::to_string(value.get<double>()) : value.dump();
}

// The fields that are set in at least one scenario and not equal in all. A message without fields
// has none.
std::vector<JobComparison::Parameter> Differing(const std::vector<v1::Job>& jobs) {
  std::map<std::string, std::vector<std::string>> all;  // The values of all jobs by path.
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const auto fields = nlohmann::json::parse(ToJsonLine(jobs[i].scenario())).flatten();
    for (const auto& [pointer, value] : fields.items()) {
      if (value.is_null()) continue;
      all.try_emplace(PathOf(pointer), jobs.size()).first->second[i] = TextOf(value);
    }
  }
  std::vector<JobComparison::Parameter> differing;
  for (const auto& [path, values] : all) {
    const bool equal = std::ranges::adjacent_find(values, std::not_equal_to()) == values.end();
    if (!equal) differing.push_back({path, values});
  }
  return differing;
}

// Gathers results job by job. Results stand in the order in which the first job with each has it.
class Results {
 public:
  explicit Results(std::size_t jobs) : jobs_(jobs) {}

  void Add(std::size_t job, const std::string& name, const std::string& unit,
           JobComparison::Value value, bool judged = true) {
    const auto [place, added] = places_.try_emplace(name, all_.size());
    if (added) {
      all_.push_back({name, unit, std::vector<JobComparison::Value>(jobs_), judged});
    }
    all_[place->second].values[job] = std::move(value);
  }

  void AddCycle(std::size_t job, const v1::Cycle& cycle) {
    const std::string name = fmt::format("{} #{} ", cycle.contact(), cycle.number());
    Add(job, name + "status", "", v1::Cycle::Status_Name(cycle.status()));
    Add(job, name + "end", "", v1::Cycle::End_Name(cycle.end()));
    Add(job, name + "μ", "N·s/m^(n+1)", cycle.mu());
    Add(job, name + "ε out", "1", RestitutionOf(cycle));
    Add(job, name + "peak force", "N", cycle.peak_force_n());
    Add(job, name + "δ max", "m", cycle.delta_max_m());
    Add(job, name + "t end", "s", cycle.end_time_s());
  }

  // Of one cycle the row of the cycle tells all.
  void AddGroup(std::size_t job, const v1::Group& group) {
    if (group.cycles() == 1) return;
    const std::string name = fmt::format("{} group {} ", group.contact(), group.number());
    Add(job, name + "cycles", "", CyclesOf(group));
    Add(job, name + "ε out", "1", group.restitution_out());
    Add(job, name + "t end", "s", group.end_time_s());
  }

  void AddJob(std::size_t job, const v1::Job& message) {
    Add(job, "state", "", v1::Job::State_Name(message.state()));
    Add(job, "convergence", "", v1::Job::Convergence_Name(message.convergence()));
    Add(job, "cycles", "1", static_cast<double>(message.cycles_size()));
    for (const v1::Cycle& cycle : message.cycles()) AddCycle(job, cycle);
    for (const v1::Group& group : message.groups()) AddGroup(job, group);
    for (const v1::FinalBody& body : message.final_bodies()) {
      Add(job, body.name() + " final position", "m", body.position_m());
      Add(job, body.name() + " final velocity", "m/s", body.velocity_m_per_s());
    }
    const v1::RunSummary& summary = message.summary();
    Add(job, "kinetic energy at the end", "J", summary.kinetic_energy_j());
    Add(job, "iterations", "1", static_cast<double>(summary.iterations()), false);
    Add(job, "steps", "1", static_cast<double>(summary.steps()), false);
    Add(job, "wall time", "s", summary.wall_time_s(), false);
  }

  std::vector<JobComparison::Result> Take() { return std::move(all_); }

 private:
  const std::size_t jobs_;
  std::map<std::string, std::size_t> places_;
  std::vector<JobComparison::Result> all_;
};

}  // namespace

bool JobComparison::Result::Holds(std::size_t job, const Tolerance& allowed) const {
  const Value& base = values.front();
  const Value& value = values[job];
  const auto* a = std::get_if<double>(&base);
  const auto* b = std::get_if<double>(&value);
  if (!judged || a == nullptr || b == nullptr) return !judged || base == value;
  if (std::isnan(*a) || std::isnan(*b)) return std::isnan(*a) && std::isnan(*b);
  return *a == *b ||
         std::abs(*b - *a) <= std::max(allowed.absolute, allowed.relative * std::abs(*a));
}

double JobComparison::Result::Deviation(std::size_t job) const {
  const auto* a = std::get_if<double>(&values.front());
  const auto* b = std::get_if<double>(&values[job]);
  if (a == nullptr || b == nullptr) return std::numeric_limits<double>::quiet_NaN();
  return *a == 0 ? *b : (*b - *a) / std::abs(*a);
}

bool JobComparison::Holds(const Result& result) const {
  for (std::size_t job = 1; job < names.size(); ++job) {
    if (!result.Holds(job, tolerance)) return false;
  }
  return true;
}

bool JobComparison::Holds() const {
  return std::ranges::all_of(results, [this](const Result& result) { return Holds(result); });
}

JobComparison Compare(const std::vector<v1::Job>& jobs, const Tolerance& tolerance) {
  JobComparison comparison{{}, Differing(jobs), {}, tolerance};
  Results results(jobs.size());
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    comparison.names.push_back(jobs[i].name());
    results.AddJob(i, jobs[i]);
  }
  comparison.results = results.Take();
  return comparison;
}

}  // namespace contact::cli
