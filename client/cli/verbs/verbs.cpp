#include "cli/verbs/verbs.h"

#include <algorithm>
#include <string>

namespace contact::cli {

const std::vector<Verb>& Verbs() {
  static const std::vector<Verb> kVerbs = {
#define VERB(function, name, needs_settings, about) {name, about, function, needs_settings},
#include "cli/verbs/verbs.def"
#undef VERB
  };
  return kVerbs;
}

void AddVerbs(CommandLine& line) {
  for (const Verb& verb : Verbs()) {
    verb.add(line, *line.app().add_subcommand(std::string(verb.name), std::string(verb.about)));
  }
}

bool NeedsSettings(const CLI::App& app) {
  const std::vector<CLI::App*> chosen = app.get_subcommands();
  if (chosen.empty()) return true;
  const auto verb = std::ranges::find(Verbs(), chosen.front()->get_name(), &Verb::name);
  return verb == Verbs().end() || verb->needs_settings;
}

}  // namespace contact::cli
