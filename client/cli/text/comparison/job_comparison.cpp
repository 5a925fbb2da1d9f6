#include "cli/text/comparison/job_comparison.h"

#include <fmt/format.h>
#include <google/protobuf/descriptor.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace contact::cli {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using Fields = std::map<std::string, std::string>;  // Values by path.

std::string Text(const Message& message, const FieldDescriptor& field, int index) {
  const auto& reflection = *message.GetReflection();
  const bool many = field.is_repeated();
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return fmt::to_string(many ? reflection.GetRepeatedDouble(message, &field, index)
                                 : reflection.GetDouble(message, &field));
    case FieldDescriptor::CPPTYPE_INT32:
      return fmt::to_string(many ? reflection.GetRepeatedInt32(message, &field, index)
                                 : reflection.GetInt32(message, &field));
    case FieldDescriptor::CPPTYPE_INT64:
      return fmt::to_string(many ? reflection.GetRepeatedInt64(message, &field, index)
                                 : reflection.GetInt64(message, &field));
    case FieldDescriptor::CPPTYPE_BOOL:
      return reflection.GetBool(message, &field) ? "true" : "false";
    case FieldDescriptor::CPPTYPE_ENUM:
      return (many ? reflection.GetRepeatedEnum(message, &field, index)
                   : reflection.GetEnum(message, &field))
          ->name();
    default:
      return many ? reflection.GetRepeatedString(message, &field, index)
                  : reflection.GetString(message, &field);
  }
}

void AddFields(const Message& message, const std::string& path, Fields* fields) {
  const auto& reflection = *message.GetReflection();
  std::vector<const FieldDescriptor*> set;
  reflection.ListFields(message, &set);
  for (const FieldDescriptor* field : set) {
    const std::string here = path.empty() ? field->name() : path + "." + field->name();
    const bool nested = field->cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE;
    if (!field->is_repeated() && nested) {
      AddFields(reflection.GetMessage(message, field), here, fields);
    } else if (!field->is_repeated()) {
      (*fields)[here] = Text(message, *field, 0);
    }
    for (int i = 0; field->is_repeated() && i < reflection.FieldSize(message, field); ++i) {
      const std::string entry = fmt::format("{}[{}]", here, i);
      if (nested) {
        AddFields(reflection.GetRepeatedMessage(message, field, i), entry, fields);
      } else {
        (*fields)[entry] = Text(message, *field, i);
      }
    }
  }
}

std::vector<JobComparison::Parameter> Differing(const std::vector<v1::Job>& jobs) {
  std::vector<Fields> all(jobs.size());
  std::set<std::string> paths;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    AddFields(jobs[i].scenario(), "", &all[i]);
    for (const auto& [path, value] : all[i]) paths.insert(path);
  }
  std::vector<JobComparison::Parameter> differing;
  for (const std::string& path : paths) {
    JobComparison::Parameter parameter{path, {}};
    for (const Fields& fields : all) {
      const auto found = fields.find(path);
      parameter.values.push_back(found == fields.end() ? "" : found->second);
    }
    const std::string& first = parameter.values.front();
    if (std::ranges::all_of(parameter.values, [&](const auto& v) { return v == first; })) continue;
    differing.push_back(std::move(parameter));
  }
  return differing;
}

// Gathers results of one job after the other, in the order in which they are first met.
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
    Add(job, name + "ε out", "1", cycle.restitution_out());
    Add(job, name + "peak force", "N", cycle.peak_force_n());
    Add(job, name + "δ max", "m", cycle.delta_max_m());
    Add(job, name + "t end", "s", cycle.end_time_s());
  }

  void AddJob(std::size_t job, const v1::Job& message) {
    Add(job, "state", "", v1::Job::State_Name(message.state()));
    Add(job, "convergence", "", v1::Job::Convergence_Name(message.convergence()));
    Add(job, "cycles", "1", static_cast<double>(message.cycles_size()));
    for (const v1::Cycle& cycle : message.cycles()) AddCycle(job, cycle);
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
