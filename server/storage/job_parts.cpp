#include "storage/job_parts.h"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>

#include "identity/principal.h"

namespace contact {
namespace {

// Maps are written in the order of their keys.
std::string Deterministic(const google::protobuf::Message& message) {
  std::string bytes;
  {
    google::protobuf::io::StringOutputStream stream(&bytes);
    google::protobuf::io::CodedOutputStream coded(&stream);
    coded.SetSerializationDeterministic(true);
    message.SerializeToCodedStream(&coded);
  }
  return bytes;
}

v1::Job SpecOf(const v1::Job& job) {
  v1::Job spec;
  if (job.has_scenario()) *spec.mutable_scenario() = job.scenario();
  if (job.has_sweep()) *spec.mutable_sweep() = job.sweep();
  *spec.mutable_labels() = job.labels();
  spec.set_priority(job.priority());
  if (job.has_budget()) *spec.mutable_budget() = job.budget();
  if (job.has_time_to_live()) *spec.mutable_time_to_live() = job.time_to_live();
  return spec;
}

v1::Job ResultOf(const v1::Job& job) {
  v1::Job result;
  *result.mutable_cycles() = job.cycles();
  *result.mutable_groups() = job.groups();
  *result.mutable_final_bodies() = job.final_bodies();
  return result;
}

v1::Job HeaderOf(const v1::Job& job) {
  v1::Job header = job;
  header.clear_spec();
  header.clear_cycles();
  header.clear_groups();
  header.clear_final_bodies();
  header.clear_note();
  return header;
}

}  // namespace

JobParts Split(const v1::Job& job) {
  return {Deterministic(HeaderOf(job)), Deterministic(SpecOf(job)), Deterministic(ResultOf(job)),
          job.end_time().seconds()};
}

const std::string& TitleOf(const v1::Job& job) {
  return job.has_sweep() ? job.sweep().base().title() : job.scenario().title();
}

const std::string& OwnerOf(const v1::Job& job) {
  static const std::string kEverybody = kLocal;
  return job.owner().empty() ? kEverybody : job.owner();
}

const std::string& TenantOf(const v1::Job& job) {
  static const std::string kEverybody = kLocal;
  return job.tenant().empty() ? kEverybody : job.tenant();
}

std::vector<EventRow> ToRows(absl::Span<const v1::Event> events) {
  std::vector<EventRow> rows;
  rows.reserve(events.size());
  for (const v1::Event& event : events) {
    rows.push_back({static_cast<int>(event.payload_case()), EncodeEvent(event)});
  }
  return rows;
}

}  // namespace contact
