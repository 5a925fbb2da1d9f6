#include "rpc/stream/watch_message.h"

#include <google/protobuf/io/coded_stream.h>

#include <array>
#include <cstddef>
#include <memory>
#include <utility>

#include "contact/v1/job_service.pb.h"

namespace contact {
namespace {

// Smaller payloads cost less to copy than to share.
constexpr std::size_t kLeastShared = 4096;

// Tag of a field whose value has a length, or is a varint.
constexpr std::uint8_t LengthTag(int field) { return static_cast<std::uint8_t>(field << 3 | 2); }
constexpr std::uint8_t VarintTag(int field) { return static_cast<std::uint8_t>(field << 3); }

void AppendVarint(std::uint64_t value, std::string* text) {
  std::array<std::uint8_t, 10> bytes{};
  const std::uint8_t* const end =
      google::protobuf::io::CodedOutputStream::WriteVarint64ToArray(value, bytes.data());
  text->append(bytes.begin(), bytes.begin() + (end - bytes.data()));
}

using Bytes = std::shared_ptr<const std::string>;

grpc::Slice Share(const Bytes& bytes) {
  // gRPC asks for a pointer that it may change, and does not.
  return {const_cast<char*>(bytes->data()), bytes->size(),
          [](void* holder) { delete static_cast<Bytes*>(holder); }, new Bytes(bytes)};
}

}  // namespace

void WatchMessage::SetSnapshot(const v1::Job& job) {
  text_ += static_cast<char>(LengthTag(v1::WatchJobResponse::kSnapshotFieldNumber));
  AppendVarint(job.ByteSizeLong(), &text_);
  job.AppendToString(&text_);
}

void WatchMessage::Add(const LogRecord& record) {
  std::string sequence;
  if (record.sequence > 0) {
    sequence += static_cast<char>(VarintTag(v1::Event::kSequenceFieldNumber));
    AppendVarint(record.sequence, &sequence);
  }
  text_ += static_cast<char>(LengthTag(v1::WatchJobResponse::kEventsFieldNumber));
  AppendVarint(sequence.size() + record.event->size(), &text_);
  text_ += sequence;
  if (record.event->size() < kLeastShared) {
    text_ += *record.event;
  } else {
    Flush();
    slices_.push_back(Share(record.event));
  }
}

grpc::ByteBuffer WatchMessage::Take() {
  Flush();
  const std::vector<grpc::Slice> slices = std::exchange(slices_, {});
  return {slices.data(), slices.size()};
}

void WatchMessage::Flush() {
  if (!text_.empty()) slices_.emplace_back(text_);
  text_.clear();
}

}  // namespace contact
