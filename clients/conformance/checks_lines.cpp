// Checks of lines and JSON: what a reader has to put up with.
#include <string>

#include "clients/conformance/checks.hpp"

namespace poolhall::conformance {
namespace {

constexpr std::string_view lines_section = "Lines";

void play_two_turns(Host& host) {
  HostedGame& game = host.begin({});
  host.play_turn(game);
  host.play_opponent(game);
  host.play_turn(game);
}

void push_unknown(Host& host) {
  host.send_raw(R"({"jsonrpc":"2.0","method":"weather.report","params":{"seq":)" +
                std::to_string(host.next_seq()) +
                R"(,"rain":true,"game":1,"turn":1,"kind":"decision"}})"
                "\n");
}

void ignores_members(Host& host) {
  host.set_garnish(Host::Garnish::unknown_members);
  host.arrive();
  play_two_turns(host);
}

void ignores_notifications(Host& host) {
  host.arrive();
  push_unknown(host);
  HostedGame& game = host.begin({});
  push_unknown(host);
  host.hand_turn(game);
  push_unknown(host);
  const auto accepted = host.acceptable(game);
  push_unknown(host);
  host.finish(accepted);
  host.play_opponent(game);
  host.play_turn(game);
}

void reads_at_pace(Host& host, Pace pace) {
  host.set_pace(pace);
  host.arrive();
  play_two_turns(host);
}

void reads_many_lines_at_once(Host& host) {
  constexpr int lines = 40;
  host.arrive();
  host.hold();
  HostedGame& game = host.begin({});
  for (int line = 0; line < lines; ++line) {
    host.probe(time_ms());
    push_unknown(host);
  }
  host.push(game.snapshot());
  host.hand_turn(game);
  host.flush();
  host.finish(host.acceptable(game));
  host.play_opponent(game);
  host.play_turn(game);
}

// A turn in a line of exactly as many bytes as the server's lines may have.
void reads_the_longest_line(Host& host) {
  host.arrive();
  HostedGame& game = host.begin({});
  host.note_handed(game);
  std::string line = host.encoded(game.turn());
  const std::string params = R"("params":{)";
  const std::string member = R"("x_padding":"",)";
  const std::size_t length = line.size() - 1 + member.size();
  const std::string padding(protocol::Limits{}.server_line_bytes - length, 'x');
  line.insert(line.find(params) + params.size(), R"("x_padding":")" + padding + R"(",)");
  host.send_raw(line);
  host.finish(host.acceptable(game));
}

// A log that does not fit into a line comes empty.
void takes_an_empty_log(Host& host) {
  host.arrive();
  HostedGame& game = host.begin({});
  host.hand_turn(game);
  if (auto accepted = host.acceptable(game)) {
    host.store(*accepted);
    if (auto* shot = std::get_if<protocol::GameShot<Outgoing>>(&accepted->played.told)) {
      shot->events.text = "[]";
    }
    host.reply_to(*accepted);
  }
  host.play_opponent(game);
  host.play_turn(game);
}

// The shots of two games are answered in the other order.
void takes_replies_in_any_order(Host& host) {
  host.arrive();
  HostedGame& first = host.begin({});
  HostedGame& second = host.begin({});
  host.hold();
  host.hand_turn(first);
  host.hand_turn(second);
  host.flush();
  const auto one = host.acceptable(first);
  const auto two = host.acceptable(second);
  if (!one || !two) {
    throw Stop{Verdict::not_reached, "its shots were refused"};
  }
  host.store(*one);
  host.store(*two);
  host.reply_to(*two);
  host.reply_to(*one);
  for (HostedGame* game : {&first, &second}) {
    host.play_opponent(*game);
    host.play_turn(*game);
  }
}

}  // namespace

std::vector<Script> line_scripts() {
  return {
      {{"unknown-members", "members that the page has not are ignored, in every object",
        lines_section},
       ignores_members},
      {{"unknown-notifications", "notifications that the page has not are ignored", lines_section},
       ignores_notifications},
      {{"slow-bytes", "lines that come byte by byte are read", lines_section},
       [](Host& host) { reads_at_pace(host, Pace::byte_by_byte); }},
      {{"split-segments", "lines that come in pieces of seven bytes are read", lines_section},
       [](Host& host) { reads_at_pace(host, Pace::crumbs); }},
      {{"many-lines-at-once", "many lines in one segment are read one by one", lines_section},
       reads_many_lines_at_once},
      {{"longest-line", "a line of limits.server_line_bytes is read", lines_section},
       reads_the_longest_line},
      {{"empty-events", "a reply whose events did not fit is taken", "State"}, takes_an_empty_log},
      {{"replies-in-any-order", "replies go by their ids, not by their order", lines_section},
       takes_replies_in_any_order},
  };
}

}  // namespace poolhall::conformance
