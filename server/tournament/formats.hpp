// One function a format; format.hpp is the door.
#pragma once

#include "server/tournament/format.hpp"

namespace poolhall::tournament {

[[nodiscard]] Schedule swiss_schedule(const FormatSettings& format,
                                      const std::vector<EntrySpan>& field, const Happened& happened,
                                      const Schedule& drawn);
[[nodiscard]] Schedule elimination_schedule(const FormatSettings& format,
                                            const std::vector<EntrySpan>& field,
                                            const Happened& happened);
[[nodiscard]] Schedule ladder_schedule(const FormatSettings& format,
                                       const std::vector<EntrySpan>& field,
                                       const Happened& happened);
[[nodiscard]] Schedule sprt_schedule(const FormatSettings& format,
                                     const std::vector<EntrySpan>& field, const Happened& happened,
                                     const Schedule& drawn);

// Everybody against everybody, or the runners of a gauntlet against the rest. Who has withdrawn
// has no matches that have not begun.
[[nodiscard]] Schedule fixed_schedule(std::vector<Pairing> pairings,
                                      const std::vector<EntrySpan>& field,
                                      const Happened& happened);
[[nodiscard]] std::vector<Pairing> gauntlet(std::size_t entries, std::size_t runners);

}  // namespace poolhall::tournament
