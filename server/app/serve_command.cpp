// `poolhall serve`: the tournament server.
#include <CLI/CLI.hpp>

#include <spdlog/pattern_formatter.h>
#include <spdlog/spdlog.h>

#include <csignal>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include "clients/bots/house_bots.hpp"
#include "server/app/commands.hpp"
#include "server/app/log_sink.hpp"
#include "server/net/server.hpp"
#include "server/settings/server_settings.hpp"

namespace poolhall::app {
namespace {

struct ServeArguments {
  std::string config;
  std::optional<std::string> listen;
  std::optional<std::string> http;
  std::optional<std::string> database;
  std::optional<std::string> admin_token_file;
  std::optional<std::string> ready_file;
  std::optional<std::string> tls_listen;
  std::optional<std::string> tls_http;
  std::optional<std::string> tls_certificate;
  std::optional<std::string> tls_key;
  bool log_json = false;
  bool plain_beyond_loopback = false;
};

int fail(const std::string& reason, int code) {
  std::cerr << "poolhall serve: " << reason << '\n';
  return code;
}

// The message as the inside of a JSON string.
class JsonText : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& message, const std::tm&,
              spdlog::memory_buf_t& out) override {
    for (const char c : message.payload) {
      if (c == '"' || c == '\\') {
        out.push_back('\\');
      }
      out.push_back(c >= 0 && c < ' ' ? ' ' : c);
    }
  }
  [[nodiscard]] std::unique_ptr<custom_flag_formatter> clone() const override {
    return std::make_unique<JsonText>();
  }
};

// One line an event; JSON for machines. Nothing that is logged contains a token.
void set_up_log(const settings::LogSettings& log) {
  spdlog::set_default_logger(
      std::make_shared<spdlog::logger>("poolhall", std::make_shared<LogSink>()));
  spdlog::set_level(spdlog::level::from_str(log.level == "warning" ? "warn" : log.level));
  if (log.json) {
    auto formatter = std::make_unique<spdlog::pattern_formatter>();
    formatter->add_flag<JsonText>('*').set_pattern(
        R"({"time":"%Y-%m-%dT%H:%M:%S.%e%z","level":"%l","message":"%*"})");
    spdlog::set_formatter(std::move(formatter));
  } else {
    spdlog::set_pattern("%Y-%m-%d %H:%M:%S.%e %^%l%$ %v");
  }
}

void override_with(const ServeArguments& arguments, settings::ServerSettings& settings) {
  settings.listen = arguments.listen.value_or(settings.listen);
  settings.http = arguments.http.value_or(settings.http);
  settings.database = arguments.database.value_or(settings.database);
  settings.admin_token_file = arguments.admin_token_file.value_or(settings.admin_token_file);
  settings.tls.listen = arguments.tls_listen.value_or(settings.tls.listen);
  settings.tls.http = arguments.tls_http.value_or(settings.tls.http);
  settings.tls.certificate = arguments.tls_certificate.value_or(settings.tls.certificate);
  settings.tls.key = arguments.tls_key.value_or(settings.tls.key);
  settings.plain_beyond_loopback =
      settings.plain_beyond_loopback || arguments.plain_beyond_loopback;
  settings.log.json = settings.log.json || arguments.log_json;
}

int run_server(const ServeArguments& arguments) {
  net::ServerOptions options;
  if (!arguments.config.empty()) {
    const auto loaded = settings::load_server_settings(arguments.config);
    if (!loaded) {
      return fail(settings::text(loaded.error()), 2);
    }
    options.settings = *loaded;
  }
  override_with(arguments, options.settings);
  const auto listen = net::parse_endpoint(options.settings.listen);
  if (!listen) {
    return fail("--listen: got \"" + options.settings.listen + "\", expected HOST:PORT", 2);
  }
  if (const auto reason = net::exposed(options.settings)) {
    return fail(*reason, 2);
  }
  if (arguments.ready_file) {
    options.ready_file = *arguments.ready_file;
  }
  options.stored_tournaments = net::StoredTournaments::taken_up;
  options.house_bots = bots::house_bot_names();
  std::signal(SIGPIPE, SIG_IGN);  // whoever read the log may go, games do not end for that
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is a full disk, no reason to die
  set_up_log(options.settings.log);
  net::Server server(std::move(options));
  if (const auto started = server.start(); !started) {
    return fail(started.error(), 1);
  }
  return server.run();
}

}  // namespace

void add_serve_command(CLI::App& app, int& exit_code) {
  const auto arguments = std::make_shared<ServeArguments>();
  CLI::App* command = app.add_subcommand("serve", "Host games and tournaments");
  command->add_option("--config", arguments->config, "Settings file (config/poolhall.toml)");
  command->add_option("--listen", arguments->listen,
                      "Agents' port, HOST:PORT; port 0 picks a free one");
  command->add_option("--http", arguments->http, "Page's port, HOST:PORT");
  command->add_option("--db", arguments->database, "Database file");
  command->add_option("--admin-token-file", arguments->admin_token_file,
                      "File with the token of admin calls");
  command->add_option("--ready-file", arguments->ready_file,
                      "Written when the server listens: addresses and process id as JSON");
  command->add_option("--tls-listen", arguments->tls_listen,
                      "Agents' port with TLS, HOST:PORT; wants certificate and key");
  command->add_option("--tls-http", arguments->tls_http,
                      "Page's port with TLS (HTTPS), HOST:PORT; wants certificate and key");
  command->add_option("--tls-certificate", arguments->tls_certificate, "PEM file of the TLS ports");
  command->add_option("--tls-key", arguments->tls_key, "PEM file: the certificate's private key");
  command->add_flag("--log-json", arguments->log_json, "Log one JSON object a line");
  command->add_flag("--plain-beyond-loopback", arguments->plain_beyond_loopback,
                    "Allow unencrypted connections from other machines");
  command->callback([arguments, &exit_code] { exit_code = run_server(*arguments); });
}

}  // namespace poolhall::app
