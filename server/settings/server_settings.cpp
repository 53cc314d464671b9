#include "server/settings/server_settings.hpp"

#include "server/settings/files.hpp"
#include "server/settings/keys.hpp"

namespace poolhall::settings {
namespace {

// How far the limits may be moved; the defaults are those of protocol/limits.hpp.
constexpr std::int64_t kib = 1024;
constexpr std::int64_t mib = 1024 * kib;

void add_line_limits(Keys<ServerSettings>& keys) {
  keys.add(
      "limits.line_bytes", WholeNumber{kib, mib},
      [](auto& s) -> auto& { return s.limits.line_bytes; });
  keys.add(
      "limits.line_bytes_before_login", WholeNumber{kib, mib},
      [](auto& s) -> auto& { return s.limits.line_bytes_before_login; });
  keys.add(
      "limits.server_line_bytes", WholeNumber{64 * kib, 64 * mib},
      [](auto& s) -> auto& { return s.limits.server_line_bytes; });
  keys.add(
      "limits.nesting", WholeNumber{8, 64}, [](auto& s) -> auto& { return s.limits.nesting; });
  keys.add(
      "limits.keys", WholeNumber{32, 4096}, [](auto& s) -> auto& { return s.limits.keys; });
  keys.add(
      "limits.login_seconds", Seconds{0.1, 600},
      [](auto& s) -> auto& { return s.limits.login_deadline; });
  keys.add(
      "limits.line_seconds", Seconds{0.1, 600},
      [](auto& s) -> auto& { return s.limits.line_deadline; });
}

void add_rate_limits(Keys<ServerSettings>& keys) {
  keys.add(
      "limits.messages_per_second", Number{1, 1e6},
      [](auto& s) -> auto& { return s.limits.messages_per_second; });
  keys.add(
      "limits.message_burst", Number{1, 1e6},
      [](auto& s) -> auto& { return s.limits.message_burst; });
  keys.add(
      "limits.bad_lines_in_a_row", WholeNumber{1, 1'000'000},
      [](auto& s) -> auto& { return s.limits.bad_lines_in_a_row; });
  keys.add(
      "limits.connections_per_address", WholeNumber{1, 1'000'000},
      [](auto& s) -> auto& { return s.limits.connections_per_address; });
  keys.add(
      "limits.connections", WholeNumber{1, 1'000'000},
      [](auto& s) -> auto& { return s.limits.connections; });
  keys.add(
      "limits.takeover_interval_seconds", Seconds{0, 60},
      [](auto& s) -> auto& { return s.limits.takeover_interval; });
  keys.add(
      "limits.untold_ends", WholeNumber{1, 10'000},
      [](auto& s) -> auto& { return s.limits.untold_ends; });
}

void add_queue_limits(Keys<ServerSettings>& keys) {
  keys.add(
      "limits.input_bytes_per_second", WholeNumber{kib, 1024 * mib},
      [](auto& s) -> auto& { return s.limits.input_bytes_per_second; });
  keys.add(
      "limits.input_burst_bytes", WholeNumber{64 * kib, 1024 * mib},
      [](auto& s) -> auto& { return s.limits.input_burst_bytes; });
  keys.add(
      "limits.output_bytes_in_all", WholeNumber{mib, 1024 * 1024 * mib},
      [](auto& s) -> auto& { return s.limits.output_bytes_in_all; });
  keys.add(
      "limits.output_queue_bytes", WholeNumber{64 * kib, 1024 * mib},
      [](auto& s) -> auto& { return s.limits.output_queue_bytes; });
  keys.add(
      "limits.tcp_user_timeout_seconds", Seconds{1, 3600},
      [](auto& s) -> auto& { return s.limits.tcp_user_timeout; });
}

void add_game_limits(Keys<ServerSettings>& keys) {
  keys.add(
      "limits.max_refusals", WholeNumber{1, 100},
      [](auto& s) -> auto& { return s.limits.max_refusals; });
  keys.add(
      "limits.challenge_expiry_seconds", Seconds{1, 3600},
      [](auto& s) -> auto& { return s.limits.challenge_expiry; });
  keys.add(
      "limits.entry_seconds", Seconds{0.1, 1e6},
      [](auto& s) -> auto& { return s.limits.entry_deadline; });
  keys.add(
      "limits.arrival_seconds", Seconds{0.1, 1e6},
      [](auto& s) -> auto& { return s.limits.arrival_deadline; });
  keys.add(
      "limits.return_seconds", Seconds{0.1, 1e6},
      [](auto& s) -> auto& { return s.limits.return_deadline; });
  keys.add(
      "limits.lag_credit_per_turn_seconds", Seconds{0, 10},
      [](auto& s) -> auto& { return s.limits.lag_credit_per_turn; });
  keys.add(
      "limits.lag_credit_per_game_seconds", Seconds{0, 600},
      [](auto& s) -> auto& { return s.limits.lag_credit_per_game; });
}

Keys<ServerSettings> server_key_table() {
  Keys<ServerSettings> keys;
  keys.add(
      "name", Name{}, [](auto& s) -> auto& { return s.name; });
  keys.add(
      "listen", HostPort{}, [](auto& s) -> auto& { return s.listen; });
  keys.add(
      "http", HostPort{}, [](auto& s) -> auto& { return s.http; });
  keys.add(
      "database", Line{"the name of a file"}, [](auto& s) -> auto& { return s.database; });
  keys.add(
      "registration", OneOf{{"open", "closed"}}, [](auto& s) -> auto& { return s.registration; });
  keys.add(
      "worker_threads", WholeNumber{0, 1024}, [](auto& s) -> auto& { return s.worker_threads; });
  keys.add(
      "max_house_bots", WholeNumber{0, 1024}, [](auto& s) -> auto& { return s.max_house_bots; });
  keys.add(
      "simulations_per_second", WholeNumber{0, 1000},
      [](auto& s) -> auto& { return s.simulations_per_second; });
  keys.add(
      "spectator_delay_seconds", Seconds{0, 3600},
      [](auto& s) -> auto& { return s.spectator_delay; });
  keys.add(
      "plain_beyond_loopback", Flag{}, [](auto& s) -> auto& { return s.plain_beyond_loopback; });
  keys.add(
      "http_name", OrNone<Line>{{"the name of a host"}},
      [](auto& s) -> auto& { return s.http_name; });
  keys.add(
      "admin_token_file", OrNone<Line>{{"the name of a file"}},
      [](auto& s) -> auto& { return s.admin_token_file; });
  keys.add(
      "tls.listen", OrNone<HostPort>{}, [](auto& s) -> auto& { return s.tls.listen; });
  keys.add(
      "tls.http", OrNone<HostPort>{}, [](auto& s) -> auto& { return s.tls.http; });
  keys.add(
      "tls.certificate", OrNone<Line>{{"the name of a PEM file"}},
      [](auto& s) -> auto& { return s.tls.certificate; });
  keys.add(
      "tls.key", OrNone<Line>{{"the name of a PEM file"}},
      [](auto& s) -> auto& { return s.tls.key; });
  keys.add(
      "log.level", OneOf{{"trace", "debug", "info", "warning", "error"}},
      [](auto& s) -> auto& { return s.log.level; });
  keys.add(
      "log.json", Flag{}, [](auto& s) -> auto& { return s.log.json; });
  add_line_limits(keys);
  add_rate_limits(keys);
  add_queue_limits(keys);
  add_game_limits(keys);
  return keys;
}

}  // namespace

Expected<ServerSettings> parse_server_settings(std::string_view text, const std::string& file) {
  return parse_document(text, file).and_then([&](const Node& root) -> Expected<ServerSettings> {
    ServerSettings settings;
    if (auto done = server_key_table().read(root, file, settings); !done) {
      return tl::unexpected(done.error());
    }
    return settings;
  });
}

Expected<ServerSettings> load_server_settings(const std::string& file) {
  return read_file(file).and_then(
      [&](const std::string& text) { return parse_server_settings(text, file); });
}

std::vector<KeyDoc> server_keys() {
  return server_key_table().documentation();
}

}  // namespace poolhall::settings
