// What the page's port reads in a request's head and writes in an answer's. For the sources of this
// room.
//
//   if (!is_own_origin(origin, host)) co_return refusal(403, "wrong_origin", "...");
//   http::async_write(stream, response_of(page, request), ...);
#pragma once

#include <boost/beast/core/error.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <cstdint>
#include <optional>
#include <string_view>

#include "server/web/live_feed.hpp"
#include "server/web/page.hpp"
#include "server/web/site.hpp"

namespace poolhall::web {

inline constexpr std::uint32_t header_bytes = 8 * 1024;

[[nodiscard]] inline std::string_view text_of(boost::beast::string_view text) {
  return {text.data(), text.size()};
}

// "pool.example:8443" without the port, "[::1]:8080" with its brackets.
[[nodiscard]] std::string_view without_port(std::string_view host);

// Browsers name the site whose page asks, but for their own GETs.
[[nodiscard]] bool is_own_origin(std::string_view origin, std::string_view host);

// "/ws/lobby", "/ws/games/17"; "/ws" and "/ws?game=17" are the same. Nothing for anything else.
[[nodiscard]] std::optional<Topic> topic_of(std::string_view target);

using Response = boost::beast::http::response<boost::beast::http::string_body>;
[[nodiscard]] Response response_of(Page page, const Request& request);

// What to say to a request that could not be read; nothing to one that never came.
[[nodiscard]] std::optional<Page> refusal_of(const boost::system::error_code& error);
[[nodiscard]] Page too_long_a_body(std::uint64_t limit);

}  // namespace poolhall::web
