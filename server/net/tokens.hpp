// Agents' tokens: 256 random bits as 64 hex digits. Only SHA-256 of a token is ever stored, and
// hashes are compared in constant time.
//
//   std::string token = new_token();
//   TokenHash hash = hash_of(token);
//   if (same(hash, stored)) let_in();
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

namespace poolhall::net {

using TokenHash = std::array<std::uint8_t, 32>;

[[nodiscard]] std::string new_token();
// 64 hex digits, either case.
[[nodiscard]] bool is_token(std::string_view text);
// Of the token's 32 bytes, so that the digits' case does not matter; `token` must be one.
[[nodiscard]] TokenHash hash_of(std::string_view token);
[[nodiscard]] bool same(const TokenHash& a, const TokenHash& b);

// The token in a file of one line, 16 to 256 visible characters; made with a fresh one, for its
// owner alone, if there is no such file. The error is one line for a person.
[[nodiscard]] tl::expected<std::string, std::string> token_in(const std::filesystem::path& file);

// Random bits from the system, for ids and seeds. Below 2^53, so that every JSON reader keeps it.
[[nodiscard]] std::uint64_t random_seed();

}  // namespace poolhall::net
