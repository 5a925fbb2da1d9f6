#include "cli/help/candidates.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>

#include "cli/input/scenario_file.h"
#include "cli/input/settable_fields.h"
#include "cli/input/templates.h"
#include "cli/link/job_names.h"
#include "cli/paper/items.h"
#include "cli/settings/config.h"
#include "cli/settings/resolve.h"
#include "contact/v1/event.pb.h"
#include "wire/scenario/law_catalogue.h"

namespace contact::cli {
namespace {

// The words that a validator allows, which it tells in braces.
Candidates Allowed(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t begin = type.find('{');
  const std::size_t end = type.find('}', begin);
  Candidates words;
  if (begin == std::string::npos || end == std::string::npos) return words;
  for (std::size_t at = begin + 1; at < end;) {
    const std::size_t stop = std::min(type.find(',', at), end);
    words.push_back({type.substr(at, stop - at), ""});
    at = stop + 1;
  }
  return words;
}

// A call that takes at most 300 ms and may fail.
template <class Request, class Response>
std::optional<Response> Ask(const Settings& settings,
                            grpc::Status (Client::Stub::*method)(grpc::ClientContext*,
                                                                 const Request&, Response*),
                            const Request& request) {
  constexpr std::chrono::milliseconds kPatience{300};
  Client client(settings.server, kPatience);
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + kPatience);
  Response response;
  if (!(client.stub().*method)(&context, request, &response).ok()) return std::nullopt;
  return response;
}

Candidates Jobs(const Settings& settings, const Line&) {
  v1::ListJobsRequest request;
  request.set_page_size(100);
  Candidates jobs;
  const auto answer = Ask(settings, &Client::Stub::ListJobs, request);
  if (!answer) return jobs;
  for (const v1::Job& job : answer->jobs()) {
    jobs.push_back(
        {job.name().substr(job.name().find('/') + 1),
         fmt::format("{} {}", v1::Job::State_Name(job.state()), job.scenario().title())});
  }
  return jobs;
}

Candidates Channels(const Settings& settings, const Line& line) {
  Candidates channels;
  if (line.positionals.empty()) return channels;
  v1::GetSeriesRequest request;
  request.set_name(JobName(line.positionals.front()));
  const auto answer = Ask(settings, &Client::Stub::GetSeries, request);
  if (!answer) return channels;
  for (const auto& column : answer->columns()) {
    if (column.name() != "time") channels.push_back({column.name(), column.unit()});
  }
  return channels;
}

std::optional<v1::Job> JobOf(const Settings& settings, const Line& line) {
  if (line.positionals.empty()) return std::nullopt;
  v1::GetJobRequest request;
  request.set_name(JobName(line.positionals.front()));
  return Ask(settings, &Client::Stub::GetJob, request);
}

Candidates Artifacts(const Settings& settings, const Line& line) {
  Candidates artifacts;
  const auto job = JobOf(settings, line);
  if (!job) return artifacts;
  for (const v1::Artifact& artifact : job->artifacts()) artifacts.push_back({artifact.name(), ""});
  return artifacts;
}

Candidates Metrics(const Settings& settings, const Line& line) {
  Candidates metrics;
  const auto job = JobOf(settings, line);
  if (!job) return metrics;
  for (const std::string& metric : job->sweep().metrics()) metrics.push_back({metric, ""});
  return metrics;
}

Candidates TemplateNames(const Settings&, const Line&) {
  Candidates names;
  for (const Template& scenario : Templates()) names.push_back({std::string(scenario.name), ""});
  return names;
}

Candidates Laws(const Settings&, const Line&) {
  Candidates laws;
  for (const LawEntry& law : LawCatalogue()) {
    std::string name(law.name);
    std::ranges::transform(name, name.begin(), [](unsigned char c) {
      return c == '_' ? '-' : static_cast<char>(std::tolower(c));
    });
    laws.push_back({name, std::string(law.source)});
  }
  return laws;
}

Candidates States(const Settings&, const Line&) {
  Candidates states;
  const auto& type = *v1::Job::State_descriptor();
  for (int i = 1; i < type.value_count(); ++i) states.push_back({type.value(i)->name(), ""});
  return states;
}

Candidates EventKinds(const Settings&, const Line&) {
  Candidates kinds;
  const auto& payload = *v1::Event::descriptor()->FindOneofByName("payload");
  for (int i = 0; i < payload.field_count(); ++i) kinds.push_back({payload.field(i)->name(), ""});
  return kinds;
}

Candidates Items(const Settings&, const Line&) {
  Candidates items = {{"all", ""}};
  for (const std::string& item : PaperItems()) items.push_back({item, ""});
  return items;
}

const CLI::App& RootOf(const Line& line) {
  const CLI::App* root = line.command;
  while (root->get_parent() != nullptr) root = root->get_parent();
  return *root;
}

// What `help` takes.
Candidates Commands(const Settings&, const Line& line) {
  Candidates commands = {{"tutorial", "the way through all of them"}};
  for (const CLI::App* command : RootOf(line).get_subcommands({})) {
    commands.push_back({command->get_name(), command->get_description()});
  }
  return commands;
}

Candidates ConfigKeyNames(const Settings&, const Line& line) {
  Candidates keys;
  for (const std::string& key : ConfigKeys(RootOf(line))) keys.push_back({key, VariableOf(key)});
  return keys;
}

// Profiles are sections of files, whatever else these hold.
Candidates ProfileNames(const Settings& settings, const Line& line) {
  std::vector<std::string> keys;
  for (const Candidate& key : ConfigKeyNames(settings, line)) keys.push_back(key.text);
  Candidates profiles;
  for (const ConfigFile& file : ReadConfigFiles({keys.begin(), keys.end()})) {
    for (const auto& [name, section] : file.profiles) profiles.push_back({name, file.path});
  }
  return profiles;
}

}  // namespace

Candidates Assignments(const Line& line, const std::string& word) {
  v1::Scenario scenario;
  if (!line.positionals.empty() && std::filesystem::is_regular_file(line.positionals.front())) {
    scenario = ScenarioFile::Open(line.positionals.front()).scenario();
  }
  const std::string path = word.substr(0, word.find('='));
  Candidates assignments;
  for (const SettableField& field : SettableFields(scenario)) {
    if (path.size() == word.size()) assignments.push_back({field.path + "=", ""});
    if (path != field.path) continue;
    for (const std::string& value : field.words) assignments.push_back({path + "=" + value, ""});
  }
  return assignments;
}

std::string KindOf(const CLI::Option& option) {
  const std::string type = option.get_type_name().substr(0, option.get_type_name().find(':'));
  return option.get_positional() ? option.get_name() : type;
}

Candidates Values(const CLI::Option& option, const Settings& settings, const Line& line) {
  using Source = Candidates (*)(const Settings&, const Line&);
  static const std::map<std::string, Source> kSources = {
      {"JOB", Jobs},           {"NAME", Channels},
      {"NAME,…", Channels},    {"TEMPLATE", TemplateNames},
      {"LAW", Laws},           {"STATE", States},
      {"KIND,…", EventKinds},  {"KEY", ConfigKeyNames},
      {"ITEM", Items},         {"PROFILE", ProfileNames},
      {"ARTIFACT", Artifacts}, {"METRIC", Metrics},
      {"COMMAND", Commands}};
  const auto source = kSources.find(KindOf(option));
  return source == kSources.end() ? Allowed(option) : source->second(settings, line);
}

}  // namespace contact::cli
