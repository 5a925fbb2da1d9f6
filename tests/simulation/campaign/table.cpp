#include "simulation/campaign/table.h"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <map>
#include <string>

namespace contact::campaign {
namespace {

using Verdict = Check::Verdict;

[[gnu::format(printf, 1, 2)]] std::string Format(const char* format, ...) {
  char text[512];
  va_list values;
  va_start(values, format);
  std::vsnprintf(text, sizeof text, format, values);
  va_end(values);
  return text;
}

struct Row {
  int runs = 0, statuses[4] = {}, broken = 0, jumps = 0, released = 0, limited = 0, cut = 0;
  int agree = 0, disagree = 0, unchecked = 0, same = 0, other = 0;
  double worst = 0, worst_other = 0;  // Of what an independent method finds; of other words.
  double steps = 0;
  std::vector<double> ms;

  void Add(const Result& r) {
    ++runs;
    ++statuses[static_cast<int>(r.status)];
    broken += !r.broken.empty();
    jumps += r.jumps > 0, released += r.released > 0, limited += r.limited > 0, cut += r.cut > 0;
    agree += r.certificate.verdict == Verdict::kAgrees;
    disagree += r.certificate.verdict == Verdict::kDisagrees;
    unchecked += r.certificate.verdict == Verdict::kNotChecked;
    worst = std::max(worst, r.certificate.worst);
    same += r.metamorphic.verdict == Verdict::kAgrees;
    other += r.metamorphic.verdict == Verdict::kDisagrees;
    worst_other = std::max(worst_other, r.metamorphic.worst);
    steps += static_cast<double>(r.steps);
    ms.push_back(r.ms);
  }

  std::string Text(const std::string& kind) {
    std::ranges::sort(ms);
    std::string text =
        Format("%-10s %5d %5d %7d %6d %6d %6d %5d %8d %7d %4d %9.3f %9.1f %9.1f", kind.c_str(),
               runs, statuses[0], statuses[1], statuses[2], statuses[3], broken, jumps, released,
               limited, cut, ms[ms.size() / 2], ms.back(), steps / 1e6);
    if (agree + disagree + unchecked > 0) {
      text += Format("  certified %d, disagree %d, not checked %d, worst %.1e", agree, disagree,
                     unchecked, worst);
    }
    if (same + other > 0) {
      text += Format("  other words: same %d, not %d, worst %.1e", same, other, worst_other);
    }
    return text;
  }
};

constexpr char kHead[] =
    "KIND        RUNS  FULL PARTIAL BUDGET FAILED BROKEN JUMPS RELEASED LIMITED  CUT MEDIAN ms "
    "LONGEST ms STEPS 1e6\n";

double Change(const Result& before, const Result& after) {
  return (static_cast<double>(after.steps) + 1000) / (static_cast<double>(before.steps) + 1000);
}

// −1: worse, +1: better, 0: alike.
int Judge(const Result& before, const Result& after) {
  if (before.status != after.status) return before.status < after.status ? -1 : 1;
  if (before.broken.size() != after.broken.size()) {
    return before.broken.size() < after.broken.size() ? -1 : 1;
  }
  if (before.certificate.verdict == Verdict::kAgrees &&
      after.certificate.verdict == Verdict::kDisagrees) {
    return -1;
  }
  return Change(before, after) > 2 ? -1 : Change(before, after) < 0.5 ? 1 : 0;
}

std::string Ended(const Result& r) {
  std::string text = NameOf(r.status);
  for (const std::string& promise : r.broken) text += ", " + promise;
  return text;
}

}  // namespace

void WriteTable(const std::vector<Result>& results, std::ostream& out) {
  std::vector<std::string> order;
  std::map<std::string, Row> rows;
  Row all;
  for (const Result& r : results) {
    if (!rows.contains(r.kind)) order.push_back(r.kind);
    rows[r.kind].Add(r);
    all.Add(r);
  }
  if (results.empty()) return;
  out << kHead;
  for (const std::string& kind : order) out << rows[kind].Text(kind) << '\n';
  out << all.Text("all") << '\n';
}

void WriteAgainst(const std::vector<Result>& earlier, const std::vector<Result>& results,
                  std::ostream& out) {
  std::map<std::pair<std::string, unsigned>, const Result*> before;
  for (const Result& r : earlier) before[{r.kind, r.seed}] = &r;
  std::map<std::string, std::map<int, int>> counts;
  std::string changes[2];
  for (const Result& r : results) {
    const auto found = before.find({r.kind, r.seed});
    if (found == before.end()) continue;
    const int judged = Judge(*found->second, r);
    ++counts[r.kind][judged];
    if (judged == 0) continue;
    changes[judged > 0] +=
        Format("%s %s %u: ", judged > 0 ? "better" : "WORSE", r.kind.c_str(), r.seed) +
        Ended(*found->second) + " -> " + Ended(r) +
        Format("; steps %.0f -> %.0f\n", static_cast<double>(found->second->steps),
               static_cast<double>(r.steps));
  }
  out << changes[1] << changes[0] << "KIND        BETTER ALIKE WORSE\n";
  for (auto& [kind, count] : counts) {
    out << Format("%-10s %7d %5d %5d\n", kind.c_str(), count[1], count[0], count[-1]);
  }
}

}  // namespace contact::campaign
