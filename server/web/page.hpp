// One answer of the page's port.
//
//   Page page{200, "application/json", text};
//   return refusal(404, "not_found", "there is no such game");
#pragma once

#include <string>
#include <string_view>

namespace poolhall::web {

struct Page {
  unsigned status = 200;
  std::string type = "application/json";
  std::string body;
  std::string etag{};  // with quotes; only of what a browser may keep
};

// A refusal as JSON: {"error": {"code": "not_found", "reason": "..."}}.
[[nodiscard]] Page refusal(unsigned status, std::string_view code, std::string_view reason);

}  // namespace poolhall::web
