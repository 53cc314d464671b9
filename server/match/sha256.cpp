#include "server/match/sha256.hpp"

#include <openssl/evp.h>
#include <openssl/hmac.h>

#include <bit>
#include <cstdio>
#include <cstdlib>

namespace poolhall::match {
namespace {

// SHA-256 is in every OpenSSL: that it fails means that the machine does.
[[noreturn]] void no_crypto() {
  std::fputs("poolhall: OpenSSL cannot compute SHA-256\n", stderr);
  std::abort();
}

}  // namespace

Bytes& Bytes::real(double value) {
  return fixed(std::bit_cast<std::uint64_t>(value));
}

Bytes& Bytes::text(std::string_view text) {
  fixed(static_cast<std::uint64_t>(text.size()));
  bytes_.insert(bytes_.end(), text.begin(), text.end());
  return *this;
}

Bytes& Bytes::raw(std::span<const std::uint8_t> bytes) {
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  return *this;
}

Digest sha256(std::span<const std::uint8_t> bytes) {
  Digest digest;
  unsigned size = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &size, EVP_sha256(), nullptr) != 1 ||
      size != digest.size())
    no_crypto();
  return digest;
}

Digest hmac_sha256(std::span<const std::uint8_t> key, std::span<const std::uint8_t> message) {
  Digest digest;
  unsigned size = 0;
  if (HMAC(EVP_sha256(), key.data(), static_cast<int>(key.size()), message.data(), message.size(),
           digest.data(), &size) == nullptr ||
      size != digest.size())
    no_crypto();
  return digest;
}

}  // namespace poolhall::match
