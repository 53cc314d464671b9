// A certificate that signs itself, for 127.0.0.1 and localhost, made when a test runs.
//
//   Certificate certificate = make_certificate(directory);
//   settings.tls = {"127.0.0.1:0", certificate.file, certificate.key};
#pragma once

#include <filesystem>
#include <string>

namespace poolhall::net_tests {

struct Certificate {
  std::string file;  // PEM
  std::string key;   // PEM
};

[[nodiscard]] Certificate make_certificate(const std::filesystem::path& directory,
                                           const std::string& name = "server");

}  // namespace poolhall::net_tests
