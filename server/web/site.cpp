#include "server/web/site.hpp"

#include <algorithm>
#include <boost/asio/async_result.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <utility>

#include "server/web/pages.hpp"
#include "server/web/routes.hpp"
#include "server/web/static_files.hpp"
#include "server/web/workbench.hpp"

namespace poolhall::web {

namespace asio = boost::asio;
namespace http = boost::beast::http;
using std::chrono::steady_clock;

namespace {

// A table that a thousand people look at is worked out as often as this, not a thousand times.
constexpr std::chrono::milliseconds shared_for{500};
// What takes long to make is shared for longer: a Swiss tournament of 100 is a second's work.
constexpr int shared_share = 4;
constexpr std::chrono::seconds shared_at_most{10};
constexpr std::size_t most_kept = 256;
constexpr std::size_t most_addresses = 4096;
constexpr std::uint32_t burst_seconds = 2;
constexpr std::uint64_t most_scene_bytes = 64 * 1024;

// Waits for a function that takes a `Then`.
template <class Start>
asio::awaitable<Page> awaited_page(Start start) {
  return asio::async_initiate<const asio::use_awaitable_t<>, void(Page)>(
      [start = std::move(start)](auto handler) mutable {
        // A shared handler: std::function wants to be able to copy what it holds.
        auto shared = std::make_shared<decltype(handler)>(std::move(handler));
        start([shared](Page page) { (*shared)(std::move(page)); });
      },
      asio::use_awaitable);
}

std::string path_of(const Request& request) {
  const std::string target{request.target().data(), request.target().size()};
  return target.substr(0, target.find('?'));
}

bool is_shared(std::string_view path) {
  return path.starts_with("/api/tournaments") || path.starts_with("/api/agents");
}

Page not_found_page(const std::string& path) {
  if (path.starts_with("/api/")) {
    return refusal(404, "not_found", "there is no such path; see /api/openapi.json");
  }
  auto page = static_file("/404.html");
  page->status = 404;
  page->etag.clear();
  return *page;
}

}  // namespace

Site::Site(asio::io_context& io, asio::thread_pool& workers, Sources sources)
    : io_(io), workers_(workers), sources_(std::move(sources)) {}

asio::awaitable<Page> Site::answer(const Request& request, std::string address) {
  std::string path = path_of(request);
  const bool reads = request.method() == http::verb::get || request.method() == http::verb::head;
  if (auto file = static_file(path); file && reads) {
    co_return std::move(*file);
  }
  const Routing routing =
      route_of({request.method_string().data(), request.method_string().size()}, path);
  if (const auto* missing = std::get_if<NoRoute>(&routing)) {
    co_return *missing == NoRoute::path
        ? not_found_page(path)
        : refusal(405, "method_not_allowed", "see /api/openapi.json for what this path takes");
  }
  if (Admin::is_for(path)) {
    co_return co_await admin(request, path);
  }
  if (reads) {
    co_return co_await get(std::move(path));
  }
  if (!may_simulate(address)) {
    co_return refusal(429, "rate_limited", "too many simulations in too short a time");
  }
  co_return co_await simulate(request.body(), path);
}

std::uint64_t Site::body_limit(std::string_view target) {
  return Admin::is_for(target) ? most_body_bytes : most_scene_bytes;
}

asio::awaitable<Page> Site::get(std::string path) {
  if (path == "/api/openapi.json") {
    co_return Page{200, "application/json", openapi_document()};
  }
  if (path == "/healthz") {
    co_return co_await awaited_page(sources_.health);
  }
  if (path == "/metrics") {
    co_return co_await awaited_page(sources_.metrics);
  }
  if (path == "/api/live") {
    co_return co_await awaited_page(sources_.live);
  }
  if (path == "/api/presets") {
    co_return presets_page();
  }
  co_return co_await stored(path);
}

// No coroutines from here on: GCC 12 destroys what a lambda within a co_await expression has
// captured twice.
asio::awaitable<Page> Site::stored(const std::string& path) {
  return awaited_page([this, path](Then then) {
    if (is_shared(path)) {
      read_shared(path, std::move(then));
    } else {
      read(path, std::move(then));
    }
  });
}

asio::awaitable<Page> Site::admin(const Request& request, const std::string& path) {
  AdminRequest asked{path, std::string{request[http::field::authorization]}, request.body()};
  return awaited_page([this, asked = std::move(asked)](Then then) {
    sources_.admin(asked, [this, then = std::move(then)](Page page) {
      if (page.status < 300) {
        kept_.clear();  // whoever has heard that something changed sees it
      }
      then(std::move(page));
    });
  });
}

asio::awaitable<Page> Site::simulate(const std::string& body, const std::string& path) {
  Page (*const work)(std::string_view) = path == "/api/simulate" ? simulate_page : evaluate_page;
  return awaited_page([this, work, body](Then then) {
    asio::post(workers_, [this, work, body, then = std::move(then)] {
      asio::post(io_, [then, page = work(body)]() mutable { then(std::move(page)); });
    });
  });
}

void Site::read(const std::string& path, Then then) {
  sources_.read([path, delay = sources_.delay](
                    storage::Reader& reader) { return web::answer(reader, path, delay); },
                std::move(then));
}

void Site::read_shared(const std::string& path, Then then) {
  const auto now = steady_clock::now();
  if (kept_.size() >= most_kept) {
    std::erase_if(kept_, [now](const auto& entry) {
      return entry.second->waiting.empty() && entry.second->until <= now;
    });
  }
  std::shared_ptr<Kept>& kept = kept_[path];
  if (kept == nullptr) {
    kept = std::make_shared<Kept>();
  }
  if (kept->waiting.empty() && now < kept->until) {
    then(kept->page);
    return;
  }
  kept->waiting.push_back(std::move(then));
  if (kept->waiting.size() > 1) {
    return;
  }
  read(path, [kept, began = now](const Page& page) {
    const auto ended = steady_clock::now();
    kept->page = page;
    kept->until = ended + std::clamp<steady_clock::duration>(shared_share * (ended - began),
                                                             shared_for, shared_at_most);
    for (const Then& next : std::exchange(kept->waiting, {})) {
      next(page);
    }
  });
}

bool Site::may_simulate(const std::string& address) {
  const std::uint32_t rate = sources_.simulations_per_second;
  if (simulations_.size() >= most_addresses) {
    simulations_.clear();
  }
  const auto [entry, is_new] = simulations_.try_emplace(address, rate, burst_seconds * rate);
  return rate > 0 && entry->second.take(steady_clock::now());
}

}  // namespace poolhall::web
