#include "identity/audit_chain.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "identity/hex.h"
#include "identity/secret_file.h"

namespace contact {
namespace {

namespace fs = std::filesystem;

// The number in NAME.NUMBER; 0 for another name.
int NumberIn(const std::string& found, const std::string& name) {
  constexpr std::size_t kMostDigits = 9;
  if (!found.starts_with(name + '.')) return 0;
  const std::string digits = found.substr(name.size() + 1);
  const bool is_number = !digits.empty() && digits.size() <= kMostDigits && digits[0] != '0' &&
                         std::ranges::all_of(digits, [](unsigned char c) { return isdigit(c); });
  return is_number ? std::stoi(digits) : 0;
}

// What is wrong with a line after the one with this digest; empty: nothing.
std::string MistakeOf(const std::string& line, bool finished, const std::string& previous) {
  const auto json = nlohmann::json::parse(line, nullptr, false);
  if (!finished) return "it is not finished";
  if (!json.is_object()) return "it is no JSON object";
  if (previous.empty() || json.value("prev", nlohmann::json()) == previous) return "";
  return "the line before is not the one that it was written after";
}

// Follows one file. False: it cannot be read, or a line does not fit.
bool Follow(const AuditFile& file, const std::string& head, const std::string& key,
            AuditFindings* findings) {
  std::ifstream in(file.path, std::ios::binary);
  std::int64_t number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    ++findings->lines;
    findings->mistake = MistakeOf(line, !in.eof(), findings->last);
    findings->last = LineDigest(line, key);
    findings->has_head |= findings->last == head;
    if (findings->mistake.empty()) continue;
    findings->bad_line = number;
    findings->bad_file = file.path;
    return false;
  }
  return in.eof();
}

}  // namespace

std::string LineDigest(const std::string& line, const std::string& key) {
  return key.empty() ? Sha256Hex(line) : HmacHex(key, line);
}

bool ReadAuditKey(const fs::path& file, std::string* key, std::string* mistake) {
  constexpr std::size_t kFewest = 32;
  if (!ReadSecretFile(file, key, mistake)) return false;
  constexpr char kWhite[] = " \t\r\n";
  key->erase(0, key->find_first_not_of(kWhite));
  key->erase(key->find_last_not_of(kWhite) + 1);
  if (key->size() >= kFewest) return true;
  *mistake = file.string() + " has a key of fewer than 32 characters";
  return false;
}

std::string FirstPrevious() { return std::string(64, '0'); }

std::vector<AuditFile> AuditFiles(const fs::path& file) {
  std::vector<AuditFile> files;
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const int number = NumberIn(entry.path().filename().string(), file.filename().string());
    if (number > 0) files.push_back({entry.path(), number});
  }
  std::ranges::sort(files, {}, &AuditFile::number);
  if (fs::exists(file, error)) files.push_back({file, 0});
  return files;
}

LastLine FindLastLine(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  LastLine last;
  for (std::string line; std::getline(in, line) && !in.eof();) {
    last = {static_cast<std::int64_t>(in.tellg()), line};
  }
  return last;
}

std::string LastDigest(const std::vector<AuditFile>& files, const std::string& key) {
  for (auto file = files.rbegin(); file != files.rend(); ++file) {
    const LastLine last = FindLastLine(file->path);
    if (last.end > 0) return LineDigest(last.text, key);
  }
  return FirstPrevious();
}

std::string ReadHead(const fs::path& head) {
  std::string digest;
  std::ifstream(head) >> digest;
  return digest;
}

std::optional<AuditFindings> VerifyAudit(const fs::path& file, const std::string& head,
                                         const std::string& key) {
  const std::vector<AuditFile> files = AuditFiles(file);
  if (files.empty()) return std::nullopt;
  AuditFindings findings;
  findings.missing = std::max(0, files.front().number - 1);
  if (findings.missing == 0) findings.last = FirstPrevious();
  for (const AuditFile& next : files) {
    ++findings.files;
    if (Follow(next, head, key, &findings)) continue;
    if (findings.bad_line > 0) return findings;
    return std::nullopt;
  }
  return findings;
}

}  // namespace contact
