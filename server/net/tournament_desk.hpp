// The tournaments of a serving host: made, started, held, ended by the host's calls, and taken up
// again after a restart. Each has a driver of its own.
//
//   TournamentDesk desk{host, matches, {{"greedy"}, 16}, call_off, steady_clock::now};
//   desk.take_up();
//   if (auto made = desk.create(toml_text); made) desk.start(made->id);
//
// The network thread's own.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

#include "server/net/match_host.hpp"
#include "server/net/matches.hpp"
#include "server/net/tournament_driver.hpp"

namespace poolhall::net {

// Why a call of the host's cannot be done.
struct DeskRefusal {
  enum class Kind : std::uint8_t { bad_settings, unknown, conflict };
  Kind kind = Kind::conflict;
  std::string reason;  // one line: what came and what was expected
};

// Who can play for the house.
struct HouseOffer {
  std::vector<std::string> bots;  // by name
  std::uint32_t most = 0;         // processes at a time, entries' commands too
};

// Why the house cannot play these entries: a bot that there is not, too few processes.
[[nodiscard]] std::optional<std::string> why_not_housed(
    const HouseOffer& offer, const settings::TournamentSettings& settings);

class TournamentDesk {
 public:
  template <class T>
  using Result = tl::expected<T, DeskRefusal>;
  using Now = std::function<SteadyTime()>;
  // Ends games that go on, of that tournament.
  using CallOff = std::function<void(const std::string& tournament)>;

  TournamentDesk(MatchHost& host, Matches& matches, HouseOffer house, CallOff call_off, Now now);
  ~TournamentDesk();
  TournamentDesk(const TournamentDesk&) = delete;
  TournamentDesk& operator=(const TournamentDesk&) = delete;

  // Tournaments that ran when the server stopped go on; held ones stay held.
  void take_up();

  // From a tournament file's text; open until it is started. The same text again is the same
  // tournament.
  [[nodiscard]] Result<TournamentCard> create(const std::string& text);
  [[nodiscard]] Result<TournamentCard> start(const std::string& id);
  // Games that go on are played to their end; no other begins.
  [[nodiscard]] Result<TournamentCard> pause(const std::string& id);
  [[nodiscard]] Result<TournamentCard> resume(const std::string& id);
  // Games that go on are void.
  [[nodiscard]] Result<TournamentCard> abort(const std::string& id);

 private:
  class Share;  // of the host, for one tournament
  struct Running {
    std::unique_ptr<Share> share;
    std::unique_ptr<TournamentDriver> driver;
  };

  [[nodiscard]] Result<TournamentCard> card_of(const std::string& id) const;
  void enter_all(const TournamentCard& card);
  [[nodiscard]] Result<TournamentCard> drive(const TournamentCard& card);
  [[nodiscard]] Result<TournamentCard> in_status(const std::string& id, TournamentStatus status);

  MatchHost& host_;
  Matches& matches_;
  HouseOffer house_;
  CallOff call_off_;
  Now now_;
  std::map<std::string, Running> running_;
};

}  // namespace poolhall::net
