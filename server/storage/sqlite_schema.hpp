// The tables, and how an older file becomes a newer one. Migrations are numbered from 1 and never
// change once released; PRAGMA user_version tells which of them a file has seen.
#pragma once

#include <span>
#include <string_view>

namespace poolhall::storage {

// PRAGMA application_id of a Poolhall database: "Pool".
inline constexpr int application_id = 0x506f6f6c;

// Statement n brings a file from version n to n + 1.
[[nodiscard]] std::span<const std::string_view> migrations();

}  // namespace poolhall::storage
