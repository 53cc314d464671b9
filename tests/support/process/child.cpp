#include "tests/support/process/child.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <utility>

namespace poolhall::test_support {
namespace {

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) {
    pointers.push_back(text.data());
  }
  pointers.push_back(nullptr);
  return pointers;
}

// What the child gets: these first, then the parent's.
std::vector<std::string> whole_environment(std::vector<std::string> own) {
  for (char** variable = environ; *variable != nullptr; ++variable) {
    own.emplace_back(*variable);
  }
  return own;
}

std::chrono::microseconds duration(const timeval& time) {
  return std::chrono::seconds{time.tv_sec} + std::chrono::microseconds{time.tv_usec};
}

// Between fork and exec: nothing but calls that are safe there.
[[noreturn]] void become(char* const* arguments, char* const* environment, int output) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (output >= 0) {
    ::dup2(output, STDOUT_FILENO);
  }
  ::execve(arguments[0], arguments, environment);
  ::_exit(127);
}

}  // namespace

Child::Child(std::vector<std::string> arguments, Options options) {
  std::vector<std::string> environment = whole_environment(std::move(options.environment));
  const std::vector<char*> argument_pointers = pointers_to(arguments);
  const std::vector<char*> environment_pointers = pointers_to(environment);
  std::array<int, 2> ends{-1, -1};
  if (options.output == Output::pipe && ::pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw std::runtime_error("no pipe to a child process");
  }
  if (options.output == Output::log) {
    ends[1] = ::open(options.log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
  }
  pid_ = ::fork();
  if (pid_ == 0) {
    if (options.output == Output::log) {
      ::dup2(ends[1], STDERR_FILENO);
    }
    become(argument_pointers.data(), environment_pointers.data(), ends[1]);
  }
  if (ends[1] >= 0) {
    ::close(ends[1]);
  }
  output_ = ends[0];
  if (pid_ < 0) {
    throw std::runtime_error("no process for " + arguments.front());
  }
}

Child::~Child() {
  if (pid_ > 0) {
    signal(SIGKILL);
    static_cast<void>(wait());
  }
  if (output_ >= 0) {
    ::close(output_);
  }
}

void Child::signal(int number) const {
  if (pid_ > 0) {
    ::kill(pid_, number);
  }
}

Child::End Child::wait() {
  int status = 0;
  rusage usage{};
  while (::wait4(pid_, &status, 0, &usage) < 0 && errno == EINTR) {
  }
  pid_ = 0;
  End end;
  if (WIFEXITED(status)) {
    end.exit_code = WEXITSTATUS(status);
  } else {
    end.signal = WTERMSIG(status);
  }
  end.cpu = duration(usage.ru_utime) + duration(usage.ru_stime);
  return end;
}

bool Child::has_ended() const {
  siginfo_t info{};
  return pid_ == 0 ||
         (::waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
          info.si_pid == pid_);
}

std::optional<std::string> Child::read_line() {
  for (;;) {
    if (const auto end = read_.find('\n'); end != std::string::npos) {
      std::string line = read_.substr(0, end);
      read_.erase(0, end + 1);
      return line;
    }
    std::array<char, 4096> buffer{};
    const ssize_t count = ::read(output_, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) {
      continue;
    }
    if (count <= 0) {
      return std::nullopt;
    }
    read_.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

}  // namespace poolhall::test_support
