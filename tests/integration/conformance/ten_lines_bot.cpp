// The ten-line bot of clients/cpp/README.md as a program: plays on the server that POOLHALL_SERVER
// names (HOST:PORT).
#include <cstdlib>
#include <string>

#include "tests/support/ten_lines.hpp"

int main() {
  using namespace poolhall;
  const std::string server = std::getenv("POOLHALL_SERVER");
  client::ClientOptions options;
  options.port = server.substr(server.rfind(':') + 1);
  options.agent = {.name = "ten-lines", .challenges = {{.opponent = "house:random"}}, .games = 1};
  client::play(options, test_support::ten_lines);
}
