// A command of the shell, run to its end.
//
//   const Ran ran = run_command(std::string(POOLHALL_PROGRAM) + " verify --db " + file);
//   EXPECT_EQ(ran.exit_code, 0) << ran.err;
//
// For a process that is listened to or stopped see tests/support/process/child.hpp.
#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/support/temporary_directory.hpp"

namespace poolhall::test_support {

struct Ran {
  int exit_code = -1;  // -1: ended by a signal
  std::string out;
  std::string err;
};

// All of a file's bytes; none if there is no such file.
[[nodiscard]] inline std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// With that text as its standard input.
[[nodiscard]] inline Ran run_command(const std::string& command, const std::string& input = "") {
  const TemporaryDirectory folder;
  std::ofstream(folder / "in", std::ios::binary) << input;
  const auto at = [&](const char* name) { return (folder / name).string(); };
  const std::string whole =
      "{ " + command + "\n} < " + at("in") + " > " + at("out") + " 2> " + at("err");
  const int status = std::system(whole.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, bytes_of(at("out")), bytes_of(at("err"))};
}

}  // namespace poolhall::test_support
