// Where the server's processor time goes. Every seventh piece of work of a kind is timed on its
// thread's own clock and counted sevenfold: cheap enough to be always on, and right on a machine
// that does other things too, for waiting is no work.
//
//   const Metered timed{Area::json_out};      // until the end of the block
//   auto ruling = metered(Area::rules, [&] { return rules::judge(...); });
//   for (const Share& share : work_times()) print(name(share.area), share.time);
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>

namespace poolhall::meter {

enum class Area : std::uint8_t {
  json_in,    // an agent's line to a request
  json_out,   // states, events, rulings, messages to text
  physics,    // shots
  rules,      // what is legal, rulings
  checksums,  // the chain of turns
  database,   // rows to SQLite
  commits,    // SQLite's commits, the disk's part in the system's calls included
  receiving,  // bytes from sockets
  sending,    // bytes to sockets
};
inline constexpr std::size_t area_count = 9;
[[nodiscard]] std::string_view name(Area area);

using Nanoseconds = std::chrono::nanoseconds;

// Times the block that it stands in. Blocks do not contain one another.
class Metered {
 public:
  explicit Metered(Area area);
  ~Metered();
  Metered(const Metered&) = delete;
  Metered& operator=(const Metered&) = delete;

 private:
  Area area_;
  std::int64_t began_;  // ns; -1: not timed
};

// What `work` gives, timed.
template <class Work>
[[nodiscard]] auto metered(Area area, Work&& work) {
  const Metered timed{area};
  return std::forward<Work>(work)();
}

// Of all threads since the start, by area.
[[nodiscard]] std::array<Nanoseconds, area_count> work_times();
// Of the whole process.
[[nodiscard]] Nanoseconds process_time();
[[nodiscard]] std::uint64_t resident_bytes();

}  // namespace poolhall::meter
