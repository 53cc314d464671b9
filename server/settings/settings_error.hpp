// Why a settings file was refused, in a form that editors jump to.
//
//   if (!settings) std::cerr << text(settings.error()) << '\n';
//   // config/poolhall.toml:12:1: unknown key "lisen"; did you mean "listen"?
#pragma once

#include <cstdint>
#include <string>

#include <tl/expected.hpp>

namespace poolhall::settings {

struct SettingsError {
  std::string file;
  std::uint32_t line = 0;    // 1-based; 0: the file as a whole
  std::uint32_t column = 0;  // 1-based
  std::string reason;        // one line: what came and what was expected
};

// "file:line:column: reason", or "file: reason" when no line is to blame.
[[nodiscard]] std::string text(const SettingsError& error);

template <class T>
using Expected = tl::expected<T, SettingsError>;

}  // namespace poolhall::settings
