// Spectators of one game: WebSockets that read and forget, all on one thread that gives way, for it
// stands for other people's machines.
//
//   Audience audience(server.http_port(), game, 1'000);   // returns when each has its snapshot
//   ...
//   const Audience::Told told = audience.told();
#pragma once

#include <cstdint>
#include <memory>

namespace poolhall::bench {

class Audience {
 public:
  struct Told {
    std::uint64_t fewest = 0;     // turns, by the spectator who was told least
    std::uint64_t most = 0;       // by the one who was told most
    std::uint64_t bytes = 0;      // by all together, snapshots too
    std::uint64_t gone = 0;       // connections that the server ended
    double median_spread_ms = 0;  // of a turn, from the first who was told to the last
    double longest_spread_ms = 0;
  };

  // Throws std::runtime_error when somebody has no snapshot after a minute.
  Audience(std::uint16_t port, std::int64_t game, std::uint32_t count);
  ~Audience();
  Audience(const Audience&) = delete;
  Audience& operator=(const Audience&) = delete;

  // What they were told since they were all there; they go.
  [[nodiscard]] Told leave();

 private:
  class Room;
  std::unique_ptr<Room> room_;
};

}  // namespace poolhall::bench
