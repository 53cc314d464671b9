#include "server/net/tls.hpp"

#include <openssl/ssl.h>

namespace poolhall::net {

namespace ssl = boost::asio::ssl;

tl::expected<std::unique_ptr<TlsContext>, std::string> load_tls(
    const settings::TlsSettings& settings) {
  if (settings.certificate.empty() || settings.key.empty()) {
    return tl::unexpected(std::string("TLS wants both tls.certificate and tls.key"));
  }
  auto context = std::make_unique<TlsContext>(ssl::context::tls_server);
  SSL_CTX* const native = context->native_handle();
  SSL_CTX_set_min_proto_version(native, TLS1_2_VERSION);
  // An idle connection keeps no buffers. Tickets are for clients that come and go: a bot stays.
  SSL_CTX_set_mode(native, SSL_MODE_RELEASE_BUFFERS | SSL_MODE_ENABLE_PARTIAL_WRITE |
                               SSL_MODE_ACCEPT_MOVING_WRITE_BUFFER);
  SSL_CTX_set_num_tickets(native, 0);
  SSL_CTX_set_session_cache_mode(native, SSL_SESS_CACHE_OFF);
  SSL_CTX_set_options(native, SSL_OP_NO_RENEGOTIATION | SSL_OP_IGNORE_UNEXPECTED_EOF);
  boost::system::error_code error;
  context->use_certificate_chain_file(settings.certificate, error);
  if (error) {
    return tl::unexpected(settings.certificate +
                          ": no certificate can be read: " + error.message());
  }
  context->use_private_key_file(settings.key, ssl::context::pem, error);
  if (error) {
    return tl::unexpected(settings.key +
                          ": no private key of the certificate can be read: " + error.message());
  }
  return context;
}

}  // namespace poolhall::net
