#include "clients/cpp/player.hpp"

#include <utility>

namespace poolhall::client {
namespace {

class FunctionPlayer : public Player {
 public:
  explicit FunctionPlayer(std::function<Move(const TurnView&)> choose)
      : choose_(std::move(choose)) {}

  Move choose(const TurnView& turn) override { return choose_(turn); }

 private:
  std::function<Move(const TurnView&)> choose_;
};

}  // namespace

PlayerFactory player_from(std::function<Move(const TurnView&)> choose) {
  return [choose = std::move(choose)](const GameInfo&) -> std::unique_ptr<Player> {
    return std::make_unique<FunctionPlayer>(choose);
  };
}

}  // namespace poolhall::client
