#include "server/app/tournament_display.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "server/tournament/render.hpp"

namespace poolhall::app {
namespace {

using namespace std::chrono_literals;

constexpr auto redraw_interval = 500ms;

bool is_terminal() {
  const char* kind = std::getenv("TERM");
  return isatty(STDOUT_FILENO) == 1 && kind != nullptr && std::string_view(kind) != "dumb";
}

struct Size {
  std::size_t lines = 24;
  std::size_t columns = 80;
};

Size terminal_size() {
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_row == 0 || size.ws_col == 0) {
    return {};
  }
  return {size.ws_row, size.ws_col};
}

// The lines of a text, cut where the terminal would wrap them.
std::vector<std::string> cut_lines(const std::string& text, const Size& size) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line) && lines.size() + 3 < size.lines;) {
    lines.push_back(line.substr(0, size.columns - 1));
  }
  return lines;
}

std::string result_text(const tournament::PlayedGame& game, const tournament::Names& names) {
  std::string reason(rules::name(game.reason));
  std::replace(reason.begin(), reason.end(), '_', ' ');
  if (!game.winner) {
    return fmt::format("{} and {} drew ({})", names[index(game.breaker)], names[index(game.other)],
                       reason);
  }
  const auto loser = *game.winner == game.breaker ? game.other : game.breaker;
  return fmt::format("{} beat {} ({})", names[index(*game.winner)], names[index(loser)], reason);
}

void print(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stdout);
  std::fflush(stdout);
}

}  // namespace

TournamentDisplay::TournamentDisplay()
    : in_place_(is_terminal()), thread_([this](const std::stop_token& stop) { run(stop); }) {}

TournamentDisplay::~TournamentDisplay() {
  close();
}

void TournamentDisplay::show(const net::TournamentView& view) {
  {
    const std::lock_guard lock(mutex_);
    latest_ = view;
    is_new_ = true;
  }
  changed_.notify_one();
}

void TournamentDisplay::close() {
  thread_.request_stop();
  if (thread_.joinable()) {
    thread_.join();
  }
}

void TournamentDisplay::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    std::optional<net::TournamentView> view;
    {
      std::unique_lock lock(mutex_);
      changed_.wait_for(lock, stop, redraw_interval, [this] { return is_new_; });
      is_new_ = false;
      view = latest_;
    }
    if (view) {
      draw(*view);
    }
  }
  erase();
}

void TournamentDisplay::draw(const net::TournamentView& view) {
  if (in_place_) {
    draw_in_place(view);
  } else {
    print_new_games(view);
  }
}

void TournamentDisplay::draw_in_place(const net::TournamentView& view) {
  const Size size = terminal_size();
  const auto now = std::chrono::steady_clock::now();
  std::vector<std::string> lines =
      cut_lines(tournament::standings_text(net::standings_of(view), view.names), size);
  lines.push_back(
      tournament::progress_text(net::progress_of(view, now)).substr(0, size.columns - 1));
  erase();
  std::string text;
  for (const std::string& line : lines) {
    text += line + '\n';
  }
  print(text);
  lines_drawn_ = lines.size();
}

void TournamentDisplay::print_new_games(const net::TournamentView& view) {
  std::string text;
  for (const tournament::PlayedGame& game : view.games) {
    if (printed_.insert({game.pairing, game.number}).second) {
      text += result_text(game, view.names) + '\n';
    }
  }
  if (!text.empty()) {
    const auto now = std::chrono::steady_clock::now();
    print(text + tournament::progress_text(net::progress_of(view, now)) + '\n');
  }
}

// Moves the cursor to the first of the lines drawn last and clears from there (ECMA-48: CPL, ED).
void TournamentDisplay::erase() {
  if (lines_drawn_ > 0) {
    print(fmt::format("\x1b[{}F\x1b[J", lines_drawn_));
    lines_drawn_ = 0;
  }
}

}  // namespace poolhall::app
