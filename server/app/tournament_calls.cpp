#include "server/app/tournament_calls.hpp"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <fstream>
#include <functional>
#include <memory>
#include <string>

#include <fmt/format.h>

#include "protocol/json_value.hpp"
#include "server/app/exit_codes.hpp"
#include "server/ledger/status.hpp"
#include "server/ledger/stored_tournament.hpp"
#include "server/ledger/tables.hpp"
#include "server/settings/files.hpp"
#include "server/storage/sqlite_database.hpp"
#include "server/web/http_call.hpp"

namespace poolhall::app {
namespace {

// Where a tournament is: at a server, or in a database file.
struct Place {
  std::string server = "127.0.0.1:8080";
  std::string ca_file{};
  std::string database;
  std::string token_file;
};

int say_no(int code, const std::string& reason) {
  fmt::print(stderr, "poolhall tournament: {}\n", reason);
  return code;
}

int print_all(const std::string& text) {
  const bool is_written =
      std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
  return is_written ? done : say_no(failed, "standard output cannot be written");
}

int print_reply(const web::HttpCall& call) {
  const auto reply = web::http_call(call);
  if (!reply) {
    return say_no(failed, reply.error());
  }
  if (reply->status >= 300) {
    return say_no(failed,
                  fmt::format("{} answers {}: {}", call.server, reply->status, reply->body));
  }
  const bool has_end = reply->body.ends_with('\n');
  return print_all(has_end ? reply->body : reply->body + '\n');
}

// A call of the host's: with the token, which is in a file and never on the command line.
int host_call(const Place& place, const std::string& target, const std::string& body,
              const std::string& content_type) {
  if (place.token_file.empty()) {
    return say_no(wrong_input,
                  "--admin-token-file: nothing came, expected the server's token file");
  }
  std::ifstream in(place.token_file);
  std::string token;
  if (!(in >> token)) {
    return say_no(wrong_input,
                  place.token_file + ": cannot be read, expected a file with the token");
  }
  return print_reply({.server = place.server,
                      .ca_file = place.ca_file,
                      .method = "POST",
                      .target = target,
                      .token = token,
                      .body = body,
                      .content_type = content_type});
}

void add_server_options(CLI::App& command, Place& place) {
  command
      .add_option("--server", place.server,
                  "The running server's page, HOST:PORT or https://HOST:PORT")
      ->capture_default_str();
  command.add_option("--tls-ca", place.ca_file,
                     "PEM file of certificates to believe instead of the system's; for https");
}

void add_host_options(CLI::App& command, Place& place) {
  add_server_options(command, place);
  command.add_option("--admin-token-file", place.token_file, "The file with the server's token");
}

void add_reading_options(CLI::App& command, Place& place) {
  add_server_options(command, place);
  command.add_option("--db", place.database, "Read this database instead of asking a server");
}

void add_create(CLI::App& parent, int& exit_code) {
  const auto place = std::make_shared<Place>();
  const auto file = std::make_shared<std::string>();
  CLI::App* command = parent.add_subcommand("create", "Give a tournament to a running server");
  command->add_option("FILE", *file, "The tournament file (config/README.md)")->required();
  add_host_options(*command, *place);
  command->callback([place, file, &exit_code] {
    const auto text = settings::read_file(*file);
    exit_code = text ? host_call(*place, "/api/admin/tournaments", *text, "application/toml")
                     : say_no(wrong_input, settings::text(text.error()));
  });
}

void add_change(CLI::App& parent, int& exit_code, const std::string& change,
                const std::string& what) {
  const auto place = std::make_shared<Place>();
  const auto id = std::make_shared<std::string>();
  CLI::App* command = parent.add_subcommand(change, what);
  command->add_option("ID", *id, "The tournament's name")->required();
  add_host_options(*command, *place);
  command->callback([place, id, change, &exit_code] {
    exit_code = host_call(*place, fmt::format("/api/admin/tournaments/{}/{}", *id, change), "",
                          "application/json");
  });
}

void add_entry_change(CLI::App& parent, int& exit_code, const std::string& change,
                      const std::string& what) {
  const auto place = std::make_shared<Place>();
  const auto id = std::make_shared<std::string>();
  const auto agent = std::make_shared<std::string>();
  CLI::App* command = parent.add_subcommand(change, what);
  command->add_option("ID", *id, "The tournament's name")->required();
  command->add_option("AGENT", *agent, "The agent's name")->required();
  add_host_options(*command, *place);
  command->callback([place, id, agent, change, &exit_code] {
    exit_code = host_call(*place, fmt::format("/api/admin/tournaments/{}/{}", *id, change),
                          fmt::format("{{\"agent\": {}}}", protocol::canonical_text({*agent})),
                          "application/json");
  });
}

// From a database without a server.
int read_here(const Place& place,
              const std::function<storage::Expected<std::string>(storage::Reader&)>& read) {
  const auto reader = storage::open_sqlite_reader(place.database);
  if (!reader) {
    return say_no(failed, reader.error().reason);
  }
  const auto text = read(**reader);
  return text ? print_all(*text) : say_no(failed, text.error().reason);
}

using OfStored = std::function<std::string(const ledger::StoredTournament&)>;

int read_tournament(const Place& place, const std::string& id, const std::string& page,
                    const OfStored& text_of) {
  if (place.database.empty()) {
    return print_reply({.server = place.server,
                        .ca_file = place.ca_file,
                        .target = fmt::format("/api/tournaments/{}/{}", id, page)});
  }
  return read_here(place, [&](storage::Reader& reader) -> storage::Expected<std::string> {
    const auto stored = ledger::stored_tournament(reader, id);
    if (!stored) {
      return tl::unexpected(stored.error());
    }
    if (!*stored) {
      return tl::unexpected(storage::StorageError{
          storage::StorageFault::conflict,
          fmt::format("{}: there is no tournament \"{}\"", place.database, id)});
    }
    return text_of(**stored);
  });
}

int list_tournaments(const Place& place) {
  return place.database.empty() ? print_reply({.server = place.server,
                                               .ca_file = place.ca_file,
                                               .target = "/api/tournaments.txt"})
                                : read_here(place, ledger::list_text);
}

void add_list(CLI::App& parent, int& exit_code) {
  const auto place = std::make_shared<Place>();
  CLI::App* command = parent.add_subcommand("list", "The tournaments of a server or database");
  add_reading_options(*command, *place);
  command->callback([place, &exit_code] { exit_code = list_tournaments(*place); });
}

void add_status(CLI::App& parent, int& exit_code) {
  const auto place = std::make_shared<Place>();
  const auto id = std::make_shared<std::string>();
  CLI::App* command = parent.add_subcommand("status", "How a tournament stands, or all of them");
  command->add_option("ID", *id, "The tournament's name; without it all are listed");
  add_reading_options(*command, *place);
  command->callback([place, id, &exit_code] {
    exit_code = id->empty() ? list_tournaments(*place)
                            : read_tournament(*place, *id, "status.txt", ledger::status_text);
  });
}

void add_table(CLI::App& parent, int& exit_code, const std::string& name, const std::string& what) {
  const auto place = std::make_shared<Place>();
  const auto id = std::make_shared<std::string>();
  const auto form = std::make_shared<std::string>("text");
  CLI::App* command = parent.add_subcommand(name, what);
  command->add_option("ID", *id, "The tournament's name")->required();
  command->add_option("--format", *form, "text, csv or json")
      ->check(CLI::IsMember({"text", "csv", "json"}))
      ->capture_default_str();
  add_reading_options(*command, *place);
  command->callback([place, id, form, name, &exit_code] {
    const std::string page = name + (*form == "text" ? ".txt" : *form == "csv" ? ".csv" : "");
    exit_code = read_tournament(*place, *id, page, [&](const ledger::StoredTournament& stored) {
      return ledger::table_text(*id, stored.book, *ledger::table(name), *ledger::table_form(*form));
    });
  });
}

int export_trf(const Place& place, const std::string& id) {
  if (place.database.empty()) {
    return read_tournament(place, id, "trf", {});
  }
  return read_here(place, [&](storage::Reader& reader) -> storage::Expected<std::string> {
    const auto stored = ledger::stored_tournament(reader, id);
    if (!stored) {
      return tl::unexpected(stored.error());
    }
    const auto trf = *stored ? ledger::trf_text(id, (*stored)->book) : std::nullopt;
    if (!trf) {
      return tl::unexpected(storage::StorageError{
          storage::StorageFault::conflict,
          fmt::format("{}: there is no Swiss tournament \"{}\"", place.database, id)});
    }
    return *trf;
  });
}

void add_export(CLI::App& parent, int& exit_code) {
  const auto place = std::make_shared<Place>();
  const auto id = std::make_shared<std::string>();
  const auto is_trf = std::make_shared<bool>(true);
  CLI::App* command =
      parent.add_subcommand("export", "A Swiss tournament for other pairing programs");
  command->add_option("ID", *id, "The tournament's name")->required();
  command->add_flag("--trf", *is_trf, "As FIDE's TRF16 (the one form there is)");
  add_reading_options(*command, *place);
  command->callback([place, id, is_trf, &exit_code] { exit_code = export_trf(*place, *id); });
}

}  // namespace

void add_tournament_calls(CLI::App& tournament, int& exit_code) {
  add_create(tournament, exit_code);
  add_change(tournament, exit_code, "start", "Begin a tournament that was created");
  add_change(tournament, exit_code, "pause", "Begin no more games; those that go on end");
  add_change(tournament, exit_code, "resume", "Go on after a pause");
  add_change(tournament, exit_code, "abort", "End it; games that go on are void");
  add_entry_change(tournament, exit_code, "enter",
                   "Enter an agent, also while a tournament goes on whose format allows it");
  add_entry_change(tournament, exit_code, "withdraw",
                   "Take an agent out; games of it that go on are forfeited");
  add_list(tournament, exit_code);
  add_status(tournament, exit_code);
  add_table(tournament, exit_code, "standings", "The table");
  add_table(tournament, exit_code, "crosstable", "Who scored what against whom");
  add_export(tournament, exit_code);
}

}  // namespace poolhall::app
