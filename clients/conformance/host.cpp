// The host's connection: events, lines, coming and going. host_clerk.cpp answers requests,
// host_games.cpp deals with games.
#include "clients/conformance/host.hpp"

#include <poll.h>

#include <algorithm>
#include <array>
#include <thread>

#include "clients/cpp/token.hpp"

namespace poolhall::conformance {

using protocol::ErrorCode;

namespace {

// A bot that floods is stopped here.
constexpr int most_lines = 3'000;
// Longer lines go in crumbs where byte by byte was wanted: the pace must not cost minutes.
constexpr std::size_t byte_by_byte_bound = 6'000;
// How long a bot without a challenge is waited for to make one.
constexpr milliseconds challenge_time{150};
// From a closed connection to the end of its process.
constexpr milliseconds dying_time{300};

std::string seconds(milliseconds time) {
  std::string text = std::to_string(static_cast<double>(time.count()) / 1000.0);
  return text.substr(0, text.find('.') + 2) + " s";
}

}  // namespace

std::string with_unknown_members(std::string_view line) {
  constexpr std::string_view added = R"("x_later":{"ball":"ü😀","n":[1e-7,null,true,{"deep":[]}]})";
  std::string garnished;
  bool in_string = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    garnished.push_back(line[i]);
    if (in_string && line[i] == '\\') {
      garnished.push_back(line[++i]);
    } else if (line[i] == '"') {
      in_string = !in_string;
    } else if (!in_string && line[i] == '{') {
      garnished += added;
      if (line[i + 1] != '}') {
        garnished.push_back(',');
      }
    }
  }
  return garnished;
}

Host::Host(const HostOptions& options, Bot& bot, Conduct& conduct)
    : options_(options),
      bot_(bot),
      conduct_(conduct),
      token_(client::random_token()),
      server_("127.0.0.1:" + std::to_string(doorway_.port())) {
  names_[token_.text] = "under-test";
}

// ---- Events ----

Happening Host::next(Instant deadline) {
  while (true) {
    if (auto happening = line_came()) {
      return *std::move(happening);
    }
    if (auto happening = wait_for_io(deadline)) {
      return *std::move(happening);
    }
  }
}

// Deals with the lines that are there.
std::optional<Happening> Host::line_came() {
  while (link_) {
    const Link::Got got = link_->take_line();
    switch (got.kind) {
      case Link::Kind::nothing:
        return std::nullopt;
      case Link::Kind::closed:
        transcript_.note("the bot has closed the connection");
        link_.reset();
        return Happening{.kind = Happening::Kind::closed};
      case Link::Kind::too_long:
        transcript_.note("a line beyond the limit");
        broke(duties::line_length, Verdict::failure, "a line beyond the limit");
        refuse({}, {ErrorCode::line_too_long, "", "the line is longer than the limit"});
        break;
      case Link::Kind::line:
        break;
    }
    if (got.kind != Link::Kind::line) {
      continue;
    }
    if (++lines_read_ > most_lines) {
      throw Stop{Verdict::failure, "it floods: " + std::to_string(most_lines) + " lines"};
    }
    transcript_.bot(got.line);
    conduct_.seen(duties::line_length);
    const auto incoming = protocol::decode_request(got.line, limits_);
    if (!incoming) {
      const protocol::BadLine& bad = incoming.error();
      broke(duties::valid_requests, Verdict::failure,
            std::string(protocol::name(bad.error.code)) + " " + bad.error.field + ": " +
                bad.error.reason);
      refuse(bad.id, bad.error);
      continue;
    }
    conduct_.seen(duties::valid_requests);
    if (auto happening = take(*incoming)) {
      return happening;
    }
  }
  return std::nullopt;
}

std::optional<Happening> Host::wait_for_io(Instant deadline) {
  if (Clock::now() > begin_ + options_.bound) {
    throw Stop{Verdict::not_reached, "the check's " + seconds(options_.bound) + " were over"};
  }
  const auto left = std::chrono::ceil<milliseconds>(deadline - Clock::now());
  if (left.count() <= 0) {
    return Happening{};
  }
  std::array<pollfd, 2> waiting{{{link_ ? link_->descriptor() : doorway_.descriptor(), POLLIN, 0},
                                 {bot_.exit_descriptor(), POLLIN, 0}}};
  static_cast<void>(::poll(waiting.data(), waiting.size(), static_cast<int>(left.count())));
  if (waiting[0].revents != 0) {
    if (!link_) {
      connected(doorway_.take(limits_.line_bytes_before_login));
    }
    return std::nullopt;
  }
  if (waiting[1].revents != 0) {
    Happening ended{.kind = Happening::Kind::ended, .answer = {}, .how = bot_.end()};
    transcript_.note("the bot has ended: " + ended.how);
    link_.reset();
    return ended;
  }
  return std::nullopt;
}

void Host::connected(std::unique_ptr<Link> link) {
  if (!link) {
    return;
  }
  transcript_.note("the bot has connected");
  link_ = std::move(link);
  stage_ = Stage::silent;
  login_refused_ = false;
  seq_ = 0;
  probes_.clear();
}

void Host::give_up(const Happening& happening, const std::string& wanted) {
  std::string why = "it said nothing";
  std::string how = happening.how;
  if (happening.kind == Happening::Kind::closed) {
    why = "it closed the connection";
    const Happening last = next(Clock::now() + dying_time);
    how = last.how;
  }
  if (!how.empty()) {
    why = "it ended (" + how + ")";
  }
  throw Stop{Verdict::failure, why + " instead of " + wanted};
}

// ---- Coming and going ----

bool Host::log_in_until(Instant deadline) {
  while (true) {
    Happening happening = next(deadline);
    switch (happening.kind) {
      case Happening::Kind::logged_in:
        return true;
      case Happening::Kind::ended:
      case Happening::Kind::silence:
        return false;
      case Happening::Kind::answer:
        kept_.push_back(*std::move(happening.answer));
        break;
      case Happening::Kind::closed:
        break;  // it may connect again
    }
  }
}

void Host::arrive(Verdict absent) {
  bot_.start(server_, token_.text);
  transcript_.note("the bot is started; the server is " + server_);
  if (!log_in_until(Clock::now() + options_.patience)) {
    throw Stop{absent, bot_.runs() ? "it did not log in within " + seconds(options_.patience)
                                   : "it ended without a login"};
  }
  const Instant deadline = Clock::now() + challenge_time;
  while (!challenge_ && link_ && Clock::now() < deadline) {
    serve_for(milliseconds{20});
  }
}

void Host::expect_return() {
  constexpr int most_starts = 3;
  const std::string before = identity_;
  bool came = log_in_until(Clock::now() + options_.patience);
  for (int starts = 0; !came && !bot_.runs() && starts < most_starts; ++starts) {
    transcript_.note("it is started again, as a tournament does");
    bot_.start(server_, token_.text);
    came = log_in_until(Clock::now() + options_.patience);
  }
  if (!came && !bot_.runs()) {
    throw Stop{Verdict::failure, "started again and again, it ended without a login"};
  }
  if (!came) {
    throw Stop{Verdict::failure,
               "it runs on and did not come back within " + seconds(options_.patience)};
  }
  if (identity_ != before) {
    throw Stop{Verdict::warning,
               "it comes back as another agent: the game that goes on is lost by its clock"};
  }
}

bool Host::comes_back_within(milliseconds time) {
  const Instant deadline = Clock::now() + time;
  while (Clock::now() < deadline) {
    const Happening happening = next(deadline);
    if (link_) {
      return true;
    }
    if (happening.kind == Happening::Kind::ended) {
      return false;
    }
  }
  return link_ != nullptr;
}

void Host::cut(Cut how) {
  if (link_ && how == Cut::reset) {
    link_->reset();
  } else if (link_) {
    link_->finish();
  }
  transcript_.note(how == Cut::reset ? "the server resets the connection"
                                     : "the server closes the connection");
  link_.reset();
  kept_.clear();
}

void Host::stay_away(milliseconds time) {
  transcript_.note("the server is away: connections are refused for " + seconds(time));
  doorway_.shut();
  std::this_thread::sleep_for(time);
  doorway_.open();
  transcript_.note("the server is back");
}

int Host::turn_away(const protocol::Error& error, milliseconds time) {
  const Instant deadline = Clock::now() + time;
  int times = 0;
  while (Clock::now() < deadline && bot_.runs()) {
    pollfd waiting{doorway_.descriptor(), POLLIN, 0};
    if (::poll(&waiting, 1, 20) > 0) {
      if (const auto link = doorway_.take(limits_.line_bytes_before_login)) {
        const std::string line = protocol::encode_error({}, error);
        transcript_.note("the bot has connected and is turned away");
        transcript_.server(line);
        link->send(line, Pace::whole);
        ++times;
      }
    }
  }
  return times;
}

// ---- Lines ----

void Host::send_raw(const std::string& line) {
  transcript_.server(line);
  if (!link_) {
    return;
  }
  if (holding_) {
    held_ += line;
    return;
  }
  const bool is_long = pace_ == Pace::byte_by_byte && line.size() > byte_by_byte_bound;
  link_->send(line, is_long ? Pace::crumbs : pace_);
}

void Host::flush() {
  holding_ = false;
  if (link_) {
    link_->send(held_, pace_);
  }
  held_.clear();
}

std::string Host::encoded(const protocol::Notification<Outgoing>& notification) {
  std::string line = protocol::encode_notification(notification, next_seq());
  return garnish_ == Garnish::none ? line : with_unknown_members(line);
}

void Host::push(const protocol::Notification<Outgoing>& notification) {
  send_raw(encoded(notification));
}

void Host::reply(const protocol::RequestId& id, const protocol::Reply<Outgoing>& reply) {
  const std::string line = protocol::encode_reply(id, reply);
  send_raw(garnish_ == Garnish::none ? line : with_unknown_members(line));
}

void Host::refuse(const protocol::RequestId& id, const protocol::Error& error) {
  const std::string line = protocol::encode_error(id, error);
  send_raw(garnish_ == Garnish::none ? line : with_unknown_members(line));
}

void Host::serve_for(milliseconds time) {
  const Instant deadline = Clock::now() + time;
  while (true) {
    Happening happening = next(deadline);
    if (happening.kind == Happening::Kind::answer) {
      kept_.push_back(*std::move(happening.answer));
    } else if (happening.kind != Happening::Kind::logged_in) {
      return;
    }
  }
}

void Host::demand(std::string_view duty) const {
  const Outcome outcome = conduct_.outcome(duty);
  if (outcome.verdict == Verdict::failure) {
    throw Stop{Verdict::failure, outcome.why};
  }
}

void Host::broke(std::string_view duty, Verdict verdict, std::string why) {
  conduct_.broke(duty, verdict, std::move(why), transcript_.tail(6));
}

}  // namespace poolhall::conformance
