#include "server/web/http_head.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/beast/http/error.hpp>
#include <charconv>
#include <map>
#include <string>
#include <utility>

#include "server/web/gzip.hpp"
#include "server/web/pages.hpp"

namespace poolhall::web {

namespace http = boost::beast::http;

namespace {

constexpr std::string_view security_policy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

// RFC 9110: a list of tags, each perhaps weak, or a star.
bool names_tag(std::string_view if_none_match, std::string_view etag) {
  return if_none_match == "*" || if_none_match.find(etag) != std::string_view::npos;
}

constexpr std::size_t least_zipped = 1024;  // bytes; below it is not worth it

// The body as this request may have it, and what is to be said of it in the head. Files are made
// small once: their tags are few and never change.
void encode(Page& page, const Request& request, Response& response) {
  response.set(http::field::vary, "Accept-Encoding");
  if (page.body.size() < least_zipped ||
      !accepts_gzip(text_of(request[http::field::accept_encoding]))) {
    return;
  }
  response.set(http::field::content_encoding, "gzip");
  if (page.etag.empty()) {
    page.body = gzip(page.body);
    return;
  }
  static std::map<std::string, std::string> files;  // the web thread's
  const auto [entry, is_new] = files.try_emplace(page.etag);
  if (is_new) {
    entry->second = gzip(page.body);
  }
  page.body = entry->second;
  page.etag.insert(page.etag.size() - 1, "-gz");
}

}  // namespace

std::string_view without_port(std::string_view host) {
  if (host.starts_with('[')) {
    return host.substr(0, std::min(host.find(']') + 1, host.size()));
  }
  return host.substr(0, std::min(host.find(':'), host.size()));
}

bool is_own_origin(std::string_view origin, std::string_view host) {
  const auto scheme = origin.find("://");
  return origin.empty() || (scheme != std::string_view::npos && origin.substr(scheme + 3) == host);
}

std::optional<Topic> topic_of(std::string_view target) {
  if (target == "/ws/lobby" || target == "/ws") {
    return Topic::lobby;
  }
  constexpr std::string_view games = "/ws/games/";
  constexpr std::string_view query = "/ws?game=";
  if (!target.starts_with(games) && !target.starts_with(query)) {
    return std::nullopt;
  }
  target.remove_prefix(target.starts_with(games) ? games.size() : query.size());
  std::int64_t game = 0;
  const auto [end, error] = std::from_chars(target.data(), target.data() + target.size(), game);
  if (error != std::errc{} || end != target.data() + target.size() || game <= 0) {
    return std::nullopt;
  }
  return game_topic(game);
}

Response response_of(Page page, const Request& request) {
  Response response{http::int_to_status(page.status), request.version()};
  response.set(http::field::content_type, page.type);
  response.set("X-Content-Type-Options", "nosniff");
  response.set("Referrer-Policy", "no-referrer");
  response.set("Content-Security-Policy", security_policy);
  response.keep_alive(request.keep_alive());
  encode(page, request, response);
  if (page.etag.empty()) {
    response.set(http::field::cache_control, "no-store");
  } else {
    response.set(http::field::cache_control, "no-cache");  // may be kept, must be asked about
    response.set(http::field::etag, page.etag);
    if (names_tag(text_of(request[http::field::if_none_match]), page.etag)) {
      response.erase(http::field::content_encoding);
      response.result(http::status::not_modified);
      return response;
    }
  }
  response.body() = std::move(page.body);
  response.prepare_payload();
  if (request.method() == http::verb::head) {
    response.body().clear();
  }
  return response;
}

std::optional<Page> refusal_of(const boost::system::error_code& error) {
  if (error == http::error::header_limit || error == http::error::buffer_overflow) {
    return refusal(431, "too_large", fmt::format("expected a head of {} bytes", header_bytes));
  }
  if (error == http::error::end_of_stream || error == http::error::partial_message ||
      error.category() != http::make_error_code(http::error::bad_version).category()) {
    return std::nullopt;
  }
  return refusal(400, "bad_request", "this is no HTTP");
}

Page too_long_a_body(std::uint64_t limit) {
  return refusal(413, "too_large", fmt::format("expected at most {} bytes", limit));
}

}  // namespace poolhall::web
