#include "wire/scenario/channels.h"

#include <fmt/format.h>

#include <cassert>
#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "simulation/model/derived.h"

namespace contact {
namespace {

v1::FrameChunk::Column Channel(std::string_view owner, const char* quantity, const char* unit) {
  v1::FrameChunk::Column column;
  column.set_name(owner.empty() ? quantity : std::string(owner) + "." + quantity);
  column.set_quantity(quantity);
  column.set_unit(unit);
  return column;
}

// The name of its body and that of its other end, with a number where others have that, too.
std::vector<std::string> SupportNames(const Scenario& scenario) {
  std::vector<std::string> names;
  std::map<std::string, int> times;
  for (const Support& support : scenario.supports) {
    const auto name = [&](int body) {
      return body == kNone ? std::string("ground")
                           : scenario.bodies[static_cast<std::size_t>(body)].name;
    };
    std::string ends = name(support.body) + "-" + name(support.other);
    const int time = ++times[ends];
    names.push_back(time == 1 ? std::move(ends) : fmt::format("{}#{}", ends, time));
  }
  return names;
}

}  // namespace

std::vector<v1::FrameChunk::Column> Channels(const Scenario& scenario) {
  std::vector<v1::FrameChunk::Column> columns = {Channel("", "time", "s")};
  for (const Body& body : scenario.bodies) {
    columns.push_back(Channel(body.name, "position", "m"));
    columns.push_back(Channel(body.name, "velocity", "m/s"));
  }
  for (const Contact& contact : scenario.contacts) {
    columns.push_back(Channel(contact.name, "deformation", "m"));
    columns.push_back(Channel(contact.name, "deformation_velocity", "m/s"));
    columns.push_back(Channel(contact.name, "contact_force", "N"));
    columns.push_back(Channel(contact.name, "external_force", "N"));
  }
  for (const Body& body : scenario.bodies) {
    columns.push_back(Channel(body.name, "acceleration", "m/s^2"));
  }
  for (const std::string& support : SupportNames(scenario)) {
    columns.push_back(Channel(support, "support_force", "N"));
    columns.push_back(Channel(support, "support_energy", "J"));
  }
  for (const char* quantity :
       {"kinetic_energy", "contact_energy", "support_energy", "dissipated_energy", "load_work"}) {
    columns.push_back(Channel("system", quantity, "J"));
  }
  assert(std::ssize(columns) == SampleColumns(scenario));
  return columns;
}

std::size_t FirstChannels(const Scenario& scenario) {
  return 1 + 2 * scenario.bodies.size() + 4 * scenario.contacts.size();
}

}  // namespace contact
