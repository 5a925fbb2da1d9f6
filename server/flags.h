#pragma once

#include <string>
#include <vector>

#include "config.h"

namespace CLI {
class App;
}

namespace contact {

/// Values of flags that are not settings themselves; ReadConfig derives settings from them.
struct Switches {
  bool no_reflection = false;       ///< Hide the services on loopback, too.
  bool channelz = false;            ///< Show connections and calls on loopback.
  bool insecure = false;            ///< Listening on addresses that others can reach is intended.
  std::vector<std::string> listen;  ///< The first is Config::listen; empty: its default.
  std::vector<std::string> listen_as;  ///< See ReadConfig.
  double write_stall_s = 30;           ///< GrpcServerOptions::write_stall, in seconds.
};

/// Adds every flag of contactd to `app`. Parsing then sets `config` and `switches`; their present
/// values are the defaults that the help shows. A bad value is a CLI::ValidationError.
void AddFlags(CLI::App* app, Config* config, Switches* switches);

}  // namespace contact
