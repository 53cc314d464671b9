// The bot under test as a process: started as a tournament starts an entry's `command`, and killed
// with everything that it has started.
//
//   Bot bot(command, log_file, starter);
//   bot.start("127.0.0.1:4711", token);      // POOLHALL_SERVER, POOLHALL_TOKEN, {server}, {token}
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace poolhall::conformance {

struct BotProcess {
  pid_t pid = 0;             // leader of a process group of its own
  int exit_descriptor = -1;  // readable once it has ended; the receiver's to close
};
// Starts a program with these arguments and this environment; nothing if the system cannot.
using BotStarter = std::function<std::optional<BotProcess>(const std::vector<std::string>&,
                                                           const std::vector<std::string>&)>;

class Bot {
 public:
  // `log` gets what it writes to its standard output and error.
  Bot(std::string command, std::filesystem::path log, BotStarter starter);
  ~Bot();  // kills
  Bot(const Bot&) = delete;
  Bot& operator=(const Bot&) = delete;

  // `server` is HOST:PORT. Throws std::runtime_error if it cannot be started.
  void start(const std::string& server, const std::string& token);
  void kill();
  [[nodiscard]] bool runs() const { return process_.has_value(); }
  // Readable once it has ended; -1 while none runs.
  [[nodiscard]] int exit_descriptor() const { return process_ ? process_->exit_descriptor : -1; }
  // How it ended ("exit code 1"); to be called when exit_descriptor() is readable.
  [[nodiscard]] std::string end();

 private:
  std::string command_;
  std::filesystem::path log_;
  BotStarter starter_;
  std::optional<BotProcess> process_{};
};

// `command` with {server}, {host}, {port} and {token} filled in.
[[nodiscard]] std::string filled_in(std::string command, const std::string& server,
                                    const std::string& token);

}  // namespace poolhall::conformance
