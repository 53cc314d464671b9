#include "server_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/inotify.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>

#include "wire_client.hpp"

namespace poolhall::net_tests {

namespace {

// The agents' port out of the ready file.
std::optional<std::uint16_t> port_in(const std::filesystem::path& file) {
  std::ifstream in(file);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::string key = "\"agents\": \"127.0.0.1:";
  const auto at = text.find(key);
  if (at == std::string::npos) {
    return std::nullopt;
  }
  return static_cast<std::uint16_t>(std::stoi(text.substr(at + key.size())));
}

std::uint16_t await_port(int watch, pid_t server, const std::filesystem::path& file) {
  const auto deadline = std::chrono::steady_clock::now() + patience;
  while (std::chrono::steady_clock::now() < deadline) {
    if (const auto port = port_in(file)) {
      return *port;
    }
    if (waitpid(server, nullptr, WNOHANG) == server) {
      throw std::runtime_error("the server ended before it listened");
    }
    pollfd changed{watch, POLLIN, 0};
    if (poll(&changed, 1, 200) > 0) {
      char events[4096];
      static_cast<void>(!read(watch, events, sizeof events));
    }
  }
  throw std::runtime_error("the server did not become ready");
}

}  // namespace

ServerProcess::ServerProcess(const std::filesystem::path& directory,
                             const std::vector<std::string>& more_arguments,
                             const std::vector<std::string>& environment) {
  const std::filesystem::path ready = directory / "ready.json";
  std::filesystem::remove(ready);
  const int watch = inotify_init1(IN_CLOEXEC);
  inotify_add_watch(watch, directory.c_str(), IN_MOVED_TO);
  std::vector<std::string> arguments{
      POOLHALL_PROGRAM, "serve",       "--listen", "127.0.0.1:0",
      "--http",         "127.0.0.1:0", "--db",     (directory / "server.db").string(),
      "--ready-file",   ready.string()};
  arguments.insert(arguments.end(), more_arguments.begin(), more_arguments.end());
  std::vector<char*> pointers;
  for (std::string& argument : arguments) {
    pointers.push_back(argument.data());
  }
  pointers.push_back(nullptr);
  const std::string log = (directory / "server.log").string();
  pid_ = fork();
  if (pid_ == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    const int out = open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
    dup2(out, STDERR_FILENO);
    dup2(out, STDOUT_FILENO);
    for (const std::string& variable : environment) {
      putenv(const_cast<char*>(variable.c_str()));
    }
    execv(pointers[0], pointers.data());
    _exit(127);
  }
  port_ = await_port(watch, pid_, ready);
  close(watch);
}

ServerProcess::~ServerProcess() {
  kill();
}

void ServerProcess::kill() {
  if (pid_ > 0) {
    ::kill(pid_, SIGKILL);
    wait();
  }
}

int ServerProcess::terminate() {
  ::kill(pid_, SIGTERM);
  return wait();
}

int ServerProcess::wait() {
  int status = 0;
  waitpid(pid_, &status, 0);
  pid_ = 0;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace poolhall::net_tests
