#include "server/net/tokens.hpp"

#include <openssl/crypto.h>
#include <openssl/rand.h>
#include <openssl/sha.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace poolhall::net {

namespace {

constexpr std::size_t token_bytes = 32;

template <std::size_t size>
std::array<std::uint8_t, size> random_bytes() {
  std::array<std::uint8_t, size> bytes{};
  if (RAND_bytes(bytes.data(), static_cast<int>(bytes.size())) != 1) {
    throw std::runtime_error("the system gives no random bytes");
  }
  return bytes;
}

std::optional<unsigned> hex_digit(char c) {
  if (c >= '0' && c <= '9') {
    return static_cast<unsigned>(c - '0');
  }
  if (c >= 'a' && c <= 'f') {
    return static_cast<unsigned>(c - 'a') + 10U;
  }
  if (c >= 'A' && c <= 'F') {
    return static_cast<unsigned>(c - 'A') + 10U;
  }
  return std::nullopt;
}

}  // namespace

std::string new_token() {
  static constexpr char digits[] = "0123456789abcdef";
  std::string token;
  token.reserve(2 * token_bytes);
  for (const std::uint8_t byte : random_bytes<token_bytes>()) {
    token.push_back(digits[byte >> 4U]);
    token.push_back(digits[byte & 0x0fU]);
  }
  return token;
}

bool is_token(std::string_view text) {
  return text.size() == 2 * token_bytes &&
         std::all_of(text.begin(), text.end(), [](char c) { return hex_digit(c).has_value(); });
}

TokenHash hash_of(std::string_view token) {
  std::array<std::uint8_t, token_bytes> bytes{};
  for (std::size_t i = 0; i < token_bytes; ++i) {
    bytes[i] = static_cast<std::uint8_t>(hex_digit(token[2 * i]).value() * 16U +
                                         hex_digit(token[2 * i + 1]).value());
  }
  TokenHash hash{};
  SHA256(bytes.data(), bytes.size(), hash.data());
  OPENSSL_cleanse(bytes.data(), bytes.size());
  return hash;
}

bool same(const TokenHash& a, const TokenHash& b) {
  return CRYPTO_memcmp(a.data(), b.data(), a.size()) == 0;
}

std::uint64_t random_seed() {
  const auto bytes = random_bytes<sizeof(std::uint64_t)>();
  std::uint64_t seed = 0;
  std::memcpy(&seed, bytes.data(), sizeof seed);
  return seed >> 11U;
}

}  // namespace poolhall::net
