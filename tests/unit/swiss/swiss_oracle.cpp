#include "swiss_oracle.hpp"

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <map>
#include <numeric>
#include <ranges>
#include <string>

namespace poolhall::tournament {
namespace {

constexpr int floated_on = 1000;  // a score difference above any other

struct Person {
  EntryId id{};
  std::uint32_t number = 0;
  int score = 0;
  std::string breaks;  // "1" first, "2" second, of the matches played
  std::set<EntryId> met;
  bool may_have_bye = true;
  int unplayed = 0;
  char float1 = '-';
  char float2 = '-';
  char wants = '-';
  int urgency = 0;  // 3 absolute, 2 strong, 1 mild
  int difference = 0;
};

using People = std::vector<Person>;
using Pair = std::pair<int, int>;  // places by rank, the higher first
struct Round {
  std::vector<Pair> pairs;
  int bye = -1;
};

int points_before(const SwissEntry& entry, std::size_t round) {
  return std::accumulate(entry.rounds.begin(),
                         entry.rounds.begin() + static_cast<std::ptrdiff_t>(round), 0,
                         [](int sum, const SwissRound& spent) { return sum + spent.half_points; });
}

char floated(const std::map<EntryId, SwissEntry>& all, EntryId id, std::size_t back) {
  const SwissEntry& entry = all.at(id);
  if (entry.rounds.size() < back) {
    return '-';
  }
  const std::size_t at = entry.rounds.size() - back;
  const SwissRound& spent = entry.rounds[at];
  if (spent.kind != RoundKind::played && spent.half_points > 0) {
    return 'd';
  }
  if (!spent.opponent) {
    return '-';
  }
  const int difference = points_before(entry, at) - points_before(all.at(*spent.opponent), at);
  return difference > 0 ? 'd' : difference < 0 ? 'u' : '-';
}

Person person_of(const std::map<EntryId, SwissEntry>& all, EntryId id) {
  const SwissEntry& entry = all.at(id);
  Person person;
  person.id = id;
  person.number = entry.number;
  person.score = points_before(entry, entry.rounds.size());
  for (const SwissRound& spent : entry.rounds) {
    if (spent.kind == RoundKind::played) {
      person.breaks += spent.side == BreakSide::first ? '1' : '2';
      person.met.insert(*spent.opponent);
    } else {
      ++person.unplayed;
      person.may_have_bye = person.may_have_bye && spent.half_points < 2;
    }
  }
  person.float1 = floated(all, id, 1);
  person.float2 = floated(all, id, 2);
  const auto ones = std::count(person.breaks.begin(), person.breaks.end(), '1');
  const auto size = static_cast<std::ptrdiff_t>(person.breaks.size());
  person.difference = static_cast<int>(2 * ones - size);
  if (person.difference > 1 || person.breaks.ends_with("11")) {
    person.wants = '2';
    person.urgency = 3;
  }
  if (person.difference < -1 || (person.difference <= 1 && person.breaks.ends_with("22"))) {
    person.wants = '1';
    person.urgency = 3;
  }
  if (person.urgency == 0 && size > 0) {
    person.urgency = person.difference == 0 ? 1 : 2;
    const char last = person.breaks.back();
    person.wants = person.difference > 0 || (person.difference == 0 && last == '1') ? '2' : '1';
  }
  return person;
}

class Oracle {
 public:
  Oracle(People people, bool last_round, std::size_t played)
      : people_(std::move(people)), last_round_(last_round), played_(played) {
    std::sort(people_.begin(), people_.end(), [](const Person& a, const Person& b) {
      return a.score != b.score ? a.score > b.score : a.number < b.number;
    });
  }

  std::optional<OraclePairing> solve() {
    list_rounds({}, std::vector<bool>(people_.size(), false), -1);
    if (rounds_.empty()) {
      return std::nullopt;
    }
    keep_best([&](const Round& round) {
      return std::vector<int>{round.bye < 0 ? 0 : at(round.bye).score};
    });
    std::vector<int> moved_down;
    for (std::size_t begin = 0; begin < people_.size();) {
      std::size_t end = begin;
      while (end < people_.size() && people_[end].score == people_[begin].score) {
        ++end;
      }
      moved_down = settle_bracket(moved_down, static_cast<int>(begin), static_cast<int>(end));
      begin = end;
    }
    return answer(rounds_.front());
  }

 private:
  const Person& at(int place) const { return people_[static_cast<std::size_t>(place)]; }

  bool topscorer(const Person& person) const {
    return last_round_ && person.score > static_cast<int>(played_);
  }
  bool legal(const Person& a, const Person& b) const {
    const bool clash = a.urgency == 3 && b.urgency == 3 && a.wants == b.wants;
    return a.met.count(b.id) == 0 && !(clash && !topscorer(a) && !topscorer(b));
  }

  void list_rounds(std::vector<Pair> pairs, std::vector<bool> used, int bye) {
    const auto free = std::find(used.begin(), used.end(), false);
    if (free == used.end()) {
      rounds_.push_back({std::move(pairs), bye});
      return;
    }
    const int a = static_cast<int>(free - used.begin());
    *free = true;
    if (people_.size() % 2 == 1 && bye < 0 && at(a).may_have_bye) {
      list_rounds(pairs, used, a);
    }
    for (int b = a + 1; b < static_cast<int>(people_.size()); ++b) {
      if (!used[static_cast<std::size_t>(b)] && legal(at(a), at(b))) {
        auto more = pairs;
        more.emplace_back(a, b);
        auto taken = used;
        taken[static_cast<std::size_t>(b)] = true;
        list_rounds(std::move(more), std::move(taken), bye);
      }
    }
  }

  template <class Value>
  void keep_best(Value value) {
    auto best = value(rounds_.front());
    for (const Round& round : rounds_) {
      best = std::min(best, value(round));
    }
    std::erase_if(rounds_, [&](const Round& round) { return best < value(round); });
  }

  // Pairs of the bracket: the lower one is a resident, the higher one a resident or moved down.
  static std::vector<Pair> pairs_in(const Round& round, const std::vector<int>& moved_down,
                                    int begin, int end) {
    std::vector<Pair> inside;
    for (const Pair& pair : round.pairs) {
      const bool high_in = (pair.first >= begin && pair.first < end) ||
                           std::count(moved_down.begin(), moved_down.end(), pair.first) > 0;
      if (high_in && pair.second >= begin && pair.second < end) {
        inside.push_back(pair);
      }
    }
    return inside;
  }
  static std::vector<int> left_over(const std::vector<Pair>& inside,
                                    const std::vector<int>& moved_down, int begin, int end) {
    std::vector<int> left = moved_down;
    for (int place = begin; place < end; ++place) {
      left.push_back(place);
    }
    for (const Pair& pair : inside) {
      std::erase(left, pair.first);
      std::erase(left, pair.second);
    }
    return left;
  }
  std::vector<int> scores(const std::vector<int>& places) const {
    std::vector<int> list;
    for (const int place : places) {
      list.push_back(at(place).score);
    }
    std::sort(list.rbegin(), list.rend());
    return list;
  }

  // '1' when the first breaks.
  char break_of(const Person& a, const Person& b) const {
    const auto turned = [](char side) { return side == '1' ? '2' : '1'; };
    if (a.wants != b.wants) {
      return a.wants != '-' ? a.wants : turned(b.wants);
    }
    if (a.wants == '-') {
      return a.number % 2 == 1 ? '1' : '2';
    }
    const auto claim = [](const Person& p) {
      return std::pair(p.urgency, p.urgency == 3 ? std::abs(p.difference) : 0);
    };
    if (claim(a) != claim(b)) {
      return claim(a) > claim(b) ? a.wants : turned(b.wants);
    }
    for (auto i = a.breaks.rbegin(), j = b.breaks.rbegin();
         i != a.breaks.rend() && j != b.breaks.rend(); ++i, ++j) {
      if (*i != *j) {
        return *j;
      }
    }
    return a.wants;
  }

  // Failures of C10 to C13 of one player who gets `side`.
  static std::array<int, 4> failures(const Person& person, char side) {
    const std::string twice(2, side);
    const int after = person.difference + (side == '1' ? 1 : -1);
    const bool denied = person.wants != '-' && person.wants != side;
    return {after > 2 || after < -2, person.breaks.ends_with(twice), denied,
            denied && person.urgency == 2};
  }

  using Vector = std::vector<std::vector<int>>;

  // C6 to C21, each as a list; less is better.
  Vector quality(const Round& round, const std::vector<int>& moved_down, int begin, int end) const {
    const auto inside = pairs_in(round, moved_down, begin, end);
    const auto down = left_over(inside, moved_down, begin, end);
    Vector vector;
    vector.push_back({static_cast<int>(down.size())});
    vector.push_back(scores(down));
    int next_end = end;
    while (next_end < static_cast<int>(people_.size()) && at(next_end).score == at(end).score) {
      ++next_end;
    }
    const auto next = left_over(pairs_in(round, down, end, next_end), down, end, next_end);
    vector.push_back({static_cast<int>(next.size())});
    vector.push_back(scores(next));
    vector.push_back({down.size() == 1 && down[0] == round.bye ? at(round.bye).unplayed : 0});
    std::array<int, 4> breaks{};
    for (const auto& [a, b] : inside) {
      const char side = break_of(at(a), at(b));
      const auto of_a = failures(at(a), side);
      const auto of_b = failures(at(b), side == '1' ? '2' : '1');
      for (std::size_t i = 0; i < 4; ++i) {
        breaks[i] += of_a[i] + of_b[i];
      }
    }
    for (const int count : breaks) {
      vector.push_back({count});
    }
    append_floats(vector, inside, down, moved_down);
    return vector;
  }

  void append_floats(Vector& vector, const std::vector<Pair>& inside, const std::vector<int>& down,
                     const std::vector<int>& moved_down) const {
    const auto is_moved = [&](int place) {
      return std::count(moved_down.begin(), moved_down.end(), place) > 0;
    };
    for (const auto of : {&Person::float1, &Person::float2}) {
      int residents = 0;
      for (const int place : down) {
        residents += !is_moved(place) && at(place).*of == 'd' ? 1 : 0;
      }
      int opponents = 0;
      for (const auto& [a, b] : inside) {
        opponents += is_moved(a) && at(b).*of == 'u' ? 1 : 0;
      }
      vector.push_back({residents});
      vector.push_back({opponents});
    }
    for (const auto of : {&Person::float1, &Person::float2}) {
      std::vector<int> moved;
      std::vector<int> opponents;
      for (const int place : down) {
        if (is_moved(place) && at(place).*of == 'd') {
          moved.push_back(at(place).score + floated_on);
        }
      }
      for (const auto& [a, b] : inside) {
        if (is_moved(a) && at(a).*of == 'd') {
          moved.push_back(at(a).score - at(b).score);
        }
        if (is_moved(a) && at(b).*of == 'u') {
          opponents.push_back(at(a).score - at(b).score);
        }
      }
      std::sort(moved.rbegin(), moved.rend());
      std::sort(opponents.rbegin(), opponents.rend());
      vector.push_back(moved);
      vector.push_back(opponents);
    }
  }

  std::vector<int> settle_bracket(const std::vector<int>& moved_down, int begin, int end) {
    keep_best([&](const Round& round) { return quality(round, moved_down, begin, end); });
    std::set<std::set<Pair>> kept;
    for (const Round& round : rounds_) {
      const auto inside = pairs_in(round, moved_down, begin, end);
      kept.insert({inside.begin(), inside.end()});
    }
    const std::set<Pair> chosen = first_generated(kept, moved_down, begin, end);
    std::erase_if(rounds_, [&](const Round& round) {
      const auto inside = pairs_in(round, moved_down, begin, end);
      return std::set<Pair>(inside.begin(), inside.end()) != chosen;
    });
    return left_over({chosen.begin(), chosen.end()}, moved_down, begin, end);
  }

  using Visit = std::function<bool(const std::vector<int>&)>;  // true: stop

  // Ordered choices of `size` of `from`, in lexicographic order.
  static bool arrangements(const std::vector<int>& from, std::size_t size, const Visit& visit,
                           std::vector<int> chosen = {}) {
    if (chosen.size() == size) {
      return visit(chosen);
    }
    for (const int place : from) {
      if (std::count(chosen.begin(), chosen.end(), place) == 0) {
        auto more = chosen;
        more.push_back(place);
        if (arrangements(from, size, visit, more)) {
          return true;
        }
      }
    }
    return false;
  }
  static bool subsets(const std::vector<int>& from, std::size_t size, const Visit& visit) {
    return arrangements(from, size, [&](const std::vector<int>& chosen) {
      return std::is_sorted(chosen.begin(), chosen.end()) && visit(chosen);
    });
  }

  struct Exchange {
    std::vector<int> out;  // from S1, ascending
    std::vector<int> in;   // from S2, ascending
  };
  // 4.3: all of them, in their order; the first one exchanges nobody.
  static std::vector<Exchange> exchanges(const std::vector<int>& upper,
                                         const std::vector<int>& lower) {
    std::vector<Exchange> list;
    for (std::size_t size = 0; size <= std::min(upper.size(), lower.size()); ++size) {
      subsets(upper, size, [&](const std::vector<int>& out) {
        subsets(lower, size, [&](const std::vector<int>& in) {
          list.push_back({out, in});
          return false;
        });
        return false;
      });
    }
    const auto key = [](const Exchange& e) {
      std::vector<int> out;
      for (const int number : std::views::reverse(e.out)) {
        out.push_back(-number);
      }
      const int sums = std::accumulate(e.in.begin(), e.in.end(), 0) -
                       std::accumulate(e.out.begin(), e.out.end(), 0);
      return std::tuple(e.out.size(), sums, out, e.in);
    };
    std::sort(list.begin(), list.end(),
              [&](const Exchange& a, const Exchange& b) { return key(a) < key(b); });
    return list;
  }

  static std::set<Pair> with_remainder(const std::set<std::set<Pair>>& kept,
                                       const std::set<Pair>& above,
                                       const std::vector<int>& remainder, std::size_t pairs) {
    const auto half = remainder.begin() + static_cast<std::ptrdiff_t>(pairs);
    const std::vector<int> upper(remainder.begin(), half);
    const std::vector<int> lower(half, remainder.end());
    std::set<Pair> found;
    for (const Exchange& exchange : exchanges(upper, lower)) {
      std::vector<int> s1 = upper;
      std::vector<int> s2 = lower;
      for (const int place : exchange.out) {
        std::erase(s1, place);
        s2.push_back(place);
      }
      for (const int place : exchange.in) {
        std::erase(s2, place);
        s1.push_back(place);
      }
      std::sort(s1.begin(), s1.end());
      std::sort(s2.begin(), s2.end());
      const bool done = arrangements(s2, pairs, [&](const std::vector<int>& opponents) {
        std::set<Pair> candidate = above;
        for (std::size_t i = 0; i < pairs; ++i) {
          candidate.insert(std::minmax(s1[i], opponents[i]));
        }
        if (kept.count(candidate) > 0) {
          found = candidate;
        }
        return !found.empty();
      });
      if (done) {
        break;
      }
    }
    return found;
  }

  // The first in the order of 3.6, 3.7 and 4 that is one of `kept`.
  static std::set<Pair> first_generated(const std::set<std::set<Pair>>& kept,
                                        const std::vector<int>& moved_down, int begin, int end) {
    const std::size_t pairs = kept.begin()->size();
    if (pairs == 0) {
      return {};
    }
    const auto movers_in = [&](const std::set<Pair>& candidate) {
      return static_cast<std::size_t>(
          std::count_if(candidate.begin(), candidate.end(),
                        [&](const Pair& pair) { return pair.first < begin; }));
    };
    const std::size_t movers = movers_in(*kept.begin());
    std::vector<int> residents;
    for (int place = begin; place < end; ++place) {
      residents.push_back(place);
    }
    std::set<Pair> found;
    subsets(moved_down, movers, [&](const std::vector<int>& set) {
      return arrangements(residents, movers, [&](const std::vector<int>& opponents) {
        std::set<Pair> above;
        std::vector<int> remainder = residents;
        for (std::size_t i = 0; i < movers; ++i) {
          above.insert({set[i], opponents[i]});
          std::erase(remainder, opponents[i]);
        }
        const bool hopeful = std::any_of(kept.begin(), kept.end(), [&](const auto& candidate) {
          return std::includes(candidate.begin(), candidate.end(), above.begin(), above.end());
        });
        if (hopeful) {
          found = with_remainder(kept, above, remainder, pairs - movers);
        }
        return !found.empty();
      });
    });
    return found;
  }

  OraclePairing answer(const Round& round) const {
    OraclePairing pairing;
    for (const auto& [a, b] : round.pairs) {
      pairing.pairs.insert(break_of(at(a), at(b)) == '1' ? std::pair(at(a).id, at(b).id)
                                                         : std::pair(at(b).id, at(a).id));
    }
    if (round.bye >= 0) {
      pairing.bye = at(round.bye).id;
    }
    return pairing;
  }

  People people_;
  bool last_round_;
  std::size_t played_;
  std::vector<Round> rounds_;
};

}  // namespace

std::optional<OraclePairing> oracle_pairing(const std::vector<SwissEntry>& entries,
                                            const std::vector<EntryId>& present,
                                            std::uint32_t rounds) {
  std::map<EntryId, SwissEntry> all;
  for (const SwissEntry& entry : entries) {
    all.emplace(entry.id, entry);
  }
  People people;
  for (const EntryId id : present) {
    people.push_back(person_of(all, id));
  }
  const std::size_t played = entries.front().rounds.size();
  return Oracle(std::move(people), played + 1 >= rounds, played).solve();
}

}  // namespace poolhall::tournament
