// A database as JSON lines, for other programs. One object a line, named by its only key:
//
//   {"export":{"format":1}}
//   {"agent":{"id":1,"name":"Anna"}}
//   {"tournament":{"id","title","status","settings","entries":[{"agent","place","withdrawn"}]}}
//   {"match":{"id","tournament","pairing","agents":[2],"games","over","terms":{...}}}
//   {"game":{"id","match","number","attempt","agents":[2],"breaker","terms":{...},"rack_seed",
//            "noise":{...},"key","commitment","initial_state","physics_version","rules_version",
//            "over","winner","reason","turns","checksum"}}
//   {"turn":{"game","turn","action","seat","shot_id","shot":{"index","intended","executed","moved",
//            "cue_ball","call"},"decision","refusals","clock":{...},"physics_version",
//            "rules_version","winner","reason","checksum","state_before","ruling","events",
//            "state_after"}}
//
// Agents come first, then tournaments, then the matches with their games and their turns, each in
// the order of their ids. Absent values are null; units are the wire's, times microseconds,
// digests hexadecimal. Until the match is over keys are null, and the noise of a game whose players
// are not told it is "hidden" in the terms and null in the game. Tokens are never exported.
//
//   auto done = export_lines(*reader, [&](const std::string& line) { out << line << '\n'; });
#pragma once

#include <functional>
#include <string>

#include "server/storage/database.hpp"

namespace poolhall::match {

[[nodiscard]] storage::Expected<void> export_lines(
    storage::Reader& reader, const std::function<void(const std::string&)>& line);

}  // namespace poolhall::match
