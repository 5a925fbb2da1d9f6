#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "simulation/campaign/result.h"

namespace contact::campaign {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kStatuses[] = {"FULL", "PARTIAL", "BUDGET", "FAILED"};
constexpr const char* kVerdicts[] = {"", "agrees", "disagrees", "not checked"};

template <class Value, std::size_t n>
Value ValueOf(const char* const (&names)[n], const std::string& name) {
  return static_cast<Value>(std::ranges::find(names, name) - std::begin(names));
}

// Every field of a line, under its name.
template <class AnyResult, class Visitor>
void ForEachField(AnyResult& r, const Visitor& visit) {
  visit("kind", r.kind), visit("seed", r.seed), visit("status", r.status), visit("end", r.end);
  visit("message", r.message), visit("end_time_s", r.end_time), visit("time_s", r.time);
  visit("bodies", r.bodies), visit("groups", r.groups), visit("longest", r.longest);
  visit("cycles", r.cycles), visit("jumps", r.jumps), visit("released", r.released);
  visit("limited", r.limited), visit("cut", r.cut), visit("passes", r.passes);
  visit("iterations", r.iterations), visit("growths", r.growths), visit("steps", r.steps);
  visit("evaluations", r.evaluations), visit("ms", r.ms), visit("restitution", r.restitution);
  visit("identity", r.identity), visit("momentum", r.momentum), visit("energy", r.energy);
  visit("broken", r.broken), visit("certificate", r.certificate);
  visit("metamorphic", r.metamorphic);
}

struct Writer {
  Json& json;

  template <class Value>
  void operator()(const char* key, const Value& value) const {
    json[key] = value;
  }
  void operator()(const char* key, Result::Status status) const { json[key] = NameOf(status); }
  void operator()(const char* key, const Check& check) const {
    if (check.verdict == Check::Verdict::kNone) return;
    json[key] = {{"verdict", kVerdicts[static_cast<int>(check.verdict)]},
                 {"worst", check.worst},
                 {"what", check.what}};
  }
  void operator()(const char* key, const std::vector<Result::Count>& counts) const {
    json[key] = Json::object();
    for (const auto& [status, count] : counts) json[key][status] = count;
  }
};

struct Reader {
  const Json& json;

  template <class Value>
  void operator()(const char* key, Value& value) const {
    value = json.at(key).get<Value>();
  }
  // What is not finite is null in JSON.
  void operator()(const char* key, double& value) const { value = Number(json.at(key)); }
  void operator()(const char* key, Result::Status& status) const {
    status = ValueOf<Result::Status>(kStatuses, json.at(key));
  }
  void operator()(const char* key, Check& check) const {
    if (!json.contains(key)) return;
    const Json& read = json.at(key);
    check = {ValueOf<Check::Verdict>(kVerdicts, read.at("verdict")), Number(read.at("worst")),
             read.at("what")};
  }
  void operator()(const char* key, std::vector<Result::Count>& counts) const {
    for (const auto& [status, count] : json.at(key).items()) counts.emplace_back(status, count);
  }

  static double Number(const Json& value) { return value.is_null() ? kNaN : value.get<double>(); }
};

}  // namespace

std::string ToJson(const Result& result) {
  Json json;
  ForEachField(result, Writer{json});
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Result FromJson(const std::string& line) {
  const Json json = Json::parse(line);
  Result result;
  ForEachField(result, Reader{json});
  return result;
}

const char* NameOf(Result::Status status) { return kStatuses[static_cast<int>(status)]; }

}  // namespace contact::campaign
