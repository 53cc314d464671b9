// The same games twice: among themselves, and with bad clients about. Every turn must come out the
// same to the last bit, and every bad client's connection must end with a stated reason.
//
//   BadReport report = run_bad_clients({.directory = temporary, .games = 8});
//   print(report, std::cout);
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace poolhall::fault {

struct BadOptions {
  std::filesystem::path directory;  // of the databases; must exist
  std::uint32_t games = 8;
  std::uint32_t rounds = 3;  // visits of each bad client
  std::uint64_t seed = 1;
  std::chrono::milliseconds longest_thought{60};  // of the good clients
};

struct BadEnd {
  std::string client;
  std::string reason;  // as the server stated it, of the last visit
  std::uint32_t visits = 0;
  std::vector<std::string> faults;  // what was not as it should be
};

struct BadReport {
  std::vector<BadEnd> clients;
  std::uint64_t games = 0;
  std::uint64_t turns = 0;               // compared
  std::vector<std::string> differences;  // between the two runs; the first few
  std::vector<std::string> complaints;   // of the good clients

  [[nodiscard]] bool sound() const;
};

[[nodiscard]] BadReport run_bad_clients(const BadOptions& options);
void print(const BadReport& report, std::ostream& out);

}  // namespace poolhall::fault
