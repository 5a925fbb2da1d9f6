#include "wire/spec_digest.h"

#include <fmt/format.h>
#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>

#include <iterator>

#include "base/digest.h"

namespace contact {
namespace {

// Fields in order of their numbers, as every language can write them.
std::string Deterministic(const google::protobuf::Message& message) {
  std::string bytes;
  google::protobuf::io::StringOutputStream stream(&bytes);
  google::protobuf::io::CodedOutputStream out(&stream);
  out.SetSerializationDeterministic(true);
  message.SerializeToCodedStream(&out);
  out.Trim();
  return bytes;
}

}  // namespace

std::string SpecSha256(const v1::Job& job) {
  if (job.spec_case() == v1::Job::SPEC_NOT_SET) return "";
  const std::string bytes =
      job.has_sweep() ? Deterministic(job.sweep()) : Deterministic(job.scenario());
  Sha256 digest;
  digest.Add(bytes);
  std::string hex;
  for (const char byte : digest.Finish()) {
    fmt::format_to(std::back_inserter(hex), "{:02x}", static_cast<unsigned char>(byte));
  }
  return hex;
}

}  // namespace contact
