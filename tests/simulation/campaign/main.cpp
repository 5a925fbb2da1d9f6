// Runs seeded random scenarios and tells of each, in a line of JSON, how it ended: for campaigns of
// thousands, which take minutes. A table by kind follows. What breaks a promise of the contract
// stands under `broken`, and makes the exit code 1.
//   simulation_campaign                        500 of each of the six small kinds
//   simulation_campaign 0 500 0 6 2            the same under ENCOUNTER
//   simulation_campaign 0 120 valve placed     of these kinds
//   simulation_campaign 0 120 machines         of all machines
//   simulation_campaign --against <(xz -dc tests/reference/campaign/auto.jsonl.xz)
//                                              what got better and worse since those lines
#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "simulation/campaign/contract_json.h"
#include "simulation/campaign/result.h"
#include "simulation/campaign/table.h"
#include "simulation/kinds/catalogue.h"

namespace contact::campaign {
namespace {

struct Arguments {
  unsigned first = 0, last = 500;
  std::vector<std::string> kinds;
  std::string against, read;
  bool show = false, list = false, quiet = false;
  Options options;
};

std::vector<int> Range(int first, int last) {
  std::vector<int> numbers;
  for (int i = first; i < last; ++i) numbers.push_back(i);
  return numbers;
}

bool IsNumber(const std::string& text) {
  return !text.empty() && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

// `0 6 2` are kinds 0 to 5 and the scope 2; else names, of which `small`, `machines` and `all` are
// several.
std::vector<int> KindsOf(const std::vector<std::string>& words, Options& options) {
  if (words.empty()) return Range(0, testing::kSmallKinds);
  if (IsNumber(words[0])) {
    const auto number = [&](std::size_t i, int otherwise) {
      return i < words.size() ? std::stoi(words[i]) : otherwise;
    };
    if (words.size() > 2) options.scope = static_cast<RestitutionScope>(number(2, 0));
    return Range(number(0, 0), std::min(number(1, testing::kSmallKinds), testing::KindCount()));
  }
  std::vector<int> kinds;
  for (const std::string& word : words) {
    const int most = testing::KindCount();
    const auto add = [&](int from, int to) {
      for (const int i : Range(from, to)) kinds.push_back(i);
    };
    const std::size_t before = kinds.size();
    if (word == "small") add(0, testing::kSmallKinds);
    if (word == "many") add(testing::kSmallKinds, testing::kKinds);
    if (word == "machines") add(testing::kKinds, most);
    if (word == "all") add(0, most);
    for (int i = 0; i < most; ++i) {
      if (testing::NameOfKind(i) == word) add(i, i + 1);
    }
    if (kinds.size() == before) throw CLI::ValidationError(word, "is no kind; see --list");
  }
  return kinds;
}

void Declare(CLI::App& app, Arguments& a) {
  app.add_option("first", a.first, "First seed");
  app.add_option("last", a.last, "The seed after the last");
  app.add_option("kinds", a.kinds,
                 "Names of kinds, small, many, machines or all; or two numbers and a scope");
  app.add_option("--scope", a.options.scope, "0 AUTO, 1 CYCLE, 2 ENCOUNTER");
  app.add_option("--max-steps", a.options.max_steps, "Steps after which a run ends");
  app.add_flag("--certify", a.options.certify, "Integrate each run again by an independent method");
  app.add_flag("--metamorphic", a.options.metamorphic, "Run each scenario again in other words");
  app.add_option("--against", a.against, "Compare with the lines of an earlier campaign");
  app.add_option("--read", a.read, "Take the lines of this file instead of running");
  app.add_flag("--quiet", a.quiet, "Print only lines that break a promise or are not FULL");
  app.add_flag("--show", a.show, "Print the scenarios for contactctl instead of running them");
  app.add_flag("--list", a.list, "Print the kinds");
}

// Lines that are no JSON, such as a table, are left out.
std::vector<Result> Read(const std::string& path) {
  std::vector<Result> results;
  std::ifstream in(path);
  if (!in) throw CLI::FileError::Missing(path);
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with('{')) results.push_back(FromJson(line));
  }
  return results;
}

bool IsNews(const Result& r) {
  return r.status != Result::Status::kFull || !r.broken.empty() ||
         r.certificate.verdict == Check::Verdict::kDisagrees ||
         r.metamorphic.verdict == Check::Verdict::kDisagrees;
}

std::vector<Result> RunAll(const Arguments& a, const std::vector<int>& kinds) {
  std::vector<Result> results;
  for (const int kind : kinds) {
    for (unsigned seed = a.first; seed < a.last; ++seed) {
      results.push_back(RunOne(kind, seed, a.options));
      const Result& r = results.back();
      if (!a.quiet || IsNews(r)) std::cout << ToJson(r) << std::endl;
    }
  }
  return results;
}

void Show(const Arguments& a, const std::vector<int>& kinds) {
  for (const int kind : kinds) {
    for (unsigned seed = a.first; seed < a.last; ++seed) {
      const std::string title = std::string(testing::NameOfKind(kind)) + ' ' + std::to_string(seed);
      std::cout << ContractJson(ScenarioOf(kind, seed, a.options), title) << '\n';
    }
  }
}

void List() {
  for (int i = 0; i < testing::KindCount(); ++i) {
    std::cout << i << ' ' << testing::NameOfKind(i);
    if (i >= testing::kKinds) {
      std::cout << ": " << testing::Machines()[static_cast<std::size_t>(i - testing::kKinds)].shows;
    }
    std::cout << '\n';
  }
}

int Main(Arguments& a) {
  const std::vector<int> kinds = KindsOf(a.kinds, a.options);
  if (a.list) return List(), 0;
  if (a.show) return Show(a, kinds), 0;
  const std::vector<Result> earlier = a.against.empty() ? std::vector<Result>() : Read(a.against);
  const std::vector<Result> results = a.read.empty() ? RunAll(a, kinds) : Read(a.read);
  WriteTable(results, std::cout);
  if (!a.against.empty()) WriteAgainst(earlier, results, std::cout);
  return std::ranges::any_of(results, [](const Result& r) { return !r.broken.empty(); }) ? 1 : 0;
}

}  // namespace
}  // namespace contact::campaign

int main(int argc, char** argv) {
  contact::campaign::Arguments arguments;
  CLI::App app("Runs seeded random scenarios, and tells how each ended.");
  contact::campaign::Declare(app, arguments);
  CLI11_PARSE(app, argc, argv);
  try {
    return contact::campaign::Main(arguments);
  } catch (const CLI::Error& error) {
    return app.exit(error);
  }
}
