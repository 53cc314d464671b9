#include "server/net/tokens.hpp"

#include <fcntl.h>
#include <openssl/crypto.h>
#include <openssl/rand.h>
#include <openssl/sha.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <fstream>
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

tl::expected<std::string, std::string> token_in(const std::filesystem::path& file) {
  const int made = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (made >= 0) {
    const std::string line = new_token() + "\n";
    const bool written =
        ::write(made, line.data(), line.size()) == static_cast<ssize_t>(line.size());
    ::close(made);
    if (!written) {
      return tl::unexpected(file.string() + ": the admin token cannot be written");
    }
  }
  std::ifstream in(file);
  std::string token;
  if (!std::getline(in, token)) {
    return tl::unexpected(file.string() + ": the admin token cannot be read");
  }
  const bool visible =
      std::all_of(token.begin(), token.end(), [](char c) { return c > ' ' && c < 0x7f; });
  if (token.size() < 16 || token.size() > 256 || !visible) {
    return tl::unexpected(file.string() +
                          ": expected a line of 16 to 256 visible characters, the admin token");
  }
  return token;
}

std::uint64_t random_seed() {
  const auto bytes = random_bytes<sizeof(std::uint64_t)>();
  std::uint64_t seed = 0;
  std::memcpy(&seed, bytes.data(), sizeof seed);
  return seed >> 11U;
}

}  // namespace poolhall::net
