#include "server/net/tournament_desk.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>
#include <variant>

#include "server/net/tokens.hpp"
#include "server/settings/tournament_settings.hpp"

namespace poolhall::net {

using Kind = DeskRefusal::Kind;

// Several drivers share one host: each hears of its own tournament, and its matches wait while it
// is held.
class TournamentDesk::Share final : public MatchHost {
 public:
  explicit Share(MatchHost& host) : host_(host) {}

  void hold() { held_ = true; }
  void go_on() {
    held_ = false;
    for (const MatchOrder& order : std::exchange(waiting_, {})) {
      host_.start_match(order);
    }
  }
  void hear(const MatchOutcome& outcome) const {
    if (on_match_over_) {
      on_match_over_(outcome);
    }
  }
  void hear_of_entries(const std::string& tournament) const {
    if (on_entries_changed_) {
      on_entries_changed_(tournament);
    }
  }
  void hear(const MatchOrder& order, const GameOutcome& outcome) const {
    if (on_game_over_) {
      on_game_over_(order, outcome);
    }
  }

  TournamentCard open_tournament(const TournamentCard& card) override {
    return host_.open_tournament(card);
  }
  void set_status(const std::string& tournament, TournamentStatus status) override {
    if (!held_ || status != TournamentStatus::running) {
      host_.set_status(tournament, status);
    }
  }
  [[nodiscard]] std::vector<TournamentCard> tournaments() const override {
    return host_.tournaments();
  }
  void enter(const TournamentEntry& entry) override { host_.enter(entry); }
  [[nodiscard]] std::vector<TournamentEntry> entries(const std::string& tournament) const override {
    return host_.entries(tournament);
  }
  void start_match(const MatchOrder& order) override {
    if (held_) {
      waiting_.push_back(order);
    } else {
      host_.start_match(order);
    }
  }
  void set_intake(const std::string& tournament, const Intake& intake) override {
    host_.set_intake(tournament, intake);
  }
  void cancel_match(const std::string& tournament, std::uint32_t pairing) override {
    std::erase_if(waiting_,
                  [pairing](const MatchOrder& order) { return order.pairing == pairing; });
    host_.cancel_match(tournament, pairing);
  }
  [[nodiscard]] std::vector<MatchOutcome> finished_matches(
      const std::string& tournament) const override {
    return host_.finished_matches(tournament);
  }
  [[nodiscard]] std::vector<MatchOutcome> unfinished_matches(
      const std::string& tournament) const override {
    return host_.unfinished_matches(tournament);
  }
  void on_match_over(std::function<void(const MatchOutcome&)> callback) override {
    on_match_over_ = std::move(callback);
  }
  void on_game_over(std::function<void(const MatchOrder&, const GameOutcome&)> callback) override {
    on_game_over_ = std::move(callback);
  }
  void on_entries_changed(std::function<void(const std::string&)> callback) override {
    on_entries_changed_ = std::move(callback);
  }
  void announce_end(const std::string& tournament,
                    const std::vector<protocol::StandingRow>& standings) override {
    host_.announce_end(tournament, standings);
  }

 private:
  MatchHost& host_;
  bool held_ = false;
  std::vector<MatchOrder> waiting_;
  std::function<void(const MatchOutcome&)> on_match_over_;
  std::function<void(const MatchOrder&, const GameOutcome&)> on_game_over_;
  std::function<void(const std::string&)> on_entries_changed_;
};

namespace {

tl::unexpected<DeskRefusal> refused(Kind kind, std::string reason) {
  return tl::unexpected(DeskRefusal{kind, std::move(reason)});
}

tl::unexpected<DeskRefusal> wrong_status(const TournamentCard& card, std::string_view expected) {
  return refused(Kind::conflict, fmt::format("tournament \"{}\" is {}, expected {}", card.id,
                                             storage::name(card.status), expected));
}

}  // namespace

TournamentDesk::TournamentDesk(MatchHost& host, Matches& matches, HouseOffer house,
                               CallOff call_off, Now now)
    : host_(host),
      matches_(matches),
      house_(std::move(house)),
      call_off_(std::move(call_off)),
      now_(std::move(now)) {}

TournamentDesk::~TournamentDesk() = default;

void TournamentDesk::take_up() {
  host_.on_match_over([this](const MatchOutcome& outcome) {
    if (const auto found = running_.find(outcome.tournament); found != running_.end()) {
      found->second.share->hear(outcome);
    }
  });
  host_.on_game_over([this](const MatchOrder& order, const GameOutcome& outcome) {
    if (const auto found = running_.find(order.tournament); found != running_.end()) {
      found->second.share->hear(order, outcome);
    }
  });
  host_.on_entries_changed([this](const std::string& tournament) {
    if (const auto found = running_.find(tournament); found != running_.end()) {
      found->second.share->hear_of_entries(tournament);
    }
  });
  for (const TournamentCard& card : host_.tournaments()) {
    if (card.status == TournamentStatus::open) {
      enter_all(card);  // who has not registered yet
    } else if (card.status == TournamentStatus::aborted) {
      matches_.set_pace(card.id, Matches::Pace::ended);
      call_off_(card.id);
    } else if (card.status == TournamentStatus::running ||
               card.status == TournamentStatus::paused) {
      if (const auto driven = drive(card); !driven) {
        spdlog::error("tournament {} does not go on: {}", card.id, driven.error().reason);
      }
    }
  }
}

TournamentDesk::Result<TournamentCard> TournamentDesk::create(const std::string& text) {
  const auto settings = settings::parse_tournament(text, "tournament");
  if (!settings) {
    return refused(Kind::bad_settings, settings::text(settings.error()));
  }
  const auto same_text = [&](const TournamentCard& card) {
    return card.settings == text || card.settings.ends_with("\n" + text);
  };
  if (auto known = card_of(settings->name)) {
    if (same_text(*known)) {
      return known;
    }
    return refused(Kind::conflict,
                   fmt::format("there is a tournament \"{}\" with other settings", settings->name));
  }
  if (const auto reason = why_not_housed(house_, *settings)) {
    return refused(Kind::bad_settings, "tournament: " + *reason);
  }
  // The racks' seed is part of what is stored, so that a restart plays the same racks.
  const std::string stored =
      settings->seed ? text : fmt::format("seed = {}\n{}", random_seed(), text);
  TournamentCard card =
      host_.open_tournament({settings->name, settings->name, stored, TournamentStatus::open});
  enter_all(card);
  return card;
}

std::optional<std::string> why_not_housed(const HouseOffer& offer,
                                          const settings::TournamentSettings& settings) {
  std::uint32_t played_here = 0;
  for (const settings::EntrySettings& entry : settings.entries) {
    played_here += std::holds_alternative<settings::AgentEntry>(entry.player) ? 0 : 1;
    const auto* house = std::get_if<settings::HouseEntry>(&entry.player);
    if (house != nullptr &&
        std::find(offer.bots.begin(), offer.bots.end(), house->bot) == offer.bots.end()) {
      return fmt::format("entry \"{}\": got house = \"{}\", expected one of {}", entry.name,
                         house->bot, fmt::join(offer.bots, ", "));
    }
  }
  const std::uint32_t needed = std::min(played_here, 2U);
  if (needed > offer.most) {
    return fmt::format(
        "got {} entries with house or command, a game of theirs needs {} of this "
        "server's processes, expected max_house_bots >= {}, it is {}",
        played_here, needed, needed, offer.most);
  }
  return std::nullopt;
}

void TournamentDesk::enter_all(const TournamentCard& card) {
  const auto settings = settings::parse_tournament(card.settings, card.id);
  for (const settings::EntrySettings& entry :
       settings ? settings->entries : std::vector<settings::EntrySettings>{}) {
    host_.enter(entry_of(card.id, entry));
  }
}

TournamentDesk::Result<TournamentCard> TournamentDesk::card_of(const std::string& id) const {
  for (const TournamentCard& card : host_.tournaments()) {
    if (card.id == id) {
      return card;
    }
  }
  return refused(Kind::unknown, fmt::format("there is no tournament \"{}\"", id));
}

TournamentDesk::Result<TournamentCard> TournamentDesk::drive(const TournamentCard& card) {
  auto settings = settings::parse_tournament(card.settings, card.id);
  if (!settings) {
    return refused(Kind::bad_settings, settings::text(settings.error()));
  }
  Running& running = running_[card.id];
  running.share = std::make_unique<Share>(host_);
  if (card.status == TournamentStatus::paused) {
    running.share->hold();
    matches_.set_pace(card.id, Matches::Pace::held);
  }
  running.driver = std::make_unique<TournamentDriver>(
      settings::TournamentFile{std::move(*settings), card.settings}, *running.share, now_);
  if (const auto begun = running.driver->begin(random_seed()); !begun) {
    running_.erase(card.id);
    return refused(Kind::conflict, begun.error());
  }
  return card_of(card.id);
}

TournamentDesk::Result<TournamentCard> TournamentDesk::in_status(const std::string& id,
                                                                 TournamentStatus status) {
  host_.set_status(id, status);
  return card_of(id);
}

TournamentDesk::Result<TournamentCard> TournamentDesk::start(const std::string& id) {
  auto card = card_of(id);
  if (!card || card->status == TournamentStatus::running) {
    return card;
  }
  if (card->status != TournamentStatus::open) {
    return wrong_status(*card, "an open one");
  }
  const auto entries = host_.entries(id);
  const auto there = std::count_if(entries.begin(), entries.end(),
                                   [](const auto& entry) { return !entry.until_round; });
  if (there < 2) {
    return refused(Kind::conflict, fmt::format("tournament \"{}\" has {} entries that have not "
                                               "left, expected 2 at least",
                                               id, there));
  }
  // The server may have been started anew since, with other bots.
  if (const auto settings = settings::parse_tournament(card->settings, id)) {
    if (const auto reason = why_not_housed(house_, *settings)) {
      return refused(Kind::conflict, "tournament: " + *reason);
    }
  }
  return drive(*card);
}

TournamentDesk::Result<TournamentCard> TournamentDesk::pause(const std::string& id) {
  auto card = card_of(id);
  if (!card || card->status == TournamentStatus::paused) {
    return card;
  }
  if (card->status != TournamentStatus::running) {
    return wrong_status(*card, "a running one");
  }
  if (const auto found = running_.find(id); found != running_.end()) {
    found->second.share->hold();
  }
  matches_.set_pace(id, Matches::Pace::held);
  return in_status(id, TournamentStatus::paused);
}

TournamentDesk::Result<TournamentCard> TournamentDesk::resume(const std::string& id) {
  auto card = card_of(id);
  if (!card || card->status == TournamentStatus::running) {
    return card;
  }
  if (card->status != TournamentStatus::paused) {
    return wrong_status(*card, "a paused one");
  }
  auto running = in_status(id, TournamentStatus::running);
  matches_.set_pace(id, Matches::Pace::steady);
  if (const auto found = running_.find(id); found != running_.end()) {
    found->second.share->go_on();
  }
  return running;
}

TournamentDesk::Result<TournamentCard> TournamentDesk::abort(const std::string& id) {
  auto card = card_of(id);
  if (!card || card->status == TournamentStatus::aborted) {
    return card;
  }
  if (card->status == TournamentStatus::finished) {
    return wrong_status(*card, "one that is not over");
  }
  running_.erase(id);
  matches_.set_pace(id, Matches::Pace::ended);
  call_off_(id);
  return in_status(id, TournamentStatus::aborted);
}

}  // namespace poolhall::net
