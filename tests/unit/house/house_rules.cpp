#include "house_rules.hpp"

#include <algorithm>
#include <regex>
#include <sstream>

namespace poolhall::house {
namespace {

using Words = std::vector<std::string>;

bool any_begins(const Words& beginnings, std::string_view text) {
  return std::any_of(beginnings.begin(), beginnings.end(),
                     [&](const std::string& beginning) { return text.starts_with(beginning); });
}

// The C++ standard library: no slash, no ".h".
bool is_standard(std::string_view header) {
  return header.find_first_of("/.") == std::string_view::npos;
}

bool allows_library(const Room& room, std::string_view file, std::string_view header) {
  // std::expected of C++23, everywhere.
  if (is_standard(header) || header == "tl/expected.hpp" || any_begins(room.libraries, header)) {
    return true;
  }
  return file.ends_with(".cpp") && any_begins(room.source_libraries, header);
}

bool allows_room(const Room& room, std::string_view header) {
  const Room* other = room_of(header);
  return other != nullptr &&
         (other->path == room.path ||
          std::find(room.rooms.begin(), room.rooms.end(), other->path) != room.rooms.end());
}

// POSIX and Linux.
const Words operating_system{"sys/",     "netinet/", "arpa/",     "linux/",
                             "unistd.h", "fcntl.h",  "signal.h",  "poll.h",
                             "netdb.h",  "spawn.h",  "termios.h", "sys/ioctl.h"};

Words with_system(Words libraries) {
  libraries.insert(libraries.end(), operating_system.begin(), operating_system.end());
  return libraries;
}

}  // namespace

// NOLINTNEXTLINE(readability-function-size): a table, one row a room
const std::vector<Room>& rooms() {
  static const std::vector<Room> all{
      {"physics", {}, {"Random123/"}, {}},
      {"physics/reference",
       {"physics"},
       {"boost/multiprecision/", "boost/math/"},
       {"boost/numeric/odeint"}},
      {"rules", {"physics"}, {"Random123/"}, {}},
      {"protocol", {"rules", "physics"}, {}, {"nlohmann/", "fmt/"}},
      {"server/settings", {"protocol", "rules", "physics"}, {"fmt/"}, {"toml++/"}},
      {"server/ratings", {}, {"Eigen/"}, {}},
      {"server/meter", {}, with_system({"time.h"}), {}},
      {"server/tournament",
       {"server/ratings", "rules", "physics"},
       {"fmt/", "boost/multiprecision/"},
       {}},
      {"server/ledger",
       {"server/storage", "server/tournament", "server/ratings", "server/settings", "protocol",
        "rules", "physics"},
       {"fmt/"},
       {}},
      {"server/storage",
       {"server/meter", "protocol", "rules", "physics"},
       with_system({"SQLiteCpp/", "sqlite3.h", "zstd.h", "spdlog/", "fmt/"}),
       {}},
      {"server/match",
       {"server/storage", "server/meter", "protocol", "rules", "physics"},
       with_system({"openssl/", "spdlog/", "fmt/"}),
       {}},
      {"server/web",
       {"server/match", "server/ledger", "server/storage", "server/tournament", "server/ratings",
        "server/settings", "protocol", "rules", "physics"},
       with_system({"boost/asio", "boost/beast", "boost/crc.hpp", "boost/system", "openssl/",
                    "spdlog/", "fmt/"}),
       {}},
      {"server/net",
       {"server/web", "server/meter", "server/match", "server/ledger", "server/storage",
        "server/tournament", "server/ratings", "server/settings", "protocol", "rules", "physics"},
       with_system({"boost/asio", "boost/beast", "boost/system", "openssl/", "spdlog/", "fmt/"}),
       {}},
      {"clients/cpp",
       {"protocol", "rules", "physics"},
       with_system({"boost/asio", "boost/beast", "boost/system", "openssl/"}),
       {}},
      {"clients/bots", {"clients/cpp", "protocol", "rules", "physics"}, {"Random123/"}, {}},
      {"clients/load",
       {"clients/bots", "clients/cpp", "protocol", "rules", "physics"},
       with_system({"boost/asio", "boost/system"}),
       {}},
      {"clients/python",
       {"protocol", "rules", "physics"},
       with_system({"pybind11/", "sched.h"}),
       {}},
      {"clients/conformance",
       {"clients/bots", "clients/cpp", "protocol", "rules", "physics"},
       with_system({}),
       {}},
      {"server/app",
       {"server/web", "server/net", "server/match", "server/ledger", "server/storage",
        "server/tournament", "server/ratings", "server/settings", "clients/cpp", "clients/bots",
        "clients/load", "clients/conformance", "protocol", "rules", "physics", "physics/reference",
        "tests/bench", "tests/fault/harness", "tests/support"},
       with_system({"CLI/", "spdlog/", "fmt/", "boost/multiprecision/", "boost/asio/ip/"}),
       {}},
      {"tests/bench",
       {"physics", "physics/reference", "rules", "protocol"},
       {"benchmark/", "boost/", "fmt/"},
       {}},
      {"tests/fault/harness", {}, {}, {}},
      {"tests/support", {}, {}, {}},
  };
  return all;
}

const Room* room_of(std::string_view file) {
  const Room* deepest = nullptr;
  for (const Room& room : rooms()) {
    const bool inside = file.starts_with(room.path + "/");
    if (inside && (deepest == nullptr || room.path.size() > deepest->path.size())) {
      deepest = &room;
    }
  }
  return deepest;
}

std::vector<std::string> forbidden_includes(std::string_view file, std::string_view text) {
  static const std::regex include(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
  const Room* room = room_of(file);
  std::vector<std::string> wrong;
  std::istringstream lines{std::string(text)};
  std::size_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    std::smatch match;
    if (!std::regex_search(line, match, include)) {
      continue;
    }
    const std::string header = match[2];
    const bool allowed = room != nullptr && (match[1] == "<" ? allows_library(*room, file, header)
                                                             : allows_room(*room, header));
    if (!allowed) {
      wrong.push_back(std::string(file) + ":" + std::to_string(number) + ": " + header);
    }
  }
  return wrong;
}

}  // namespace poolhall::house
