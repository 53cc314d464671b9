#include "tests/support/scripted_game.hpp"

#include <string>

#include "protocol/state_json.hpp"
#include "protocol/table_json.hpp"

namespace poolhall::test_support {

using protocol::Outgoing;
using protocol::RawJson;

rules::GameState scripted_opening() {
  return rules::new_game({}, physics::preset_table("olympiad").value(),
                         physics::preset_materials("olympiad").value());
}

protocol::GameStart<Outgoing> scripted_start(protocol::GameId game) {
  protocol::GameStart<Outgoing> start;
  start.terms.game = game;
  start.terms.match = protocol::MatchId{5};
  start.terms.opponent = "somebody";
  start.terms.table = RawJson{protocol::encode_table(physics::preset_table("olympiad").value())};
  start.terms.physics =
      RawJson{protocol::encode_materials(physics::preset_materials("olympiad").value())};
  start.terms.noise = protocol::noise_preset("olympiad");
  start.terms.commitment.text = std::string(64, '0');
  start.state = RawJson{protocol::encode_state(scripted_opening())};
  return start;
}

protocol::GameTurn<Outgoing> scripted_turn(protocol::GameId game, std::uint32_t turn) {
  protocol::GameTurn<Outgoing> result;
  result.game = game;
  result.turn = turn;
  result.kind = rules::TurnKind::break_shot;
  result.state = RawJson{protocol::encode_state(scripted_opening())};
  result.clock = {600'000, 600'000, {}};
  result.legal = protocol::LegalBalls{};
  return result;
}

protocol::GameOver scripted_over(protocol::GameId game) {
  protocol::GameOver over;
  over.game = game;
  over.match = protocol::MatchId{5};
  over.checksum.text = std::string(64, '0');
  return over;
}

}  // namespace poolhall::test_support
