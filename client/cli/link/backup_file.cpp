#include "cli/link/backup_file.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <system_error>

#include "base/digest.h"
#include "base/file_descriptor.h"
#include "base/replace_file.h"
#include "cli/base/failure.h"
#include "cli/base/files.h"
#include "contact/v1/admin_service.grpc.pb.h"

namespace contact::cli {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void FailDamaged(const std::string& what) {
  throw Failure(ExitCode::kRunFailed, fmt::format("the backup is damaged: {}", what));
}

// Makes the file anew, for its owner alone: nothing that somebody put there is followed or written.
std::string Fresh(const std::string& name) {
  ::unlink(name.c_str());
  const FileDescriptor made(::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600));
  return name;  // OutputFile tells errors.
}

/// A file beside the one that it will replace. Removed with this object unless it has replaced it.
class Draft {
 public:
  explicit Draft(const std::string& path)
      : path_(path), name_(path + ".new"), file_(Fresh(name_)) {}
  ~Draft() { std::remove(name_.c_str()); }
  Draft(const Draft&) = delete;
  Draft& operator=(const Draft&) = delete;

  const std::string& name() const { return name_; }

  void Write(const std::string& bytes) {
    std::fwrite(bytes.data(), 1, bytes.size(), file_.get());  // Close tells errors.
  }

  void Close() { file_.Close(); }

  void Replace() {
    const std::error_code error = MoveIntoPlace(name_, path_);
    if (error) throw Failure(ExitCode::kLocal, fmt::format("{}: {}", path_, error.message()));
  }

 private:
  const std::string path_;
  const std::string name_;
  OutputFile file_;
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

// Runs SQLite's check. The file is immutable for it, so that no journal is made beside it.
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
  Draft file(path);
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
  CheckDatabase(file.name());
  file.Replace();
  return bytes;
}

}  // namespace contact::cli
