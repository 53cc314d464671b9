#include "server/tournament/render.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace poolhall::tournament {
namespace {

constexpr std::size_t bar_width = 24;

// A table as columns of words; the first `left` columns are flush left, the rest flush right.
class TextTable {
 public:
  explicit TextTable(std::size_t left) : left_(left) {}

  void add(std::vector<std::string> cells) {
    widths_.resize(std::max(widths_.size(), cells.size()), 0);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      widths_[i] = std::max(widths_[i], cells[i].size());
    }
    rows_.push_back(std::move(cells));
  }

  [[nodiscard]] std::string text() const {
    std::string all;
    for (const auto& row : rows_) {
      std::string line;
      for (std::size_t i = 0; i < row.size(); ++i) {
        line += i == 0 ? "" : "  ";
        line += i < left_ ? fmt::format("{:<{}}", row[i], widths_[i])
                          : fmt::format("{:>{}}", row[i], widths_[i]);
      }
      line.erase(line.find_last_not_of(' ') + 1);
      all += line + '\n';
    }
    return all;
  }

 private:
  std::size_t left_;
  std::vector<std::size_t> widths_;
  std::vector<std::vector<std::string>> rows_;
};

// 7, 7.5, 12.25.
std::string points_text(double points) {
  if (points == std::floor(points)) {
    return fmt::format("{:.0f}", points);
  }
  return points * 2 == std::floor(points * 2) ? fmt::format("{:.1f}", points)
                                              : fmt::format("{:.2f}", points);
}

std::string estimate_text(const ratings::Estimate& estimate) {
  const double elo = std::round(estimate.elo) + 0.0;  // of -0.2 +0, not -0
  return fmt::format("{:+.0f} +/- {:.0f}", elo, estimate.margin);
}

std::string rating_text(const ratings::PlayerRating& rating) {
  switch (rating.status) {
    case ratings::RatingStatus::rated:
      return estimate_text(*rating.rated);
    case ratings::RatingStatus::no_games:
      return "-";
    case ratings::RatingStatus::won_everything:
      return "won all";
    case ratings::RatingStatus::lost_everything:
      return "lost all";
    case ratings::RatingStatus::unconnected:
      return "unconnected";
  }
  return "-";
}

std::string_view heading(TieBreak tie_break) {
  switch (tie_break) {
    case TieBreak::direct_encounter:
      return "Direct";
    case TieBreak::buchholz_cut1:
      return "Bh-C1";
    case TieBreak::buchholz:
      return "Bh";
    case TieBreak::sonneborn_berger:
      return "S-B";
    case TieBreak::wins:
      return "Wins";
  }
  return "";
}

std::vector<std::string> standings_row(const StandingsRow& row, const Names& names) {
  std::vector<std::string> cells{fmt::format("{}", row.rank),  names[index(row.entry)],
                                 points_text(row.points),      fmt::format("{}", row.games()),
                                 fmt::format("{}", row.wins),  fmt::format("{}", row.losses),
                                 fmt::format("{}", row.draws), rating_text(row.rating)};
  if (row.ladder) {
    cells.push_back(fmt::format("{:.0f}", row.ladder->rating));
    cells.push_back(fmt::format("{:.0f}", row.ladder->deviation));
  }
  for (const double value : row.tie_breaks) {
    cells.push_back(points_text(value));
  }
  return cells;
}

std::string notes(const Standings& table) {
  std::string text;
  std::set<std::size_t> groups;
  bool unbounded = false;
  for (const StandingsRow& row : table.rows) {
    if (row.rating.rated) {
      groups.insert(row.rating.group);
    } else if (row.games() > 0) {
      unbounded = true;
    }
  }
  if (!groups.empty()) {
    text +=
        table.break_advantage
            ? fmt::format("Advantage of the break: {} Elo.", estimate_text(*table.break_advantage))
            : std::string("These games do not tell the advantage of the break.");
    text += " Elo by maximum likelihood, mean 0, with 95 % intervals.\n";
  }
  if (groups.size() > 1) {
    text +=
        "Not all entries can be compared: each group of them has an Elo mean of 0 of its own.\n";
  }
  if (unbounded && !groups.empty()) {
    text += "No finite Elo: who won or lost every game against those with one.\n";
  }
  return text;
}

}  // namespace

std::string standings_text(const Standings& table, const Names& names) {
  TextTable text(2);
  std::vector<std::string> head{"#", "Entry", "Points", "Games", "W", "L", "D", "Elo"};
  if (table.has_ladder) {
    head.insert(head.end(), {"Glicko-2", "Dev"});
  }
  for (const TieBreak tie_break : table.tie_breaks) {
    head.emplace_back(heading(tie_break));
  }
  text.add(std::move(head));
  for (const StandingsRow& row : table.rows) {
    text.add(standings_row(row, names));
  }
  return text.text() + notes(table);
}

std::string crosstable_text(const Crosstable& cross, const Standings& table, const Names& names) {
  TextTable text(2);
  std::vector<std::string> head{"#", "Entry"};
  for (std::size_t column = 1; column <= table.rows.size(); ++column) {
    head.push_back(fmt::format("{}", column));
  }
  text.add(std::move(head));
  for (std::size_t line = 0; line < table.rows.size(); ++line) {
    const EntryId entry = table.rows[line].entry;
    std::vector<std::string> cells{fmt::format("{}", line + 1), names[index(entry)]};
    for (const StandingsRow& opponent : table.rows) {
      const CrosstableCell& cell = cross.at(entry, opponent.entry);
      cells.push_back(cell.games == 0 ? std::string(opponent.entry == entry ? "x" : "-")
                                      : fmt::format("{}/{}", points_text(cell.points), cell.games));
    }
    text.add(std::move(cells));
  }
  return text.text();
}

std::string endings_text(const Standings& table) {
  std::vector<std::string> parts;
  for (const auto& [reason, games] : table.endings) {
    std::string words(rules::name(reason));
    std::replace(words.begin(), words.end(), '_', ' ');
    parts.push_back(fmt::format("{} {}", words, games));
  }
  return parts.empty() ? "Games ended: none yet\n"
                       : fmt::format("Games ended: {}\n", fmt::join(parts, ", "));
}

std::string progress_text(const Progress& progress) {
  const std::size_t full =
      progress.total == 0 ? bar_width : bar_width * progress.finished / progress.total;
  const std::string left = progress.remaining
                               ? fmt::format("about {} left", duration_text(*progress.remaining))
                               : std::string("no game over yet");
  return fmt::format("[{:#<{}}{:.<{}}] {}/{} games, {} running, {} gone, {}", "", full, "",
                     bar_width - full, progress.finished, progress.total, progress.running,
                     duration_text(progress.elapsed), left);
}

std::string duration_text(Seconds duration) {
  const long long seconds = std::llround(std::max(0.0, duration.count()));
  if (seconds >= 3600) {
    return fmt::format("{}:{:02}:{:02}", seconds / 3600, seconds / 60 % 60, seconds % 60);
  }
  return fmt::format("{}:{:02}", seconds / 60, seconds % 60);
}

}  // namespace poolhall::tournament
