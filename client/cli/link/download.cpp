#include "cli/link/download.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <fstream>
#include <system_error>

#include "base/digest.h"
#include "base/replace_file.h"
#include "cli/link/stream_call.h"

namespace contact::cli {
namespace {

[[noreturn]] void FailLocally(const std::string& path) {
  throw Failure(ExitCode::kLocal,
                fmt::format("{}: {}", path, std::generic_category().message(errno)));
}

// The part that is here already, and what is added to it.
class PartFile {
 public:
  explicit PartFile(std::string path) : path_(std::move(path)) {
    std::ifstream left(path_, std::ios::binary);
    std::array<char, 1 << 16> block{};
    while (left.read(block.data(), block.size()), left.gcount() > 0) {
      Count({block.data(), static_cast<std::size_t>(left.gcount())});
    }
    file_.open(path_, std::ios::binary | std::ios::app);
    if (!file_) FailLocally(path_);
  }

  ~PartFile() {
    if (size_ == 0) std::remove(path_.c_str());  // Nothing came.
  }
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  std::int64_t size() const { return size_; }

  void Append(const std::string& data) {
    if (!file_.write(data.data(), static_cast<std::streamsize>(data.size()))) FailLocally(path_);
    Count(data);
  }

  // Gives it its name if it is what the server has, else throws it away.
  void Finish(const v1::Artifact& artifact, const std::string& path) {
    file_.close();
    if (!file_) FailLocally(path_);
    if (size_ != artifact.size_bytes() || artifact.sha256() != digest_.Finish()) {
      std::remove(path_.c_str());
      throw Failure(ExitCode::kRunFailed,
                    fmt::format("{} is not what the server has; it was removed, try again", path_));
    }
    const std::error_code error = MoveIntoPlace(path_, path);
    if (error) throw Failure(ExitCode::kLocal, fmt::format("{}: {}", path, error.message()));
  }

 private:
  void Count(std::string_view data) {
    digest_.Add(data);
    size_ += static_cast<std::int64_t>(data.size());
  }

  const std::string path_;
  Sha256 digest_;
  std::int64_t size_ = 0;
  std::ofstream file_;
};

using Call = StreamCall<v1::ReadArtifactResponse>;

void RequireTime(const DownloadOptions& options) {
  if (options.stopped()) throw Failure(ExitCode::kInterrupted, "interrupted; the part is kept");
  if (options.deadline && std::chrono::steady_clock::now() >= *options.deadline) {
    throw Failure(ExitCode::kTimeout, "time is up; the part is kept");
  }
}

// Adds what comes to the part. The artifact, if all came.
std::optional<v1::Artifact> ReadOn(Call& call, const DownloadOptions& options,
                                   Reconnection& reconnection, PartFile& part) {
  for (v1::ReadArtifactResponse message;;) {
    RequireTime(options);
    const Call::Next next = call.Read(kStreamTick, &message);
    if (next == Call::Next::kEnd) return std::nullopt;
    if (next == Call::Next::kNothing) continue;
    if (message.offset() != part.size() || message.crc32c() != Crc32c(message.data())) {
      return std::nullopt;  // Damaged on its way: asked for again.
    }
    if (reconnection.Heard()) options.regained();
    part.Append(message.data());
    if (message.has_artifact()) return message.artifact();
  }
}

}  // namespace

v1::Artifact Download(Client& client, const DownloadOptions& options) {
  PartFile part(options.path + ".part");
  Reconnection reconnection(client.server(), options.patience);
  v1::ReadArtifactRequest request;
  request.set_name(options.job);
  request.set_artifact(options.artifact);
  for (;;) {
    request.set_offset(part.size());
    Call call([&](auto* context, auto* queue, void* tag) {
      return client.stub().AsyncReadArtifact(context, request, queue, tag);
    });
    if (const auto artifact = ReadOn(call, options, reconnection, part)) {
      part.Finish(*artifact, options.path);
      return *artifact;
    }
    if (call.status().error_code() == grpc::StatusCode::OUT_OF_RANGE) {
      part.Finish({}, options.path);  // Longer than the artifact: none of it.
    }
    const bool told = reconnection.lost();
    const auto pause = reconnection.Lost(call.status());
    if (!told) options.lost(WhyLost(call.status()));
    Rest(*client.channel(), pause, [&options] {
      RequireTime(options);
      return true;
    });
  }
}

}  // namespace contact::cli
