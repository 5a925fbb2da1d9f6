#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace contact {

/// What a line says of the one before, and the head of the last: SHA-256, or HMAC-SHA-256 if there
/// is a key.
std::string LineDigest(const std::string& line, const std::string& key);
/// Reads the key of an audit log from a file that only its owner and group may read, without the
/// white space around it. False, with the reason in `mistake`: it cannot be read, or the key has
/// fewer than 32 characters.
bool ReadAuditKey(const std::filesystem::path& file, std::string* key, std::string* mistake);

/// What stands for the line before the first of all.
std::string FirstPrevious();

/// One file of an audit log.
struct AuditFile {
  std::filesystem::path path;
  /// Counts the files from 1; 0: the one that is written to.
  int number = 0;
};
/// The files of the audit log `file` in their order: FILE.1, FILE.2, …, FILE, as far as they are
/// there.
std::vector<AuditFile> AuditFiles(const std::filesystem::path& file);

/// The end of the last whole line of a file, and that line without its end.
struct LastLine {
  std::int64_t end = 0;
  std::string text;
};
LastLine FindLastLine(const std::filesystem::path& file);
/// Digest of the last line in the files, which may be none.
std::string LastDigest(const std::vector<AuditFile>& files, const std::string& key = "");

/// The digest in the head of an audit log; empty if there is none.
std::string ReadHead(const std::filesystem::path& head);

/// What VerifyAudit finds.
struct AuditFindings {
  std::int64_t files = 0;
  std::int64_t lines = 0;
  /// Files that came before the first one that is there: somebody has put them elsewhere.
  int missing = 0;
  /// Digest of the last line, to be kept elsewhere: it shows whether lines are missing at the end.
  std::string last;
  /// True if a line has the digest of the head.
  bool has_head = false;
  /// The first line that does not fit, from 1, and its file; 0: all fit.
  std::int64_t bad_line = 0;
  std::filesystem::path bad_file;
  /// What is wrong with it.
  std::string mistake;
};

/// Follows the chain of an audit log through all of its files, and looks for the line with the
/// digest `head`. `key`: that of the chain; empty: it has none. Nothing if one cannot be read, or
/// there is none.
std::optional<AuditFindings> VerifyAudit(const std::filesystem::path& file,
                                         const std::string& head = "", const std::string& key = "");

}  // namespace contact
