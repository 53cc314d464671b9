// A child process: started, listened to, stopped or killed. It dies with its parent.
//
//   Child child({program, "load", "--json"}, {.output = Child::Output::pipe});
//   while (auto line = child.read_line()) ...
//   const Child::End end = child.wait();
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace poolhall::test_support {

class Child {
 public:
  enum class Output : std::uint8_t { inherited, pipe, log };
  struct Options {
    Output output = Output::inherited;
    std::filesystem::path log{};             // when output is log; appended to
    std::vector<std::string> environment{};  // "NAME=value", besides the parent's
  };
  struct End {
    std::optional<int> exit_code{};  // unset: a signal
    int signal = 0;
    std::chrono::microseconds cpu{};  // of user and system
  };

  // The first argument is the program. Throws std::runtime_error when there can be no process.
  Child(std::vector<std::string> arguments, Options options);
  ~Child();  // kills
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  [[nodiscard]] pid_t pid() const { return pid_; }
  void signal(int number) const;
  End wait();
  // Whether it has ended by itself; wait() then returns at once.
  [[nodiscard]] bool has_ended() const;
  // Of its standard output, when that is a pipe; nothing at its end.
  [[nodiscard]] std::optional<std::string> read_line();

 private:
  pid_t pid_ = 0;
  int output_ = -1;
  std::string read_;
};

}  // namespace poolhall::test_support
