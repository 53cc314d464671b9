// What the API's pages have in common. For the sources of this room.
//
//   const auto names = names_of(reader);
//   write_agents(out, game.agents, *names);
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "protocol/json_writer.hpp"
#include "server/storage/database.hpp"
#include "server/web/page.hpp"

namespace poolhall::web {

using protocol::JsonWriter;
using storage::Reader;

using Names = std::map<std::int64_t, std::string>;  // by AgentId

// Until when things have happened, for those who read.
class Horizon {
 public:
  explicit Horizon(std::chrono::milliseconds delay)
      : until_(delay.count() == 0 ? storage::UnixMicros{INT64_MAX}
                                  : storage::UnixMicros{number(storage::unix_now()) -
                                                        std::chrono::microseconds{delay}.count()}) {
  }
  [[nodiscard]] bool sees(storage::UnixMicros when) const { return when <= until_; }
  [[nodiscard]] storage::UnixMicros until() const { return until_; }
  // The game as it is seen: not over, if its end is too new.
  [[nodiscard]] storage::GameRecord seen(storage::GameRecord game) const {
    if (game.over && (!game.finished || !sees(*game.finished))) {
      game.over = false;
      game.result.reset();
    }
    return game;
  }

 private:
  storage::UnixMicros until_;
};

[[nodiscard]] Page unreadable(const storage::StorageError& error);
[[nodiscard]] Page not_found(std::string_view what);
[[nodiscard]] Page page_of(JsonWriter& out);
[[nodiscard]] storage::Expected<Names> names_of(Reader& reader);
[[nodiscard]] const std::string& name_in(const Names& names, storage::AgentId agent);
void write_agents(JsonWriter& out, const std::array<storage::AgentId, 2>& agents,
                  const Names& names);
// "over", and when it is: "winner" (a seat), "reason", "scored".
void write_result(JsonWriter& out, const storage::GameRecord& game);
[[nodiscard]] std::int64_t unix_ms(storage::UnixMicros t);

// The pages, each by its path.
[[nodiscard]] Page game_page(Reader& reader, std::int64_t id, const Horizon& horizon);
[[nodiscard]] Page shot_page(Reader& reader, std::int64_t id, std::int64_t number,
                             const Horizon& horizon);
[[nodiscard]] Page tournaments_page(Reader& reader, const Horizon& horizon);
[[nodiscard]] Page tournament_page(Reader& reader, std::string_view id, const Horizon& horizon);
[[nodiscard]] Page agents_page(Reader& reader, const Horizon& horizon);
[[nodiscard]] Page agent_page(Reader& reader, std::string_view name, const Horizon& horizon);

}  // namespace poolhall::web
