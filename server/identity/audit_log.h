#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "base/executor.h"
#include "base/file_descriptor.h"
#include "identity/principal.h"

namespace contact {

/// What the audit log says of a call. Holds no secret.
struct AuditRecord {
  std::chrono::system_clock::time_point time;
  /// Identifies the call.
  std::string call;
  /// Nothing if the caller is not known.
  std::optional<Principal> caller;
  /// Where the call came from, as gRPC tells it.
  std::string peer;
  std::string method;
  /// Name of the job that it is about; may be empty.
  std::string job;
  /// Name of its status code, such as `OK`; `STARTED` for a call that is written before it begins.
  std::string code;
  /// ErrorInfo.reason; empty without error.
  std::string reason;
  std::chrono::microseconds duration{0};
};

/// Keeps the digest of the last line of an audit log apart from it.
class AuditHead {
 public:
  virtual ~AuditHead() = default;
  /// The digest that was kept last; empty: none.
  virtual std::string Read() = 0;
  /// Keeps a digest, soon: a crash may leave an earlier one. On the log's thread.
  virtual void Write(const std::string& digest) = 0;
};

/// Where an audit log is, and who can make its chain.
struct AuditPlace {
  /// Empty: there is no log.
  std::filesystem::path file = {};
  /// Holds the key of the chain, see ReadAuditKey; empty: anybody can make one.
  std::filesystem::path key_file = {};
  /// Opens the head of a log that has none in a file; null: there is none.
  std::function<std::unique_ptr<AuditHead>()> open_head = {};

  bool empty() const { return file.empty(); }
};

/// A file with a JSON object a line for each change and each refused call. Each line has the
/// digest of the line before as `prev`, so that a line that is changed, left out or put in is
/// found; see VerifyAudit. The digest of the last line also stands in a file of its own, the head,
/// which shows whether lines are missing at the end or all were made anew; see AuditPlace, too. A
/// file that has grown large becomes FILE.1, FILE.2 and so on, and the chain goes on in a new one.
/// Written on a thread of its own. Thread-safe.
class AuditLog {
 public:
  /// Opens the file, of mode 0600 if it is made, and goes on with its chain. What a crash has left
  /// of a line that was not finished is cut off. Words that say why, if it cannot. A file may have
  /// `max_bytes`, or one line if that is longer; 0: any number. `head`: the file of the head;
  /// empty: see AuditPlace::open_head. If the log has not the line of the head, the server's log
  /// says so.
  static std::variant<std::unique_ptr<AuditLog>, std::string> Open(
      const AuditPlace& place, std::int64_t max_bytes = 0, const std::filesystem::path& head = {});
  /// As above, without a key.
  static std::variant<std::unique_ptr<AuditLog>, std::string> Open(
      const std::filesystem::path& file, std::int64_t max_bytes = 0,
      const std::filesystem::path& head = {}) {
    return Open(AuditPlace{.file = file}, max_bytes, head);
  }

  /// Writes the record, some time later. Of the failed calls of one principal, and of all callers
  /// that are not known, at most 100 a second are written; the next record says as `suppressed` how
  /// many are left out. A record that cannot be written counts in the next one as `lost`.
  void Write(AuditRecord record);
  /// Writes the record and synchronises the disk, then calls `done` on the log's thread. False: it
  /// could not be written.
  void WriteDurably(AuditRecord record, const std::function<void(bool)>& done);
  /// Waits until what was given before is written.
  void Flush();

 private:
  AuditLog(std::filesystem::path path, std::string key, std::int64_t max_bytes, FileDescriptor file,
           std::unique_ptr<AuditHead> head, std::string previous)
      : path_(std::move(path)),
        key_(std::move(key)),
        max_bytes_(max_bytes),
        file_(std::move(file)),
        head_(std::move(head)),
        previous_(std::move(previous)) {}

  /// Appends the record. On the thread.
  bool Append(const AuditRecord& record);
  /// Puts the file away and begins a new one; goes on with the old one if it cannot. On the thread.
  void Rotate();
  /// True if the record is one too many of failed calls. On the thread.
  bool IsSuppressed(const AuditRecord& record);

  // All of the thread.
  const std::filesystem::path path_;
  /// Of the chain; empty: none.
  const std::string key_;
  const std::int64_t max_bytes_;
  FileDescriptor file_;
  /// Keeps previous_; null: nobody does.
  const std::unique_ptr<AuditHead> head_;
  /// Digest of the last line.
  std::string previous_;
  /// The second of the last failed call, and how many each principal had in it.
  std::int64_t second_ = 0;
  std::map<std::string, int> of_second_;
  std::int64_t suppressed_ = 0;
  std::int64_t lost_ = 0;
  /// True while nothing can be written, so that the log says it once.
  bool failed_ = false;
  /// True while no new file can be begun.
  bool stuck_ = false;
  Executor executor_{"audit"};  // Last: its tasks use the above.
};

}  // namespace contact
