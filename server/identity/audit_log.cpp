#include "identity/audit_log.h"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <future>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>
#include <vector>

#include "base/replace_file.h"
#include "identity/audit_chain.h"
#include "identity/hex.h"
#include "identity/token_table.h"

namespace contact {
namespace {

// Of calls that failed: they change nothing, and cost the caller nothing.
constexpr int kFailedPerSecond = 100;

std::string LineOf(const AuditRecord& record, const std::string& previous, std::int64_t suppressed,
                   std::int64_t lost) {
  using std::chrono::milliseconds;
  const auto ms = std::chrono::duration_cast<milliseconds>(record.time.time_since_epoch());
  std::string time = FormatUtc(record.time);
  time.insert(time.size() - 1, fmt::format(".{:03}", ms.count() % 1000));
  nlohmann::ordered_json json = {{"time", time}, {"call", record.call}};
  if (record.caller) {
    json["principal"] = record.caller->name;
    json["tenant"] = record.caller->tenant;
    json["how"] = record.caller->how;
    if (!record.caller->token_id.empty()) json["token"] = record.caller->token_id;
  }
  json["peer"] = record.peer;
  json["method"] = record.method;
  if (!record.job.empty()) json["job"] = record.job;
  json["code"] = record.code;
  if (!record.reason.empty()) json["reason"] = record.reason;
  json["duration_us"] = record.duration.count();
  if (suppressed > 0) json["suppressed"] = suppressed;
  if (lost > 0) json["lost"] = lost;
  json["prev"] = previous;
  // Names of jobs are whatever the caller has sent.
  return json.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace);
}

bool WriteAll(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

std::string Problem(const std::filesystem::path& file) {
  return fmt::format("cannot write {}: {}", file.string(), std::generic_category().message(errno));
}

FileDescriptor OpenFile(const std::filesystem::path& file, int flags) {
  constexpr mode_t kOwnerOnly = 0600;
  return FileDescriptor(
      ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | flags, kOwnerOnly));
}

class HeadFile : public AuditHead {
 public:
  explicit HeadFile(std::filesystem::path path)
      : path_(std::move(path)), file_(OpenFile(path_, 0)) {}

  bool valid() const { return file_.valid(); }
  std::string Read() override { return ReadHead(path_); }
  void Write(const std::string& digest) override {
    // Of one size, and in place: a crash leaves this one or the one before.
    if (::pwrite(file_.get(), digest.data(), digest.size(), 0) >= 0) return;
    spdlog::error("the head of the audit log cannot be written: {}",
                  std::generic_category().message(errno));
  }

 private:
  const std::filesystem::path path_;
  const FileDescriptor file_;
};

// Says in the server's log if the audit log is not the one that the head is of.
void CompareHead(AuditHead& head, const std::filesystem::path& file, const std::string& key) {
  const std::string last = head.Read();
  if (last.empty()) return;
  const auto found = VerifyAudit(file, last, key);
  if (found && found->has_head) return;
  spdlog::error(
      "{} does not have the line that was its last: lines are cut off or made anew, or the key is "
      "another",
      file.string());
}

}  // namespace

std::variant<std::unique_ptr<AuditLog>, std::string> AuditLog::Open(
    const AuditPlace& place, std::int64_t max_bytes, const std::filesystem::path& head) {
  const std::filesystem::path& file = place.file;
  std::string key, mistake;
  if (!place.key_file.empty() && !ReadAuditKey(place.key_file, &key, &mistake)) return mistake;
  FileDescriptor out = OpenFile(file, O_APPEND);
  struct stat status = {};
  if (!out.valid() || ::fstat(out.get(), &status) != 0) return Problem(file);
  if (!S_ISREG(status.st_mode)) return file.string() + " is no file";
  const LastLine last = FindLastLine(file);
  if (::lseek(out.get(), 0, SEEK_END) != last.end) {
    spdlog::warn("{}: cut off a line that was not finished", file.string());
    if (::ftruncate(out.get(), last.end) != 0) return Problem(file);
  }
  std::unique_ptr<AuditHead> kept;
  if (!head.empty()) {
    auto head_file = std::make_unique<HeadFile>(head);
    if (!head_file->valid()) return Problem(head);
    kept = std::move(head_file);
  } else if (place.open_head) {
    kept = place.open_head();
  }
  if (kept) CompareHead(*kept, file, key);
  const std::string last_digest = LastDigest(AuditFiles(file), key);
  return std::unique_ptr<AuditLog>(
      new AuditLog(file, std::move(key), max_bytes, std::move(out), std::move(kept), last_digest));
}

void AuditLog::Write(AuditRecord record) {
  executor_.Post([this, record = std::move(record)] {
    if (!IsSuppressed(record)) Append(record);
  });
}

void AuditLog::WriteDurably(AuditRecord record, const std::function<void(bool)>& done) {
  const auto write = [this, record = std::move(record), done] {
    done(Append(record) && ::fdatasync(file_.get()) == 0);
  };
  if (!executor_.Post(write)) done(false);
}

void AuditLog::Flush() {
  const auto written = std::make_shared<std::promise<void>>();
  if (executor_.Post([written] { written->set_value(); })) written->get_future().wait();
}

bool AuditLog::Append(const AuditRecord& record) {
  const std::string line = LineOf(record, previous_, suppressed_, lost_);
  ::off_t before = ::lseek(file_.get(), 0, SEEK_END);
  if (max_bytes_ > 0 && before > 0 &&
      before + static_cast<std::int64_t>(line.size()) + 1 > max_bytes_) {
    Rotate();
    before = ::lseek(file_.get(), 0, SEEK_END);
  }
  if (WriteAll(file_.get(), line + '\n')) {
    previous_ = LineDigest(line, key_);
    suppressed_ = lost_ = 0;
    failed_ = false;
    if (head_) head_->Write(previous_);
    return true;
  }
  ++lost_;
  if (!std::exchange(failed_, true)) {
    spdlog::error("the audit log cannot be written: {}", std::generic_category().message(errno));
  }
  // Half a line would break the chain.
  if (before >= 0 && ::ftruncate(file_.get(), before) != 0) return false;
  return false;
}

// After a crash between the two renames Open makes the new file.
void AuditLog::Rotate() {
  const std::vector<AuditFile> files = AuditFiles(path_);
  const int last = files.size() < 2 ? 0 : files[files.size() - 2].number;
  const std::string away = fmt::format("{}.{}", path_.string(), last + 1);
  const std::string draft = path_.string() + ".new";
  ::unlink(draft.c_str());
  FileDescriptor next = OpenFile(draft, O_APPEND | O_EXCL);
  if (next.valid() && !MoveIntoPlace(path_, away) && !MoveIntoPlace(draft, path_)) {
    file_ = std::move(next);
    stuck_ = false;
    return;
  }
  if (!std::exchange(stuck_, true)) {
    spdlog::error("{} grows past its limit, as no other can be begun", path_.string());
  }
  std::error_code error;
  if (!std::filesystem::exists(path_, error)) std::filesystem::rename(away, path_, error);
}

bool AuditLog::IsSuppressed(const AuditRecord& record) {
  if (record.reason.empty()) return false;
  const auto second =
      std::chrono::duration_cast<std::chrono::seconds>(record.time.time_since_epoch()).count();
  if (std::exchange(second_, second) != second) of_second_.clear();
  const std::string whose = record.caller ? FormatPrincipal(*record.caller) : "";
  if (++of_second_[whose] <= kFailedPerSecond) return false;
  ++suppressed_;
  return true;
}

}  // namespace contact
