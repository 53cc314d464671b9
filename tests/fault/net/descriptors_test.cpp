// The server without file descriptors: it says that it is full, games go on, and when there are
// some again it takes connections again.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <filesystem>
#include <iterator>

#include "../../integration/net/scripted_play.hpp"
#include "../../integration/net/server_process.hpp"
#include "tests/support/temporary_directory.hpp"

namespace poolhall::net_tests {
namespace {

void limit_descriptors(pid_t process, rlim_t count) {
  rlimit limit{};
  prlimit(process, RLIMIT_NOFILE, nullptr, &limit);
  limit.rlim_cur = count;
  ASSERT_EQ(prlimit(process, RLIMIT_NOFILE, &limit, nullptr), 0);
}

std::ptrdiff_t descriptors_of(pid_t process) {
  const std::filesystem::directory_iterator open("/proc/" + std::to_string(process) + "/fd");
  return std::distance(begin(open), end(open));
}

// The code of the error that ends the connection, or "" once a hello is answered.
std::string greeted(WireClient& client) {
  client.send_bytes(protocol::encode_request(1, protocol::Hello{1, 1, "one-more", {}, {}}));
  const auto line = client.read_line();
  if (!line) {
    return "ended";
  }
  return line->find("server_full") != std::string::npos ? "server_full" : "";
}

TEST(WithoutDescriptors, TheServerSaysSoAndGamesGoOn) {
#ifdef __SANITIZE_ADDRESS__
  // UBSan, which that build has too, looks at an object's type through a pipe: where there is no
  // descriptor for one it takes every sound object for a wrong one and ends the server.
  GTEST_SKIP() << "UBSan's vptr check needs file descriptors itself";
#endif
  test_support::TemporaryDirectory directory;
  ServerProcess server{directory.path()};
  WireClient anna{server.port()};
  WireClient bert{server.port()};
  anna.join("anna");
  bert.join("bert");
  static_cast<void>(start_game(anna, bert, "bert"));
  constexpr std::ptrdiff_t spare = 4;
  limit_descriptors(server.pid(), static_cast<rlim_t>(descriptors_of(server.pid()) + spare));

  std::vector<std::unique_ptr<WireClient>> crowd;
  std::string last;
  for (int i = 0; i < 2 * spare && last.empty(); ++i) {
    crowd.push_back(std::make_unique<WireClient>(server.port()));
    last = greeted(*crowd.back());
  }
  EXPECT_EQ(last, "server_full");
  const rules::GameState after = play_turns({anna, bert}, rules::Seat::first, 3);
  EXPECT_GE(after.turn, 3U);

  crowd.clear();
  // The places are free once the server has seen the ends.
  do {
    WireClient again{server.port()};
    last = greeted(again);
  } while (!last.empty());
  EXPECT_EQ(server.terminate(), 0);
}

}  // namespace
}  // namespace poolhall::net_tests
