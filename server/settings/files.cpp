#include "server/settings/files.hpp"

#include <fstream>

#include <fmt/format.h>

namespace poolhall::settings {
namespace {

constexpr std::size_t max_file_size = 1 << 20;

}  // namespace

Expected<std::string> read_file(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::string content(max_file_size + 1, '\0');
  if (in) {
    in.read(content.data(), static_cast<std::streamsize>(content.size()));
  }
  if (!in.is_open() || in.bad() || (in.fail() && !in.eof())) {
    return tl::unexpected(
        SettingsError{file, 0, 0, "cannot be read; expected the name of a readable TOML file"});
  }
  content.resize(static_cast<std::size_t>(in.gcount()));
  if (content.size() > max_file_size) {
    return tl::unexpected(SettingsError{
        file, 0, 0, fmt::format("longer than {} bytes; expected a settings file", max_file_size)});
  }
  return content;
}

}  // namespace poolhall::settings
