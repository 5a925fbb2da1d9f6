#include "cli/link/backup_file.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>

#include "base/digest.h"
#include "cli/base/failure.h"
#include "contact/v1/admin_service.grpc.pb.h"

namespace contact::cli {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void FailLocally(const std::string& path) {
  throw Failure(ExitCode::kLocal,
                fmt::format("{}: {}", path, std::generic_category().message(errno)));
}

[[noreturn]] void FailDamaged(const std::string& what) {
  throw Failure(ExitCode::kRunFailed, fmt::format("the backup is damaged: {}", what));
}

/// A file that takes the place of another once it is complete; before that it leaves no trace.
class Replacement {
 public:
  explicit Replacement(std::string path)
      : path_(std::move(path)), draft_(path_ + ".new"), file_(std::fopen(draft_.c_str(), "wb")) {
    if (file_ == nullptr) FailLocally(draft_);
  }
  ~Replacement() {
    if (file_ != nullptr) std::fclose(file_);
    std::error_code missing;
    fs::remove(draft_, missing);
  }
  Replacement(const Replacement&) = delete;
  Replacement& operator=(const Replacement&) = delete;

  const std::string& draft() const { return draft_; }

  void Write(const std::string& bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) FailLocally(draft_);
  }

  // Puts all of it on disk.
  void Close() {
    const bool written = std::fflush(file_) == 0 && ::fsync(::fileno(file_)) == 0;
    if (std::fclose(std::exchange(file_, nullptr)) != 0 || !written) FailLocally(draft_);
  }

  void Rename() {
    if (std::rename(draft_.c_str(), path_.c_str()) != 0) FailLocally(path_);
    const fs::path folder = fs::absolute(path_).parent_path();
    const int fd = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const bool synced = fd >= 0 && ::fsync(fd) == 0;
    if (fd >= 0) ::close(fd);
    if (!synced) FailLocally(folder);
  }

 private:
  const std::string path_;
  const std::string draft_;
  std::FILE* file_;
};

/// Checks the chunks as they come.
class Receiver {
 public:
  void Take(const v1::BackupChunk& chunk) {
    if (complete_ || chunk.offset() != bytes_) FailDamaged("its chunks do not fit together");
    if (chunk.crc32c() != Crc32c(chunk.data())) FailDamaged("a chunk fails its checksum");
    digest_.Add(chunk.data());
    bytes_ += static_cast<std::int64_t>(chunk.data().size());
    if (chunk.sha256().empty()) return;
    complete_ = true;
    if (chunk.total_bytes() != bytes_ || chunk.sha256() != digest_.Finish()) {
      FailDamaged("the file fails its checksum");
    }
  }

  std::int64_t Complete() const {
    if (!complete_) FailDamaged("it ends too early");
    return bytes_;
  }

 private:
  Sha256 digest_;
  std::int64_t bytes_ = 0;
  bool complete_ = false;
};

// The pages of the database, as they are in the file.
void CheckDatabase(const std::string& file) {
  try {
    std::string escaped;
    for (const char c : fs::absolute(file).string()) {
      escaped += c == '%' || c == '?' || c == '#' ? fmt::format("%{:02x}", c) : std::string(1, c);
    }
    SQLite::Database database(fmt::format("file:{}?immutable=1", escaped),
                              SQLite::OPEN_READONLY | SQLite::OPEN_URI);
    const std::string verdict = database.execAndGet("PRAGMA quick_check(1)").getString();
    if (verdict != "ok") FailDamaged(verdict);
  } catch (const SQLite::Exception& error) {
    FailDamaged(error.what());
  }
}

}  // namespace

std::int64_t ReceiveBackup(Client& client, const std::string& path,
                           std::optional<std::chrono::steady_clock::time_point> deadline) {
  Replacement file(path);
  Receiver receiver;
  grpc::ClientContext context;
  if (deadline) {
    context.set_deadline(std::chrono::system_clock::now() +
                         (*deadline - std::chrono::steady_clock::now()));
  }
  const auto stub = v1::AdminService::NewStub(client.channel());
  const auto stream = stub->Backup(&context, v1::BackupRequest());
  for (v1::BackupChunk chunk; stream->Read(&chunk);) {
    receiver.Take(chunk);
    file.Write(chunk.data());
  }
  const grpc::Status status = stream->Finish();
  if (!status.ok()) throw CallFailure(status, client.server());
  const std::int64_t bytes = receiver.Complete();
  file.Close();
  CheckDatabase(file.draft());
  file.Rename();
  return bytes;
}

}  // namespace contact::cli
