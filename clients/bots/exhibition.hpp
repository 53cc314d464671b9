// Games inside one process, without server and sockets: for measuring how strong a bot is.
// A shot goes the way that it goes on the server: prepared, noise added, simulated, judged.
//
//   ExhibitionGame game = play_exhibition({.seed = 7},
//                                         {*house_bot("greedy", {}), *house_bot("random", {})});
//   game.result.winner
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "clients/cpp/player.hpp"

namespace poolhall::bots {

struct ExhibitionSettings {
  rules::GameSettings game{};
  std::string table = "olympiad";
  std::string materials = "olympiad";
  std::string noise = "olympiad";
  bool hides_noise = false;  // the players are not told
  std::uint64_t seed = 1;    // of the noise
  // Unset: drawn from the seed. Of a seat's shot with this number, from 1; asked for when the shot
  // has been chosen, and may block.
  std::function<physics::ShotDeviates(rules::Seat, std::uint32_t)> deviates{};
  std::uint32_t most_turns = 2000;
  // Of each player, on the wall; unset: nobody's time runs.
  std::optional<std::chrono::microseconds> game_time{};
};

struct SeatRecord {
  std::uint32_t shots = 0;
  std::uint32_t refused = 0;
  std::uint32_t fouls = 0;
  std::uint32_t pots = 0;    // shots after which the player had the table again, or had won
  std::uint32_t visits = 0;  // runs of shots without one of the opponent's between them
  std::chrono::nanoseconds thinking{};
  std::chrono::nanoseconds longest{};  // over one move
};

struct ExhibitionGame {
  rules::GameResult result{};
  std::string fault{};  // why the game is void
  std::uint32_t turns = 0;
  std::array<SeatRecord, 2> seats{};  // by seat
  bool break_and_run = false;         // the opponent of the winner never had a shot
};

// Ends with EndReason::void_game with `fault` if the turns run out or the simulator or the
// referee refuses.
[[nodiscard]] ExhibitionGame play_exhibition(const ExhibitionSettings& settings,
                                             const std::array<client::PlayerFactory, 2>& players);

}  // namespace poolhall::bots
