#pragma once

#include <google/protobuf/message.h>

#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "contact/v1/scenario.pb.h"
#include "wire/rules/field_path.h"
#include "wire/scenario/scenario_codec.h"

namespace contact {

/// A copy of the base of a sweep, and the fields in it that the axes set. For use by one thread.
class SweepFields {
 public:
  /// Finds the fields. Notes the axes whose field does not exist, is no number, or has another
  /// axis.
  SweepFields(const v1::Sweep& sweep, std::vector<Violation>* violations);

  /// The base with one value for each axis. Rounds the values of whole numbers, also in `values`.
  /// The result is valid until the next call.
  const v1::Scenario& Set(std::span<double> values);

  /// True if an axis sets the field at this path.
  bool Sets(const std::string& path) const { return paths_.contains(path); }

 private:
  using Message = google::protobuf::Message;
  // Notes what is wrong with the path that is read, and what to do about it.
  using Break = std::function<void(std::string description, std::string hint)>;
  // A field to set.
  struct Target {
    Message* message;
    const google::protobuf::FieldDescriptor* field;
  };

  // Reads a path and adds its fields to the axis read last.
  void Read(const std::string& path, const Break& fail);
  // Follows the rest of a path from `message` on and adds the fields at its end. `walked` is the
  // path up to there.
  void Find(std::span<const PathStep> path, const std::string& walked, Message* message,
            const Break& fail);
  // Find for a step with an index or a name: goes on in that entry, or in every one.
  void FindEntries(std::span<const PathStep> path, const std::string& here,
                   const google::protobuf::FieldDescriptor& field, Message* message,
                   const Break& fail);
  // Adds a field to the axis read last, if the field is a number without an axis.
  void AddTarget(const std::string& here, const google::protobuf::FieldDescriptor& field,
                 Message* message, const Break& fail);

  // On the heap, since targets_ point into it.
  std::unique_ptr<v1::Scenario> scenario_;
  // The fields of each axis.
  std::vector<std::vector<Target>> targets_;
  // The paths of all fields in targets_.
  std::set<std::string> paths_;
};

}  // namespace contact
