#include "storage/postgres/notes.h"

#include <absl/strings/escaping.h>
#include <absl/strings/numbers.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/str_split.h>

#include <algorithm>
#include <optional>

namespace contact::postgres {
namespace {

// A line: kind, name, tenant, last sequence, state, progress; what clients may choose in base64.
std::string LineOf(const Note& note) {
  return absl::StrCat(static_cast<int>(note.kind), " ", note.name, " ",
                      absl::Base64Escape(note.tenant), " ", note.last_sequence, " ", note.state,
                      " ", absl::Base64Escape(note.progress), "\n");
}

std::optional<Note> NoteOf(const std::string& line) {
  const std::vector<std::string> words = absl::StrSplit(line, ' ');
  Note note;
  int kind = 0;
  if (words.size() != 6 || !absl::SimpleAtoi(words[0], &kind) || kind < 1 || kind > 4 ||
      !absl::Base64Unescape(words[2], &note.tenant) ||
      !absl::SimpleAtoi(words[3], &note.last_sequence) ||
      !absl::SimpleAtoi(words[4], &note.state) || !absl::Base64Unescape(words[5], &note.progress)) {
    return std::nullopt;
  }
  note.kind = static_cast<Note::Kind>(kind);
  note.name = words[1];
  return note;
}

}  // namespace

void WaitingNotes::Add(const Note& note) {
  const auto [place, is_new] = notes_.try_emplace({note.kind, note.name}, note);
  if (is_new) return;
  Note& known = place->second;
  const std::uint64_t last = std::max(known.last_sequence, note.last_sequence);
  const int state = note.state != 0 ? note.state : known.state;
  known = note;
  known.last_sequence = last;
  known.state = state;
}

std::vector<std::string> WaitingNotes::Take() {
  std::vector<std::string> texts;
  for (const auto& [key, note] : notes_) {
    const std::string line = LineOf(note);
    if (line.size() > kMostBytes) continue;  // Of progress only, which comes again.
    if (texts.empty() || texts.back().size() + line.size() > kMostBytes) texts.emplace_back();
    texts.back() += line;
  }
  notes_.clear();
  return texts;
}

std::vector<Note> NotesOf(const std::string& text) {
  std::vector<Note> notes;
  const std::vector<std::string> lines = absl::StrSplit(text, '\n', absl::SkipEmpty());
  for (const std::string& line : lines) {
    if (auto note = NoteOf(line)) notes.push_back(*std::move(note));
  }
  return notes;
}

}  // namespace contact::postgres
