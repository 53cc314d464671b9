// The completion token of all our coroutines: errors come as values, not as exceptions.
//
//   const auto [error, read] = co_await socket.async_read_some(buffer, awaited);
#pragma once

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/use_awaitable.hpp>

namespace poolhall::web {

inline constexpr auto awaited = boost::asio::as_tuple(boost::asio::use_awaitable);

}  // namespace poolhall::web
