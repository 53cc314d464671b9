// What the server is told by its settings file, config/poolhall.toml. Plain values in the units
// of the program; every key and its default is in config/README.md.
//
//   Expected<ServerSettings> settings = load_server_settings("config/poolhall.toml");
//   if (!settings) die(text(settings.error()));
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/limits.hpp"
#include "server/settings/key_doc.hpp"
#include "server/settings/settings_error.hpp"

namespace poolhall::settings {

struct LogSettings {
  std::string level = "info";  // trace, debug, info, warning, error
  bool json = false;           // one JSON object a line
};

// With a certificate agents and the page's readers may connect by TLS.
struct TlsSettings {
  std::string listen{};       // agents; empty: no port of its own
  std::string certificate{};  // PEM file: the server's first, then its issuers'
  std::string key{};          // PEM file
  std::string http{};         // page and JSON API; empty: no port of its own
};

struct ServerSettings {
  std::string name = "poolhall";              // told to agents
  std::string listen = "127.0.0.1:7777";      // agents
  std::string http = "127.0.0.1:8080";        // page and JSON API
  std::string database = "poolhall.db";       // file
  std::string registration = "open";          // open: any agent may register; closed
  std::uint32_t worker_threads = 0;           // for physics; 0: one a core
  std::uint32_t max_house_bots = 16;          // processes
  std::uint32_t simulations_per_second = 10;  // of the page's workbench, for each address
  std::chrono::milliseconds spectator_delay{0};
  bool plain_beyond_loopback = false;  // unencrypted, for other machines
  std::string http_name;               // the page's, behind a reverse proxy; empty: none
  std::string admin_token_file;        // made if it does not exist; empty: no admin calls
  TlsSettings tls;
  LogSettings log;
  protocol::Limits limits;
};

[[nodiscard]] Expected<ServerSettings> load_server_settings(const std::string& file);
// The same from text; `file` is for messages.
[[nodiscard]] Expected<ServerSettings> parse_server_settings(std::string_view text,
                                                             const std::string& file);

// All keys, in the order of config/poolhall.toml.
[[nodiscard]] std::vector<KeyDoc> server_keys();

}  // namespace poolhall::settings
