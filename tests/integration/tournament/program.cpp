#include "program.hpp"

#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <stdexcept>

namespace poolhall::tournament {
namespace {

constexpr int patience_ms = 240'000;

}  // namespace

Program::Program(const std::filesystem::path& directory,
                 const std::vector<std::string>& arguments) {
  std::vector<std::string> words{POOLHALL_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) {
    pointers.push_back(word.data());
  }
  pointers.push_back(nullptr);
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) {
    throw std::runtime_error("no pipe");
  }
  pid_ = fork();
  if (pid_ == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    dup2(ends[1], STDOUT_FILENO);
    dup2(ends[1], STDERR_FILENO);
    close(ends[0]);
    close(ends[1]);
    if (chdir(directory.c_str()) == 0) {
      execv(pointers[0], pointers.data());
    }
    _exit(127);
  }
  close(ends[1]);
  output_ = ends[0];
}

Program::~Program() {
  if (pid_ > 0) {
    signal(SIGKILL);
    wait();
  }
  close(output_);
}

std::optional<std::string> Program::next_line() {
  while (true) {
    const auto end = buffer_.find('\n');
    if (end != std::string::npos) {
      std::string line = buffer_.substr(0, end);
      buffer_.erase(0, end + 1);
      return line;
    }
    pollfd readable{output_, POLLIN, 0};
    if (poll(&readable, 1, patience_ms) <= 0) {
      throw std::runtime_error("the program says nothing any more");
    }
    std::array<char, 4096> piece{};
    const ssize_t size = read(output_, piece.data(), piece.size());
    if (size <= 0) {
      return std::nullopt;
    }
    buffer_.append(piece.data(), static_cast<std::size_t>(size));
  }
}

std::string Program::rest() {
  std::string all;
  while (const auto line = next_line()) {
    all += *line + '\n';
  }
  return all;
}

void Program::signal(int number) const {
  kill(pid_, number);
}

int Program::wait() {
  int status = 0;
  waitpid(pid_, &status, 0);
  pid_ = 0;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace poolhall::tournament
