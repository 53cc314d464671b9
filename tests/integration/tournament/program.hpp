// The program as a child process in a directory of its own, read line by line.
//
//   Program program{directory.path(), {"tournament", "run", "cup.toml", "--db", "cup.db"}};
//   while (auto line = program.next_line()) ...;
//   program.wait();   // the exit code
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace poolhall::tournament {

class Program {
 public:
  Program(const std::filesystem::path& directory, const std::vector<std::string>& arguments);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  // The next line of standard output or error, nothing at their end. Throws when it takes minutes.
  [[nodiscard]] std::optional<std::string> next_line();
  // All that is still to come.
  [[nodiscard]] std::string rest();
  void signal(int number) const;
  // The exit code, or -1 when a signal ended it.
  int wait();

 private:
  pid_t pid_ = 0;
  int output_ = -1;
  std::string buffer_;
};

}  // namespace poolhall::tournament
