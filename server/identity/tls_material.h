#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <variant>

namespace contact {

/// The files from which a server has what TLS needs.
struct TlsPaths {
  /// The server's certificate and those that lead from it to its authority, PEM.
  std::filesystem::path certificate = {};
  /// Its private key, PEM.
  std::filesystem::path key = {};
  /// The authorities whose client certificates are taken, PEM; empty: none are asked for.
  std::filesystem::path client_ca = {};
  /// What these authorities have revoked, PEM, a list of each; empty: nothing.
  std::filesystem::path crl = {};
};

/// What is in these files.
struct TlsMaterial {
  std::string certificate;
  std::string key;
  std::string client_ca;
  std::string crl;
  /// End of the certificate's validity.
  std::chrono::system_clock::time_point not_after;
};

/// Reads the files; words about the first mistake if they cannot be used: one is missing or empty,
/// holds no certificate or no key, the key is not that of the certificate or others may read its
/// file, the certificate is not valid at `now`, or there is no list of revocations or one that is
/// over, with which nobody would come in.
std::variant<TlsMaterial, std::string> LoadTls(const TlsPaths& paths,
                                               std::chrono::system_clock::time_point now);

}  // namespace contact
