// A bot on a server: connects, logs in, lets players choose, and comes back by itself when the
// connection or the server is lost. Many games at once over one connection; the network goes on
// while players think.
//
//   client::ClientOptions options;
//   options.agent.name = "my-bot";
//   options.agent.challenges = {{.opponent = "house:greedy"}};
//   client::Client bot(options, client::player_from(choose));
//   client::End end = bot.run();   // blocks; why it ended for good
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "clients/cpp/agent.hpp"
#include "clients/cpp/player.hpp"
#include "clients/cpp/transport.hpp"

namespace poolhall::client {

struct ClientOptions {
  std::string host = "127.0.0.1";
  std::string port = "7777";
  std::optional<TlsOptions> tls{};  // unset: plain TCP
  AgentSettings agent{};
  unsigned threads = 1;  // moves that are chosen at the same time, one a game
  // Between two attempts to connect; doubles from the first to the last, with jitter.
  std::chrono::milliseconds first_backoff{100};
  std::chrono::milliseconds last_backoff{5'000};
  // A connection that does not get to a login in this time is given up; one that is silent for
  // this time is asked (ping), and given up after twice as long.
  std::chrono::milliseconds login_deadline{10'000};
  std::chrono::milliseconds silence{20'000};
  std::vector<int> stop_signals{};  // run() ends with Ending::stopped when one comes
};

class Client {
 public:
  Client(ClientOptions options, PlayerFactory factory);
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;
  ~Client();

  // Returns when the agent is done for good. Throws what a Player threw.
  End run();
  // From any thread.
  void stop();

 private:
  class Life;
  std::unique_ptr<Life> life_;
};

// One call for the simplest bots.
End play(ClientOptions options, std::function<Move(const TurnView&)> choose);

}  // namespace poolhall::client
