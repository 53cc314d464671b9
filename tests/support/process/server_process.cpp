#include "tests/support/process/server_process.hpp"

#include <poll.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>

namespace poolhall::test_support {
namespace {

constexpr std::chrono::seconds patience{60};
constexpr int look_again_ms = 200;  // whether the server has ended instead

std::filesystem::path removed(std::filesystem::path file) {
  std::filesystem::remove(file);
  return file;
}

std::vector<std::string> command(const ServerProcessOptions& options) {
  std::vector<std::string> arguments{options.program.string(),
                                     "serve",
                                     "--listen",
                                     "127.0.0.1:0",
                                     "--http",
                                     "127.0.0.1:0",
                                     "--db",
                                     (options.directory / "server.db").string(),
                                     "--ready-file",
                                     (options.directory / "ready.json").string()};
  arguments.insert(arguments.end(), options.more_arguments.begin(), options.more_arguments.end());
  return arguments;
}

std::optional<std::uint16_t> port_in(const std::string& text, const std::string& name) {
  const std::string key = '"' + name + "\": \"127.0.0.1:";
  const auto at = text.find(key);
  if (at == std::string::npos) {
    return std::nullopt;
  }
  return static_cast<std::uint16_t>(std::stoi(text.substr(at + key.size())));
}

// The ready file's text. It comes whole, by a rename.
std::string await(const std::filesystem::path& ready, const Child& server, int watch) {
  const auto deadline = std::chrono::steady_clock::now() + patience;
  while (std::chrono::steady_clock::now() < deadline) {
    std::ifstream in(ready);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    if (!text.empty()) {
      return text;
    }
    if (server.has_ended()) {
      throw std::runtime_error("the server ended before it listened; its log is beside " +
                               ready.string());
    }
    pollfd changed{watch, POLLIN, 0};
    if (::poll(&changed, 1, look_again_ms) > 0) {
      std::array<char, 4096> events{};
      static_cast<void>(!::read(watch, events.data(), events.size()));
    }
  }
  throw std::runtime_error("the server did not become ready");
}

// Closes what it holds.
struct Watch {
  explicit Watch(const std::filesystem::path& directory) : descriptor(::inotify_init1(IN_CLOEXEC)) {
    ::inotify_add_watch(descriptor, directory.c_str(), IN_MOVED_TO);
  }
  ~Watch() { ::close(descriptor); }
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  int descriptor;
};

}  // namespace

ServerProcess::ServerProcess(const ServerProcessOptions& options)
    : ready_(removed(options.directory / "ready.json")),
      child_(command(options), {.output = Child::Output::log,
                                .log = options.directory / "server.log",
                                .environment = options.environment}) {
  const Watch watch(options.directory);
  const std::string text = await(ready_, child_, watch.descriptor);
  port_ = port_in(text, "agents").value();
  http_port_ = port_in(text, "http").value_or(0);
}

void ServerProcess::kill() {
  if (child_.pid() > 0) {
    child_.signal(SIGKILL);
    static_cast<void>(child_.wait());
  }
}

int ServerProcess::terminate() {
  child_.signal(SIGTERM);
  return wait();
}

int ServerProcess::wait() {
  return child_.wait().exit_code.value_or(-1);
}

}  // namespace poolhall::test_support
