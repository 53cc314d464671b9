#include "clients/bots/exhibition.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <utility>
#include <vector>

#include "clients/bots/dice.hpp"
#include "protocol/shot_path.hpp"

namespace poolhall::bots {
namespace {

constexpr std::uint32_t most_refusals = 3;

class Exhibition {
 public:
  Exhibition(const ExhibitionSettings& settings, const std::array<client::PlayerFactory, 2>& makers)
      : settings_(settings),
        table_(physics::preset_table(settings.table).value()),
        materials_(physics::preset_materials(settings.materials).value()),
        noise_(protocol::noise_preset(settings.noise).value()),
        state_(rules::new_game(settings.game, table_, materials_)) {
    const std::string name = "exhibition-" + std::to_string(settings.seed);
    for (const rules::Seat seat : {rules::Seat::first, rules::Seat::second}) {
      const std::size_t i = rules::index(seat);
      infos_[i] = {name, seat, "", settings.game.rules, table_, materials_, std::nullopt};
      if (!settings.hides_noise) {
        infos_[i].noise = noise_;
      }
      players_[i] = makers[i](infos_[i]);
    }
  }

  ExhibitionGame play() {
    while (!state_.result && game_.turns < settings_.most_turns) {
      ++game_.turns;
      play_turn();
    }
    if (!state_.result) {
      game_.fault = "more than " + std::to_string(settings_.most_turns) + " turns";
    }
    const std::optional<rules::Seat> winner = state_.result ? state_.result->winner : std::nullopt;
    game_.break_and_run = winner && game_.seats[rules::index(rules::other(*winner))].shots == 0;
    game_.result =
        state_.result.value_or(rules::GameResult{std::nullopt, rules::EndReason::void_game});
    return game_;
  }

 private:
  void play_turn() {
    const rules::Seat seat = state_.to_move;
    for (std::uint32_t refusals = 0; refusals < most_refusals; ++refusals) {
      const client::Move move = ask(seat, refusals);
      if (settings_.game_time && game_.seats[rules::index(seat)].thinking >= *settings_.game_time) {
        state_ = rules::ended(state_, {rules::other(seat), rules::EndReason::timeout});
        return;
      }
      if (std::visit([&](const auto& chosen) { return take(seat, chosen); }, move)) {
        return;
      }
      ++game_.seats[rules::index(seat)].refused;
    }
    ++game_.seats[rules::index(seat)].fouls;
    state_ =
        rules::judge_lost_turn(state_, rules::FoulCode::too_many_refusals, table_, materials_).next;
  }

  client::Move ask(rules::Seat seat, std::uint32_t refusals) {
    const std::size_t i = rules::index(seat);
    const auto begin = std::chrono::steady_clock::now();
    client::Move move = players_[i]->choose({infos_[i], state_, clock_of(seat), refusals, shots_});
    const std::chrono::nanoseconds thought = std::chrono::steady_clock::now() - begin;
    game_.seats[i].thinking += thought;
    game_.seats[i].longest = std::max(game_.seats[i].longest, thought);
    return move;
  }

  [[nodiscard]] client::Clock clock_of(rules::Seat seat) const {
    if (!settings_.game_time) {
      return {};
    }
    const auto left = [this](rules::Seat of) {
      const auto used = std::chrono::duration_cast<std::chrono::microseconds>(
          game_.seats[rules::index(of)].thinking);
      return std::max(*settings_.game_time - used, std::chrono::microseconds{0});
    };
    return {.own = left(seat), .opponent = left(rules::other(seat))};
  }

  // Each says whether the move was accepted.
  bool take(rules::Seat, const rules::Decision& decision) {
    auto next = rules::decide(state_, decision, table_, materials_);
    if (!next) {
      return false;
    }
    state_ = *std::move(next);
    return true;
  }

  bool take(rules::Seat seat, const client::Concede&) {
    state_ = rules::ended(state_, {rules::other(seat), rules::EndReason::conceded});
    return true;
  }

  bool take(rules::Seat seat, const client::Shot& shot) {
    auto ready =
        protocol::ready_shot(state_, shot.call, shot.cue_ball, shot.stroke, table_, materials_);
    if (!ready) {
      return false;
    }
    const auto executed = protocol::executed_shot(shot.stroke, noise_, deviates(seat),
                                                  ready->scene.balls, table_, materials_);
    shots_.push_back({shot.stroke, executed.params, executed.moved});
    ready->scene.shot = protocol::to_physics(executed.params);
    const auto played = protocol::play_shot(*ready);
    if (!played) {
      const protocol::Error error = protocol::request_error(played.error());
      return give_up(error.field + " " + error.reason);
    }
    record(game_.seats[rules::index(seat)], seat, played->ruling);
    state_ = played->ruling.next;
    return true;
  }

  physics::ShotDeviates deviates(rules::Seat seat) {
    if (settings_.deviates) {
      return settings_.deviates(seat, game_.seats[rules::index(seat)].shots + 1);
    }
    return Dice(Dice::key(settings_.seed, "noise"), state_.turn).deviates();
  }

  bool give_up(std::string fault) {
    game_.fault = std::move(fault);
    state_ = rules::ended(state_, {std::nullopt, rules::EndReason::void_game});
    return true;
  }

  void record(SeatRecord& record, rules::Seat seat, const rules::Ruling& ruling) {
    ++record.shots;
    record.visits += last_shooter_ == seat ? 0U : 1U;
    last_shooter_ = seat;
    record.fouls += ruling.fouls.empty() ? 0U : 1U;
    const bool goes_on =
        ruling.next.result ? ruling.next.result->winner == seat : ruling.next.to_move == seat;
    record.pots += ruling.legal && goes_on ? 1U : 0U;
  }

  ExhibitionSettings settings_;
  physics::Table table_;
  physics::Materials materials_;
  protocol::NoiseParams noise_;
  rules::GameState state_;
  std::array<client::GameInfo, 2> infos_;
  std::array<std::unique_ptr<client::Player>, 2> players_;
  std::vector<client::SeenShot> shots_;
  std::optional<rules::Seat> last_shooter_{};
  ExhibitionGame game_;
};

}  // namespace

ExhibitionGame play_exhibition(const ExhibitionSettings& settings,
                               const std::array<client::PlayerFactory, 2>& players) {
  return Exhibition(settings, players).play();
}

}  // namespace poolhall::bots
