// The server's certificate as OpenSSL wants it.
//
//   auto context = load_tls(settings.tls);
//   if (!context) die(context.error());        // one line
//   Channel channel{std::move(socket), context->native_handle()};
#pragma once

#include <boost/asio/ssl/context.hpp>
#include <memory>
#include <string>

#include <tl/expected.hpp>

#include "server/settings/server_settings.hpp"

namespace poolhall::net {

using TlsContext = boost::asio::ssl::context;

// TLS 1.2 or 1.3. The error names the file.
[[nodiscard]] tl::expected<std::unique_ptr<TlsContext>, std::string> load_tls(
    const settings::TlsSettings& settings);

}  // namespace poolhall::net
