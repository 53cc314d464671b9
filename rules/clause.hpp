// A clause of the rules as data: its name, where it stands and what it says. Wherever a clause
// decides something, the code asks `applies`, so that every ruling can name the clauses it used
// and a test can switch off or invert each of them.
//
//   if (applies(clauses::scratch, facts.is_down(cue_ball))) ...
#pragma once

#include <string_view>
#include <vector>

namespace poolhall::rules {

struct Clause {
  std::string_view name;  // unique, snake_case
  std::string_view rule;  // of the world-standardised rules ("6.1"), or a house rule ("H2")
  std::string_view text;  // in words, for a person
};

#ifdef POOLHALL_CLAUSE_MUTATION
// Only in the mutation test's own build, which defines it.
[[nodiscard]] bool applies(const Clause& clause, bool fact);
#else
[[nodiscard]] constexpr bool applies(const Clause& /*clause*/, bool fact) {
  return fact;
}
#endif

// Every clause of every game.
[[nodiscard]] std::vector<const Clause*> all_clauses();

}  // namespace poolhall::rules
