#include "clients/cpp/noise_parts.hpp"

#include <openssl/sha.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>

#include "clients/cpp/token.hpp"

namespace poolhall::client {
namespace {

// An agent has fewer games at once.
constexpr std::size_t most_parts = 256;

}  // namespace

protocol::Hex256 sha256_of(const protocol::Hex256& bytes) {
  std::array<unsigned char, 32> raw{};
  for (std::size_t i = 0; i < raw.size(); ++i) {
    const char* digits = bytes.text.data() + 2 * i;
    std::from_chars(digits, digits + 2, raw[i], 16);
  }
  std::array<unsigned char, SHA256_DIGEST_LENGTH> digest{};
  SHA256(raw.data(), raw.size(), digest.data());
  constexpr std::string_view digits = "0123456789abcdef";
  protocol::Hex256 hex;
  for (const unsigned char byte : digest) {
    hex.text.push_back(digits[byte >> 4U]);
    hex.text.push_back(digits[byte & 15U]);
  }
  return hex;
}

protocol::Hex256 NoiseParts::commit() {
  if (parts_.size() == most_parts) {
    parts_.pop_front();
  }
  const protocol::Hex256 secret = random_token();
  parts_.push_back({sha256_of(secret), secret});
  return parts_.back().commitment;
}

std::optional<protocol::Hex256> NoiseParts::secret_for(const protocol::Hex256& commitment) const {
  const auto part = std::find_if(parts_.begin(), parts_.end(), [&](const Part& candidate) {
    return candidate.commitment == commitment;
  });
  return part == parts_.end() ? std::nullopt : std::optional{part->secret};
}

}  // namespace poolhall::client
