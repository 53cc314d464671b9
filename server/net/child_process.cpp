#include "server/net/child_process.hpp"

#include <fcntl.h>
#include <linux/close_range.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace poolhall::net {

namespace {

std::vector<char*> pointers(const std::vector<std::string>& texts) {
  std::vector<char*> result;
  result.reserve(texts.size() + 1);
  for (const std::string& text : texts) {
    result.push_back(const_cast<char*>(text.c_str()));  // execve does not write to them
  }
  result.push_back(nullptr);
  return result;
}

// In the child, between fork and exec: only what a signal handler may do.
[[noreturn]] void become(char* const* arguments, char* const* environment, pid_t parent) {
  sigset_t none;
  sigemptyset(&none);
  pthread_sigmask(SIG_SETMASK, &none, nullptr);
  // A terminal's ^C is for the server, which then ends its bots itself.
  setpgid(0, 0);
  if (prctl(PR_SET_PDEATHSIG, SIGKILL) != 0 || getppid() != parent) {
    _exit(127);
  }
  syscall(SYS_close_range, 3U, ~0U, 0U);
  execve(arguments[0], arguments, environment);
  _exit(127);
}

}  // namespace

std::optional<Child> start_child(const std::vector<std::string>& arguments,
                                 const std::vector<std::string>& environment) {
  const auto argument_pointers = pointers(arguments);
  const auto environment_pointers = pointers(environment);
  const pid_t parent = getpid();
  const pid_t pid = fork();
  if (pid < 0) {
    return std::nullopt;
  }
  if (pid == 0) {
    become(argument_pointers.data(), environment_pointers.data(), parent);
  }
  const int descriptor = static_cast<int>(syscall(SYS_pidfd_open, pid, 0U));
  if (descriptor < 0) {
    kill(pid, SIGKILL);
    waitpid(pid, nullptr, 0);
    return std::nullopt;
  }
  fcntl(descriptor, F_SETFD, FD_CLOEXEC);
  return Child{pid, descriptor};
}

}  // namespace poolhall::net
