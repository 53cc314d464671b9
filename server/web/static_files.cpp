#include "server/web/static_files.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "server/match/chain.hpp"
#include "server/match/sha256.hpp"

namespace poolhall::web {

namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 4> types{{
    {".html", "text/html; charset=utf-8"},
    {".js", "text/javascript; charset=utf-8"},
    {".css", "text/css; charset=utf-8"},
    {".svg", "image/svg+xml"},
}};

std::string_view type_of(std::string_view path) {
  const auto known = std::find_if(types.begin(), types.end(),
                                  [path](const auto& type) { return path.ends_with(type.first); });
  return known == types.end() ? "text/plain; charset=utf-8" : known->second;
}

std::string etag_of(std::string_view text) {
  return '"' + match::to_hex(match::sha256(match::Bytes{}.text(text).bytes())).substr(0, 32) + '"';
}

}  // namespace

std::optional<Page> static_file(std::string_view path) {
  const std::string_view wanted = path == "/" ? "/index.html" : path;
  const auto files = embedded_files();
  const auto found = std::find_if(files.begin(), files.end(),
                                  [wanted](const auto& file) { return file.path == wanted; });
  if (found == files.end()) {
    return std::nullopt;
  }
  return Page{200, std::string(type_of(found->path)), std::string(found->text),
              etag_of(found->text)};
}

}  // namespace poolhall::web
