#include "tests/fault/harness/bad_client.hpp"

#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <stdexcept>
#include <thread>
#include <utility>

#include "clients/load/seen_line.hpp"
#include "protocol/codec.hpp"
#include "tests/fault/harness/end_log.hpp"

namespace poolhall::fault {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds patience{60'000};
constexpr std::size_t flood_lines = 20'000;
constexpr std::size_t unread_lines = 400;
constexpr std::size_t unread_line_bytes = 32'000;
constexpr int others_games = 60;
constexpr int slow_line_bytes = 60;
constexpr milliseconds slow_line{6'000};

// A blocking socket without manners.
class Rude {
 public:
  explicit Rude(std::uint16_t port, int receive_buffer = 0)
      : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    if (receive_buffer > 0) {
      ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
    }
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) {
      throw std::runtime_error("a bad client cannot connect");
    }
    socklen_t size = sizeof address;
    ::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size);
    local_port_ = ntohs(address.sin_port);
  }
  ~Rude() { close(); }
  Rude(const Rude&) = delete;
  Rude& operator=(const Rude&) = delete;

  // What the socket takes; a peer that has closed takes nothing.
  void say(std::string_view bytes) const {
    while (!bytes.empty()) {
      const auto sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (sent <= 0) {
        return;
      }
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
  }
  // What it takes without waiting.
  void push(std::string_view bytes) const {
    static_cast<void>(!::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT));
  }
  // The next line; nothing at the end or after too long a wait.
  std::optional<std::string> hear() {
    for (;;) {
      if (const auto end = heard_.find('\n'); end != std::string::npos) {
        std::string line = heard_.substr(0, end);
        heard_.erase(0, end + 1);
        return line;
      }
      pollfd readable{socket_, POLLIN, 0};
      std::array<char, 65536> buffer{};
      if (::poll(&readable, 1, static_cast<int>(patience.count())) <= 0) {
        return std::nullopt;
      }
      const auto count = ::recv(socket_, buffer.data(), buffer.size(), 0);
      if (count <= 0) {
        return std::nullopt;
      }
      heard_.append(buffer.data(), static_cast<std::size_t>(count));
    }
  }
  // The code of the last error before the server ended the connection.
  std::string last_words() {
    std::string code;
    while (const auto line = hear()) {
      if (const auto data = line->find(R"("data":)"); data != std::string::npos) {
        code = load::word_in(std::string_view(*line).substr(data), "code");
      } else if (load::look_at(*line).kind == load::LineKind::superseded) {
        code = "superseded";
      }
    }
    return code;
  }
  void reset() {
    const linger at_once{1, 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
    close();
  }
  void half_close() const { ::shutdown(socket_, SHUT_WR); }
  void close() {
    if (socket_ >= 0) {
      ::close(std::exchange(socket_, -1));
    }
  }
  [[nodiscard]] std::uint16_t local_port() const { return local_port_; }

 private:
  int socket_;
  std::uint16_t local_port_ = 0;
  std::string heard_;
};

std::string hello_line() {
  protocol::Hello hello;
  hello.name = "bad";
  return protocol::encode_request(1, hello);
}

std::string register_line() {
  static std::atomic<int> visitors{0};
  return protocol::encode_request(
      2, protocol::Register{"bad-" + std::to_string(++visitors), std::nullopt});
}

std::string ping_line(std::int64_t id, std::size_t bytes) {
  return protocol::encode_request(
      id, protocol::Ping{protocol::RawJson{'"' + std::string(bytes, 'x') + '"'}});
}

// Its token; the server's other lines until then are dropped.
std::string log_in(Rude& rude) {
  rude.say(hello_line() + register_line());
  while (const auto line = rude.hear()) {
    if (const auto token = load::word_in(*line, "token"); !token.empty()) {
      return std::string(token);
    }
  }
  throw std::runtime_error("a bad client cannot register");
}

// The client waits until the server has ended the connection, and wants to have been told why.
BadVisit ended_with(Rude& rude, std::string_view code) {
  BadVisit visit{rude.local_port(), std::nullopt};
  const std::string told = rude.last_words();
  if (told != code) {
    visit.fault = "was told \"" + told + "\", not " + std::string(code);
  }
  return visit;
}

BadVisit says_nothing(std::uint16_t port, EndLog&) {
  Rude rude(port);
  return ended_with(rude, "too_slow");
}

BadVisit half_closes(std::uint16_t port, EndLog&) {
  Rude rude(port);
  rude.say(hello_line().substr(0, 20));
  rude.half_close();
  static_cast<void>(rude.last_words());
  return {rude.local_port(), std::nullopt};
}

BadVisit resets_in_mid_line(std::uint16_t port, EndLog&) {
  Rude rude(port);
  static_cast<void>(log_in(rude));
  rude.say(R"({"jsonrpc":"2.0","id":3,"meth)");
  rude.reset();
  return {rude.local_port(), std::nullopt};
}

// Slower than a line may be.
BadVisit drips(std::uint16_t port, EndLog&) {
  Rude rude(port);
  const std::string line = hello_line();
  for (const char byte : line.substr(0, slow_line_bytes)) {
    rude.push({&byte, 1});
    std::this_thread::sleep_for(slow_line / slow_line_bytes);
  }
  return ended_with(rude, "too_slow");
}

// One byte a segment, but in time: this is served as anybody is.
BadVisit comes_in_bytes(std::uint16_t port, EndLog&) {
  Rude rude(port);
  const std::string lines = hello_line() + register_line() + ping_line(3, 3);
  for (const char byte : lines) {
    rude.say({&byte, 1});
  }
  int answers = 0;
  for (std::optional<std::string> line; answers < 3 && (line = rude.hear());) {
    answers += load::look_at(*line).kind == load::LineKind::reply ? 1 : 0;
  }
  return {rude.local_port(),
          answers == 3 ? std::nullopt : std::optional<std::string>("was not answered")};
}

BadVisit sends_many_lines_at_once(std::uint16_t port, EndLog&) {
  Rude rude(port);
  static_cast<void>(log_in(rude));
  std::string lines;
  constexpr int count = 50;
  for (int i = 0; i < count; ++i) {
    lines += ping_line(100 + i, 8);
  }
  rude.say(lines);
  int answers = 0;
  for (std::optional<std::string> line; answers < count && (line = rude.hear());) {
    const load::SeenLine seen = load::look_at(*line);
    if (seen.kind == load::LineKind::reply && seen.id != 100 + answers) {
      return {rude.local_port(), "was answered out of order"};
    }
    answers += seen.kind == load::LineKind::reply ? 1 : 0;
  }
  return {rude.local_port(),
          answers == count ? std::nullopt : std::optional<std::string>("was not answered")};
}

BadVisit floods(std::uint16_t port, EndLog&) {
  Rude rude(port);
  static_cast<void>(log_in(rude));
  std::string lines;
  for (std::size_t i = 0; i < flood_lines; ++i) {
    lines += ping_line(static_cast<std::int64_t>(i) + 10, 1);
  }
  // Somebody has to read meanwhile, or it were a stalled reader.
  std::thread talker([&] { rude.say(lines); });
  BadVisit visit = ended_with(rude, "rate_limited");
  talker.join();
  return visit;
}

std::string much_to_answer() {
  std::string lines;
  for (std::size_t i = 0; i < unread_lines; ++i) {
    lines += ping_line(static_cast<std::int64_t>(i) + 10, unread_line_bytes);
  }
  return lines;
}

// Asks for megabytes and reads nothing. The server says why it ends the connection, after what the
// client's system has taken already.
BadVisit does_not_read(std::uint16_t port, EndLog& log) {
  Rude rude(port, 4096);
  static_cast<void>(log_in(rude));
  rude.say(much_to_answer());
  static_cast<void>(log.await_end(rude.local_port()));  // it stays until then
  return {rude.local_port(), std::nullopt};
}

// The same, where the process that should read is stopped (SIGSTOP). This one only goes on asking
// in its name.
BadVisit is_stopped(std::uint16_t port, EndLog& log) {
  Rude rude(port, 4096);
  static_cast<void>(log_in(rude));
  const std::string lines = much_to_answer();
  const pid_t child = ::fork();
  if (child == 0) {
    rude.say(std::string_view(lines).substr(0, lines.size() / 10));
    ::raise(SIGSTOP);
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, WUNTRACED);
  rude.say(std::string_view(lines).substr(lines.size() / 10));
  static_cast<void>(log.await_end(rude.local_port()));
  ::kill(child, SIGKILL);
  ::waitpid(child, &status, 0);
  return {rude.local_port(), std::nullopt};
}

BadVisit speaks_http(std::uint16_t port, EndLog&) {
  Rude rude(port);
  std::string lines;
  for (int i = 0; i < 8; ++i) {
    lines += "GET / HTTP/1.1\r\nHost: x\r\n\r\n";
  }
  rude.say(lines);
  return ended_with(rude, "too_many_errors");
}

BadVisit speaks_another_version(std::uint16_t port, EndLog&) {
  Rude rude(port);
  protocol::Hello hello;
  hello.name = "bad";
  hello.least_protocol = 90;
  hello.most_protocol = 99;
  rude.say(protocol::encode_request(1, hello));
  return ended_with(rude, "unsupported_protocol");
}

BadVisit sends_no_text(std::uint16_t port, EndLog&) {
  Rude rude(port);
  std::string bytes(30'000, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    bytes[i] = i % 100 == 99 ? '\n' : static_cast<char>(i * 131 + i / 7);
  }
  rude.say(bytes);
  return ended_with(rude, "too_many_errors");
}

// Its first connection is superseded by its second.
BadVisit logs_in_twice(std::uint16_t port, EndLog&) {
  Rude first(port);
  const std::string token = log_in(first);
  Rude second(port);
  second.say(hello_line() + protocol::encode_request(2, protocol::Login{{token}}));
  return ended_with(first, "superseded");
}

// Each reaches a bound of the JSON that is read, on and on.
BadVisit nests_deeply(std::uint16_t port, EndLog&) {
  Rude rude(port);
  std::string lines;
  for (int i = 0; i < 20; ++i) {
    lines += R"({"jsonrpc":"2.0","id":1,"method":"ping","params":{"t":)" + std::string(3'000, '[') +
             '\n';
  }
  rude.say(lines);
  return ended_with(rude, "too_many_errors");
}

BadVisit repeats_keys(std::uint16_t port, EndLog&) {
  Rude rude(port);
  std::string line = R"({"jsonrpc":"2.0","id":1,"method":"ping","params":{)";
  for (int i = 0; i < 200; ++i) {
    line += "\"t\":1,";
  }
  line.back() = '}';
  line += "}\n";
  for (int i = 0; i < 20; ++i) {
    rude.say(line);
  }
  return ended_with(rude, "too_many_errors");
}

// Long lines with short answers, and far more of them than are answered.
BadVisit floods_with_long_lines(std::uint16_t port, EndLog&) {
  Rude rude(port);
  static_cast<void>(log_in(rude));
  std::string line = protocol::encode_request(10, protocol::Sync{protocol::GameId{1'000'000}});
  line.insert(1, "\"pad\":\"" + std::string(16'000, 'x') + "\",");
  std::thread talker([&] {
    for (std::size_t i = 0; i < 20'000; ++i) {
      rude.say(line);
    }
  });
  BadVisit visit = ended_with(rude, "rate_limited");
  talker.join();
  return visit;
}

BadVisit comes_and_goes(std::uint16_t port, EndLog&) {
  for (int i = 0; i < 300; ++i) {
    const Rude rude(port);
    rude.push(hello_line());
  }
  Rude rude(port);
  rude.say(hello_line());
  const auto greeting = rude.hear();
  return {rude.local_port(),
          greeting ? std::nullopt : std::optional<std::string>("was not answered")};
}

// One agent, logged in again and again; only the last one stays.
BadVisit storms_in(std::uint16_t port, EndLog&) {
  Rude first(port);
  const std::string login = protocol::encode_request(2, protocol::Login{{log_in(first)}});
  for (int i = 0; i < 100; ++i) {
    Rude again(port);
    again.say(hello_line() + login);
    static_cast<void>(again.hear());
  }
  return ended_with(first, "superseded");
}

BadVisit challenges_without_end(std::uint16_t port, EndLog&) {
  Rude rude(port);
  Rude bold(port);
  const std::string name = "challenged-" + std::to_string(rude.local_port());
  rude.say(hello_line() + protocol::encode_request(2, protocol::Register{name, {}}));
  static_cast<void>(rude.hear());
  static_cast<void>(rude.hear());
  static_cast<void>(log_in(bold));
  protocol::Challenge challenge;
  challenge.opponent = name;
  std::string lines;
  for (int i = 0; i < 400; ++i) {
    lines += protocol::encode_request(10 + i, challenge);
  }
  bold.say(lines);
  int offers = 0;
  for (int answers = 0; answers < 400;) {
    const auto line = bold.hear();
    if (!line) {
      return {bold.local_port(), "was not answered"};
    }
    const load::SeenLine seen = load::look_at(*line);
    answers += seen.id >= 10 ? 1 : 0;
    offers += seen.id >= 10 && seen.kind == load::LineKind::reply ? 1 : 0;
  }
  return {bold.local_port(),
          offers <= 64
              ? std::nullopt
              : std::optional<std::string>("made " + std::to_string(offers) + " offers at a time")};
}

BadVisit plays_others_games(std::uint16_t port, EndLog&) {
  Rude rude(port);
  static_cast<void>(log_in(rude));
  protocol::Shot shot;
  shot.turn = 1;
  shot.shot_id = {"\"mine\""};
  shot.params = {.a = 0, .b = 0, .theta = 20, .phi = 90, .v = 3};
  for (std::int64_t game = 1; game <= others_games / 3; ++game) {
    shot.game = protocol::GameId{game};
    rude.say(protocol::encode_request(3 * game + 1, shot) +
             protocol::encode_request(3 * game + 2, protocol::Concede{shot.game}) +
             protocol::encode_request(3 * game + 3, protocol::Sync{shot.game}));
  }
  int refused = 0;
  while (refused < others_games) {
    const auto line = rude.hear();
    if (!line) {
      return {rude.local_port(), "was not answered"};
    }
    const load::LineKind kind = load::look_at(*line).kind;
    if (kind == load::LineKind::reply) {
      return {rude.local_port(), "may play another's game: " + line->substr(0, 100)};
    }
    refused += kind == load::LineKind::error ? 1 : 0;
  }
  return {rude.local_port(), std::nullopt};
}

}  // namespace

const std::vector<BadClient>& bad_clients() {
  static const std::vector<BadClient> all{
      {"half-open: says nothing", "too_slow", says_nothing},
      {"closes its sending half in mid-line", "the connection has ended", half_closes},
      {"resets in mid-line", "the connection has ended", resets_in_mid_line},
      {"one byte at a time, too slowly", "too_slow", drips},
      {"one byte at a time, in time", "the connection has ended", comes_in_bytes},
      {"many lines in one segment", "the connection has ended", sends_many_lines_at_once},
      {"floods", "rate_limited", floods},
      {"asks for much and does not read", "unread_output", does_not_read},
      {"is stopped (SIGSTOP) and does not read", "unread_output", is_stopped},
      {"speaks HTTP", "too_many_errors", speaks_http},
      {"speaks another version", "unsupported_protocol", speaks_another_version},
      {"sends what is no text", "too_many_errors", sends_no_text},
      {"logs in twice", "superseded", logs_in_twice},
      {"plays others' games", "the connection has ended", plays_others_games},
      {"nests arrays by thousands", "too_many_errors", nests_deeply},
      {"gives a key twice", "too_many_errors", repeats_keys},
      {"floods with the longest lines", "rate_limited", floods_with_long_lines},
      // Any reason: a server that is late to look finds no login in time.
      {"comes and goes", "", comes_and_goes},
      {"logs in over and over", "superseded", storms_in},
      {"challenges without an end", "the connection has ended", challenges_without_end},
  };
  return all;
}

protocol::Limits limits_for_bad_clients() {
  protocol::Limits limits;
  // Long enough for the others where the machine is full.
  limits.login_deadline = milliseconds{6'000};
  limits.line_deadline = slow_line / 2;
  limits.output_queue_bytes = 1024 * 1024;
  limits.input_bytes_per_second = 64 * 1024 * 1024;
  limits.message_burst = 1'000;
  limits.connections_per_address = 10'000;
  limits.takeover_interval = milliseconds{0};
  return limits;
}

}  // namespace poolhall::fault
