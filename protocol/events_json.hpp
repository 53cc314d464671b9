// Event logs as JSON and back, bit for bit.
//
//   std::string full = encode_events(simulation.events, EventDetail::full);
//   Expected<physics::EventLog<double>> log = decode_events(full);
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "physics/event_log.hpp"
#include "protocol/errors.hpp"

namespace poolhall::protocol {

enum class EventDetail : std::uint8_t {
  full,
  summary,  // without `after`
};

[[nodiscard]] std::string encode_events(const physics::EventLog<double>& events,
                                        EventDetail detail);

// The summary of a full log that encode_events wrote, without reading its numbers.
[[nodiscard]] std::string summary_of(std::string_view full);

// A summary comes back with the balls' ids and nothing else in `after`.
[[nodiscard]] Expected<physics::EventLog<double>> decode_events(std::string_view text);

}  // namespace poolhall::protocol
