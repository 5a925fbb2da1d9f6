#pragma once

#include <google/protobuf/message.h>

#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "contact/v1/scenario.pb.h"
#include "wire/field_path.h"
#include "wire/rules.h"
#include "wire/scenario_codec.h"

namespace contact {

/// A scenario of its own, and the fields in it that the axes of a sweep set.
class SweepFields {
 public:
  /// Notes the axes whose field cannot be set.
  SweepFields(const v1::Sweep& sweep, std::vector<Violation>* violations);

  /// The base with one value for each axis. Where a field is a whole number, `values` becomes what
  /// it was rounded to. Good until the next call.
  const v1::Scenario& Set(std::span<double> values);

  /// True if an axis sets the field at this path.
  bool Sets(const std::string& path) const { return paths_.contains(path); }

 private:
  using Message = google::protobuf::Message;
  struct Target {
    Message* message;
    const google::protobuf::FieldDescriptor* field;
  };

  void Find(std::span<const PathStep> path, const std::string& walked, Message* message,
            const Rules& rules);
  void FindEntries(std::span<const PathStep> path, const std::string& here,
                   const google::protobuf::FieldDescriptor& field, Message* message,
                   const Rules& rules);
  void AddTarget(const std::string& here, const google::protobuf::FieldDescriptor& field,
                 Message* message, const Rules& rules);

  std::unique_ptr<v1::Scenario> scenario_;    // Stays where it is: targets_ point into it.
  std::vector<std::vector<Target>> targets_;  ///< Of each axis.
  std::set<std::string> paths_;
};

}  // namespace contact
