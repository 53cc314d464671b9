// The version of the referee's rulings. It changes with every change that judges any shot
// otherwise or says it in other words.
//
//   row.rules_version = rules::version;
#pragma once

#include <string_view>

namespace poolhall::rules {

inline constexpr std::string_view version = "rules-1";

}  // namespace poolhall::rules
