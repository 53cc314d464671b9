// Text made small for the way (RFC 1952), fast rather than to the last byte.
//
//   if (accepts_gzip(request[http::field::accept_encoding])) body = gzip(body);
#pragma once

#include <string>
#include <string_view>

namespace poolhall::web {

// Whether a request's Accept-Encoding allows it: "gzip" or "*", and not with q=0.
[[nodiscard]] bool accepts_gzip(std::string_view accept_encoding);

[[nodiscard]] std::string gzip(std::string_view text);

}  // namespace poolhall::web
