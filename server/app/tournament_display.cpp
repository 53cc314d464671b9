#include "server/app/tournament_display.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string_view>
#include <utility>
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

TournamentDisplay::TournamentDisplay(std::function<void()> ask)
    : in_place_(is_terminal()),
      ask_(std::move(ask)),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

TournamentDisplay::~TournamentDisplay() {
  close();
}

void TournamentDisplay::changed() {
  const std::lock_guard lock(mutex_);
  has_changed_ = true;
}

void TournamentDisplay::show(net::TournamentView view) {
  {
    const std::lock_guard lock(mutex_);
    latest_ = std::move(view);
  }
  woken_.notify_one();
}

void TournamentDisplay::close(const std::optional<net::TournamentView>& last) {
  thread_.request_stop();
  if (thread_.joinable()) {
    thread_.join();
    if (last && !in_place_) {
      print_new_games(*last);
    }
  }
}

// What is asked for when something has changed; nothing when nothing has.
std::optional<net::TournamentView> TournamentDisplay::next_view(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  if (!std::exchange(has_changed_, false)) {
    return std::nullopt;
  }
  lock.unlock();
  ask_();
  lock.lock();
  woken_.wait(lock, stop, [this] { return latest_.has_value(); });
  return std::exchange(latest_, std::nullopt);
}

void TournamentDisplay::run(const std::stop_token& stop) {
  std::optional<net::TournamentView> shown;
  while (!stop.stop_requested()) {
    const auto began = std::chrono::steady_clock::now();
    if (auto next = next_view(stop)) {
      shown = std::move(next);
    }
    if (shown) {
      draw(*shown);
    }
    const auto took = std::chrono::steady_clock::now() - began;
    std::unique_lock lock(mutex_);
    woken_.wait_for(lock, stop, std::max<std::chrono::nanoseconds>(redraw_interval, 10 * took),
                    [] { return false; });
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
