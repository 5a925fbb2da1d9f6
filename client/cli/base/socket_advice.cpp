#include "cli/base/socket_advice.h"

namespace contact::cli {

std::string SocketAdvice(const std::string& server, const std::string& words) {
  if (!server.starts_with("unix:")) return "";
  const bool packaged = server.starts_with("unix:/run/contactd/");
  if (words.find("Permission denied") != std::string::npos) {
    return packaged ? "sudo adduser \"$USER\" contact, then log in again"
                    : "log in again if you have joined its group, else ask its owner";
  }
  return packaged ? "sudo systemctl start contactd" : "";
}

}  // namespace contact::cli
